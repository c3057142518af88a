//! The bytes themselves.

use std::io::{BufRead, ErrorKind};

use crate::capture::source::Sampled;
use crate::capture::{Piece, Unreadable};

const PIECE: usize = 64 << 10;

/// Reads a file of plain bytes.
pub(super) struct Raw<R> {
    input: R,
    ended: bool,
}

impl Raw<Box<dyn BufRead + Send>> {
    pub(super) fn new(input: Sampled) -> Self {
        Self { input: Box::new(input.into_bytes()), ended: false }
    }
}

impl<R: BufRead> Iterator for Raw<R> {
    type Item = Result<Piece, Unreadable>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.ended {
            return None;
        }
        let mut bytes = vec![0; PIECE];
        loop {
            match self.input.read(&mut bytes) {
                Ok(0) => return None,
                Ok(count) => {
                    bytes.truncate(count);
                    return Some(Ok(Piece { bytes, ..Piece::default() }));
                }
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(error) => {
                    self.ended = true;
                    return Some(Err(error.into()));
                }
            }
        }
    }
}
