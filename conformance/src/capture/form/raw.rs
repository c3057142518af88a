//! The bytes themselves.

use std::io::Read as _;

use super::up_to_error;
use crate::capture::source::Sampled;
use crate::capture::{Piece, Pieces};

const PIECE: usize = 64 << 10;

/// The pieces of a file of plain bytes.
pub(super) fn pieces(input: Sampled) -> Pieces {
    let mut input = input.into_bytes();
    up_to_error(move || {
        let mut bytes = Vec::with_capacity(PIECE);
        input.by_ref().take(PIECE as u64).read_to_end(&mut bytes)?;
        Ok((!bytes.is_empty()).then(|| Piece { bytes, ..Piece::default() }))
    })
}
