//! Firmware that was compiled for this machine, as a process.

use std::io;
use std::os::fd::OwnedFd;
use std::os::unix::process::CommandExt as _;
use std::process::{Child, Command, Stdio};

use rustix::process::{Pid, Signal, kill_process_group};

/// A running program. It ends with its children when it is dropped.
#[derive(Debug)]
pub(super) struct Program(Child);

impl Program {
    /// Starts a command. Returns also where its bytes come from, and where its bytes go to. What it
    /// writes to standard error goes where that of this program goes.
    pub(super) fn start(command: &[String]) -> io::Result<(Self, OwnedFd, OwnedFd)> {
        let (program, arguments) = command.split_first().ok_or(io::ErrorKind::InvalidInput)?;
        let mut command = Command::new(program);
        command.args(arguments).stdin(Stdio::piped()).stdout(Stdio::piped()).process_group(0);
        let mut child = command.spawn()?;
        let (input, output) = (child.stdout.take(), child.stdin.take());
        let running = Self(child);
        match (input, output) {
            (Some(input), Some(output)) => Ok((running, input.into(), output.into())),
            _ => Err(io::ErrorKind::BrokenPipe.into()),
        }
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        let group = i32::try_from(self.0.id()).ok().and_then(Pid::from_raw);
        // It may have ended by itself.
        if let Some(group) = group {
            let _ = kill_process_group(group, Signal::KILL);
        }
        let _ = self.0.wait();
    }
}
