//! What senders and lines make of packets.

mod byte;
mod checksum;
mod layout;

use actucheck_spec::wire::dynamixel2::reference::{HEADER, PREFIX, crc, repair};

use super::super::mistake::Mistake;

/// The mistakes, the likeliest first; those with most trials last.
pub(in super::super) const MISTAKES: &[Mistake] = &[
    Mistake { name: "CRC bytes swapped", find: checksum::swapped },
    Mistake { name: "CRC left at zero", find: checksum::zero },
    Mistake { name: "wrong length", find: layout::length },
    Mistake { name: "no byte stuffing", find: layout::stuffing },
    Mistake { name: "no reserved byte", find: layout::reserved },
    Mistake { name: "wrong header", find: layout::header },
    Mistake { name: "no instruction 0x55", find: layout::status },
    Mistake { name: "CRC over other bytes", find: checksum::range },
    Mistake { name: "other CRC", find: checksum::algorithm },
    Mistake { name: "bytes after the packet", find: layout::trailing },
    Mistake { name: "Protocol 1.0", find: layout::protocol_1 },
    Mistake { name: "cut short", find: layout::cut },
    Mistake { name: "one byte too many", find: byte::needless },
    Mistake { name: "one bit changed", find: byte::bit },
    Mistake { name: "one byte changed", find: byte::changed },
    Mistake { name: "one byte missing", find: byte::missing },
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
