//! What senders and lines make of frames.

mod byte;
mod checksum;
mod layout;

use actucheck_spec::wire::innfos::reference::PREFIX;

use super::super::mistake::{CRC_SWAPPED, Mistake, OTHER_CRC};
use super::CRC_AND_END;

/// The mistakes, the likeliest first; those with most trials last.
pub(in super::super) const MISTAKES: &[Mistake] = &[
    Mistake::of_program(CRC_SWAPPED, checksum::swapped),
    Mistake::of_program("CRC left at zero", checksum::zero),
    Mistake::of_program("needless CRC", checksum::needless),
    Mistake::of_program("wrong length", layout::length),
    Mistake::of_program("no CRC", checksum::missing),
    Mistake::of_line("other direction", layout::direction),
    Mistake::of_program("wrong header", layout::header),
    Mistake::of_program("wrong end byte", layout::end),
    Mistake::of_program("CRC over other bytes", checksum::range),
    Mistake::of_program(OTHER_CRC, checksum::algorithm),
    Mistake::of_line("bytes after the packet", layout::trailing),
    Mistake::of_line("cut short", layout::cut),
    Mistake::of_line("one byte too many", byte::needless),
    Mistake::of_line("one bit changed", byte::bit),
    Mistake::of_line("one byte changed", byte::changed),
    Mistake::of_line("one byte missing", byte::missing),
];

/// Bytes as the parts of a frame with a CRC.
struct Seen<'a> {
    /// All before the CRC.
    before: &'a [u8],
    data: &'a [u8],
    crc: [u8; 2],
    end: u8,
}

impl<'a> Seen<'a> {
    fn of(bytes: &'a [u8]) -> Option<Self> {
        let (before, [first, second, end]) = bytes.split_last_chunk::<CRC_AND_END>()?;
        let data = before.get(PREFIX..)?;
        Some(Self { before, data, crc: [*first, *second], end: *end })
    }

    /// The frame with another CRC, or with none.
    fn with(&self, crc: &[u8]) -> Vec<u8> {
        [self.before, crc, &[self.end]].concat()
    }
}
