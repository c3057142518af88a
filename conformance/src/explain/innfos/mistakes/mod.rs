//! What senders and lines make of frames.

mod byte;
mod checksum;
mod layout;

use actucheck_spec::wire::innfos::reference::{PREFIX, crc};

use super::super::mistake::{Mistake, name};
use super::CRC_AND_END;

/// The mistakes, the likeliest first; those with most trials last.
pub(in super::super) const MISTAKES: &[Mistake] = &[
    Mistake::of_program(name::CRC_SWAPPED, checksum::swapped),
    Mistake::of_program(name::CRC_ZERO, checksum::zero),
    Mistake::of_program("needless CRC", checksum::needless),
    Mistake::of_program(name::WRONG_LENGTH, layout::length),
    Mistake::of_program("no CRC", checksum::missing),
    Mistake::of_line("other direction", layout::direction),
    Mistake::of_program(name::WRONG_HEADER, layout::header),
    Mistake::of_program("wrong end byte", layout::end),
    Mistake::of_program(name::OTHER_RANGE, checksum::range),
    Mistake::of_program(name::OTHER_CRC, checksum::algorithm),
    Mistake::of_line(name::TRAILING, layout::trailing),
    Mistake::of_line("no address or no command", layout::who_or_what),
    Mistake::of_line(name::CUT, layout::cut),
    Mistake::of_line(name::NEEDLESS_BYTE, byte::needless),
    Mistake::of_line(name::OTHER_BIT, byte::bit),
    Mistake::of_line(name::OTHER_BYTE, byte::changed),
    Mistake::of_line(name::MISSING_BYTE, byte::missing),
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

    /// The right CRC, and the frame with it.
    fn repaired(&self) -> (u16, Vec<u8>) {
        let right = crc(self.data);
        (right, self.with(&right.to_le_bytes()))
    }

    /// The frame with another CRC, or with none.
    fn with(&self, crc: &[u8]) -> Vec<u8> {
        [self.before, crc, &[self.end]].concat()
    }
}
