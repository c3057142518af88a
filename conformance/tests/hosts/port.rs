//! A serial port, with a limit to each wait.

use std::fs::{File, OpenOptions};
use std::io::{self, ErrorKind, Read as _, Write as _};
use std::os::unix::fs::OpenOptionsExt as _;
use std::time::{Duration, Instant};

use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::fs::OFlags;
use rustix::termios::{OptionalActions, tcgetattr, tcsetattr};

use super::faults::{Fault, Switch};

/// Reads that a port's old input may take. A line that never rests ends it.
const OLD_READS: usize = 64;

pub(crate) struct Port {
    reader: File,
    writer: File,
}

impl Port {
    /// Opens a terminal so that it changes no byte.
    pub(crate) fn open(on: Switch, path: &str, baud: u32) -> io::Result<Self> {
        let open = |path: &str| {
            let flags = OFlags::NOCTTY | OFlags::NONBLOCK;
            let flags = i32::try_from(flags.bits()).map_err(io::Error::other)?;
            OpenOptions::new().read(true).write(true).custom_flags(flags).open(path)
        };
        let reader = open(path)?;
        let mut settings = tcgetattr(&reader)?;
        settings.make_raw();
        settings.set_speed(baud)?;
        tcsetattr(&reader, OptionalActions::Now, &settings)?;
        let writer =
            if on.is(Fault::WrongPort) { open("/dev/null")? } else { reader.try_clone()? };
        Ok(Self { reader, writer })
    }

    /// Takes away what came before.
    pub(crate) fn drain(&mut self) -> io::Result<()> {
        for _ in 0..OLD_READS {
            if self.receive(Some(Instant::now()))?.is_empty() {
                break;
            }
        }
        Ok(())
    }

    /// Writes all of it, or fails at the end of the time.
    pub(crate) fn send(&mut self, mut bytes: &[u8], end: Instant) -> io::Result<()> {
        while !bytes.is_empty() {
            match self.writer.write(bytes) {
                Ok(count) => bytes = &bytes[count..],
                Err(error) if error.kind() == ErrorKind::WouldBlock => {
                    if !wait(&self.writer, PollFlags::OUT, Some(end))? {
                        return Err(ErrorKind::TimedOut.into());
                    }
                }
                Err(error) => return Err(error),
            }
        }
        Ok(())
    }

    /// What there is to read; nothing at the end of the time, if it has one.
    pub(crate) fn receive(&mut self, end: Option<Instant>) -> io::Result<Vec<u8>> {
        if !wait(&self.reader, PollFlags::IN, end)? {
            return Ok(Vec::new());
        }
        let mut bytes = vec![0; 4096];
        let count = self.reader.read(&mut bytes)?;
        if count == 0 {
            return Err(ErrorKind::UnexpectedEof.into());
        }
        bytes.truncate(count);
        Ok(bytes)
    }
}

/// Whether a port is ready before the end of the time.
fn wait(port: &File, flags: PollFlags, end: Option<Instant>) -> io::Result<bool> {
    loop {
        let left = end.map(|end| end.saturating_duration_since(Instant::now()));
        let time = left.map(Timespec::try_from).transpose().map_err(io::Error::other)?;
        match poll(&mut [PollFd::new(port, flags)], time.as_ref()) {
            Ok(0) if left == Some(Duration::ZERO) => return Ok(false),
            Ok(0) | Err(rustix::io::Errno::INTR) => {}
            Ok(_) => return Ok(true),
            Err(error) => return Err(error.into()),
        }
    }
}
