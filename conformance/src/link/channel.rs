//! One host's way to the bus and back.

use std::io::{self, ErrorKind};
use std::net::SocketAddr;
use std::os::fd::BorrowedFd;

/// What a read came to.
pub(super) enum Read {
    /// So many bytes.
    Bytes(usize),
    /// None are there.
    Nothing,
    /// No more will come.
    End,
}

impl Read {
    /// What a stream's read came to. An error is its end, as it is for a host that was killed.
    pub(super) fn of(result: io::Result<usize>) -> Self {
        match result {
            Ok(0) => Self::End,
            Ok(bytes) => Self::Bytes(bytes),
            Err(error) => match error.kind() {
                ErrorKind::WouldBlock | ErrorKind::Interrupted => Self::Nothing,
                _ => Self::End,
            },
        }
    }
}

/// Where a host's bytes come from and go to. Nothing here waits.
pub(super) trait Channel: Send {
    /// What is waited for.
    fn source(&self) -> BorrowedFd<'_>;

    /// Reads what is there.
    fn read(&mut self, buffer: &mut [u8]) -> Read;

    /// Who has sent what was read last, if several share the channel.
    fn peer(&self) -> Option<SocketAddr> {
        None
    }

    /// Writes to a peer what there is room for, and returns how many bytes that is.
    fn write(&mut self, bytes: &[u8], peer: Option<SocketAddr>) -> usize;

    /// Waits until what was written has come to the other end, where the system takes its time for that.
    fn carry(&self) {}

    /// Whether a packet may go on with the next read.
    fn may_split(&self) -> bool {
        true
    }

    /// Whether the bus ends when its host goes.
    fn ends_the_bus(&self) -> bool {
        false
    }
}

/// Writes until `write` takes no more.
pub(super) fn written(bytes: &[u8], mut write: impl FnMut(&[u8]) -> io::Result<usize>) -> usize {
    let mut taken = 0;
    while let Some(rest) = bytes.get(taken..).filter(|rest| !rest.is_empty()) {
        match write(rest) {
            Ok(0) | Err(_) => break,
            Ok(count) => taken += count,
        }
    }
    taken
}
