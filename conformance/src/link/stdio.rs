//! Standard input and output as a line.

use std::io::{Stdin, Stdout, stdin, stdout};
use std::net::SocketAddr;
use std::os::fd::{AsFd as _, BorrowedFd};

use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::io::{read, write};

use super::channel::{Channel, Read, written};

/// So many bytes a pipe takes without waiting, if it takes any.
const PIECE: usize = 512;

/// Both are shared with other programs, which expect that reading and writing wait. So neither is asked
/// before the system says that it would not.
pub(super) struct Stdio {
    input: Stdin,
    output: Stdout,
}

impl Stdio {
    pub(super) fn open() -> Self {
        Self { input: stdin(), output: stdout() }
    }

    fn has_room(&self) -> bool {
        let mut output = [PollFd::new(&self.output, PollFlags::OUT)];
        poll(&mut output, Some(&Timespec::default())).is_ok_and(|ready| ready > 0)
    }
}

impl Channel for Stdio {
    fn source(&self) -> BorrowedFd<'_> {
        self.input.as_fd()
    }

    fn read(&mut self, buffer: &mut [u8]) -> Read {
        Read::of(read(&self.input, buffer).map_err(Into::into))
    }

    fn write(&mut self, bytes: &[u8], _: Option<SocketAddr>) -> usize {
        written(bytes, |rest| {
            let piece = rest.get(..PIECE).unwrap_or(rest);
            if self.has_room() { write(&self.output, piece).map_err(Into::into) } else { Ok(0) }
        })
    }

    fn ends_the_bus(&self) -> bool {
        true
    }
}
