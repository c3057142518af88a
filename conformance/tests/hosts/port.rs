//! A port, with a limit to each wait: a terminal, or one in memory.

use std::fs::{File, OpenOptions};
use std::io::{self, ErrorKind, Read as _, Write as _};
use std::os::unix::fs::OpenOptionsExt as _;
use std::time::{Duration, Instant};

use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::fs::OFlags;
use rustix::termios::{OptionalActions, tcgetattr, tcsetattr};

use super::faults::{Fault, Switch};
use super::memory::Memory;

/// Reads that a port's old input may take. A line that never rests ends it.
const OLD_READS: usize = 64;

pub(crate) struct Port {
    line: Line,
    /// Whether what is sent goes elsewhere.
    is_deaf: bool,
}

/// Times count from the moment at which it was opened.
enum Line {
    Terminal(Terminal),
    Memory(Memory),
}

struct Terminal {
    file: File,
    opened: Instant,
}

impl Port {
    /// Opens the port with this name, at this rate.
    pub(crate) fn open(on: Switch, name: &str, baud: u32) -> io::Result<Self> {
        let line = match name {
            "memory" => Line::Memory(Memory::default()),
            path => Line::Terminal(Terminal::open(path, baud)?),
        };
        Ok(Self { line, is_deaf: on.is(Fault::WrongPort) })
    }

    /// The port if it is in memory.
    pub(crate) fn memory(&mut self) -> Option<&mut Memory> {
        match &mut self.line {
            Line::Terminal(_) => None,
            Line::Memory(memory) => Some(memory),
        }
    }

    pub(crate) fn now(&self) -> Duration {
        match &self.line {
            Line::Terminal(terminal) => terminal.opened.elapsed(),
            Line::Memory(memory) => memory.now(),
        }
    }

    pub(crate) fn sleep(&mut self, time: Duration) {
        match &mut self.line {
            Line::Terminal(_) => std::thread::sleep(time),
            Line::Memory(memory) => memory.wait_until(memory.now() + time),
        }
    }

    /// Takes away what came before.
    pub(crate) fn drain(&mut self) -> io::Result<()> {
        for _ in 0..OLD_READS {
            if self.receive(Some(self.now()))?.is_empty() {
                break;
            }
        }
        Ok(())
    }

    /// Writes all of it, or fails at the end of the time.
    pub(crate) fn send(&mut self, bytes: &[u8], end: Duration) -> io::Result<()> {
        match &mut self.line {
            _ if self.is_deaf => {}
            Line::Terminal(terminal) => terminal.send(bytes, end)?,
            Line::Memory(memory) => memory.send(bytes),
        }
        Ok(())
    }

    /// What there is to read; nothing at the end of the time, if it has one.
    pub(crate) fn receive(&mut self, end: Option<Duration>) -> io::Result<Vec<u8>> {
        match &mut self.line {
            Line::Terminal(terminal) => terminal.receive(end),
            Line::Memory(memory) => Ok(memory.receive(end)),
        }
    }
}

impl Terminal {
    /// Opens a terminal so that it changes no byte.
    fn open(path: &str, baud: u32) -> io::Result<Self> {
        let flags = OFlags::NOCTTY | OFlags::NONBLOCK;
        let flags = i32::try_from(flags.bits()).map_err(io::Error::other)?;
        let file = OpenOptions::new().read(true).write(true).custom_flags(flags).open(path)?;
        let mut settings = tcgetattr(&file)?;
        settings.make_raw();
        settings.set_speed(baud)?;
        tcsetattr(&file, OptionalActions::Now, &settings)?;
        Ok(Self { file, opened: Instant::now() })
    }

    fn send(&mut self, mut bytes: &[u8], end: Duration) -> io::Result<()> {
        while !bytes.is_empty() {
            match self.file.write(bytes) {
                Ok(count) => bytes = &bytes[count..],
                Err(error) if error.kind() == ErrorKind::WouldBlock => {
                    if !self.wait(PollFlags::OUT, Some(end))? {
                        return Err(ErrorKind::TimedOut.into());
                    }
                }
                Err(error) => return Err(error),
            }
        }
        Ok(())
    }

    fn receive(&mut self, end: Option<Duration>) -> io::Result<Vec<u8>> {
        if !self.wait(PollFlags::IN, end)? {
            return Ok(Vec::new());
        }
        let mut bytes = vec![0; 4096];
        let count = self.file.read(&mut bytes)?;
        if count == 0 {
            return Err(ErrorKind::UnexpectedEof.into());
        }
        bytes.truncate(count);
        Ok(bytes)
    }

    /// Whether the port is ready before the end of the time.
    fn wait(&self, flags: PollFlags, end: Option<Duration>) -> io::Result<bool> {
        loop {
            let left = end.map(|end| end.saturating_sub(self.opened.elapsed()));
            let time = left.map(Timespec::try_from).transpose().map_err(io::Error::other)?;
            match poll(&mut [PollFd::new(&self.file, flags)], time.as_ref()) {
                Ok(0) if left == Some(Duration::ZERO) => return Ok(false),
                Ok(0) | Err(rustix::io::Errno::INTR) => {}
                Ok(_) => return Ok(true),
                Err(error) => return Err(error.into()),
            }
        }
    }
}
