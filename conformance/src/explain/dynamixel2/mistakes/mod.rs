//! What senders and lines make of packets.

mod byte;
mod checksum;
mod layout;

use actucheck_spec::wire::dynamixel2::reference::{HEADER, PREFIX, crc, repair};

use super::super::mistake::{Mistake, name};

/// The mistakes, the likeliest first; those with most trials last.
pub(in super::super) const MISTAKES: &[Mistake] = &[
    Mistake::of_program(name::CRC_SWAPPED, checksum::swapped),
    Mistake::of_program(name::CRC_ZERO, checksum::zero),
    Mistake::of_program(name::WRONG_LENGTH, layout::length),
    Mistake::of_program(name::NO_STUFFING, layout::stuffing),
    Mistake::of_program(name::STUFFING_TWICE, layout::twice),
    Mistake::of_program("no reserved byte", layout::reserved),
    Mistake::of_program(name::WRONG_HEADER, layout::header),
    Mistake::of_program("no instruction 0x55", layout::status),
    Mistake::of_program(name::OTHER_RANGE, checksum::range),
    Mistake::of_program(name::OTHER_CRC, checksum::algorithm),
    Mistake::of_line(name::TRAILING, layout::trailing),
    Mistake::of_line("Protocol 1.0", layout::protocol_1),
    Mistake::of_line(name::CUT, layout::cut),
    Mistake::of_line(name::NEEDLESS_BYTE, byte::needless),
    Mistake::of_line(name::OTHER_BIT, byte::bit),
    Mistake::of_line(name::OTHER_BYTE, byte::changed),
    Mistake::of_line(name::MISSING_BYTE, byte::missing),
];

/// Bytes that have a header and are long enough for a packet.
struct Seen<'a> {
    id: u8,
    /// What the length field says.
    length: usize,
    /// What it has to say for these bytes.
    right: usize,
    /// All before the CRC.
    before: &'a [u8],
    /// The stuffed body.
    body: &'a [u8],
    crc: [u8; 2],
}

impl<'a> Seen<'a> {
    fn of(bytes: &'a [u8]) -> Option<Self> {
        let [_, _, _, _, id, low, high, _, ..] = *bytes else { return None };
        let (before, crc) = bytes.split_last_chunk()?;
        Some(Self {
            id,
            length: usize::from(u16::from_le_bytes([low, high])),
            right: bytes.len() - PREFIX,
            before,
            body: before.get(PREFIX..).filter(|body| !body.is_empty())?,
            crc: *crc,
        })
        .filter(|_| bytes.starts_with(&HEADER))
    }

    /// The same if the length is right.
    fn whole(bytes: &'a [u8]) -> Option<Self> {
        Self::of(bytes).filter(|seen| seen.length == seen.right)
    }
}

/// Whether the sender computed the CRC over what it sent.
fn crc_is_right(bytes: &[u8]) -> bool {
    bytes.split_last_chunk().is_some_and(|(before, found)| crc(before).to_le_bytes() == *found)
}

/// The bytes with a right CRC.
fn repaired(bytes: &[u8]) -> Vec<u8> {
    let mut frame = bytes.to_vec();
    repair(&mut frame);
    frame
}
