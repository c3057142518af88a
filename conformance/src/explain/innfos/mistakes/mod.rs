//! What senders and lines make of frames.

mod byte;
mod checksum;
mod layout;

use actucheck_spec::wire::innfos::reference::PREFIX;

use super::super::mistake::Mistake;
use super::CRC_AND_END;

/// The mistakes, the likeliest first; those with most trials last.
pub(in super::super) const MISTAKES: &[Mistake] = &[
    Mistake { name: "CRC bytes swapped", find: checksum::swapped },
    Mistake { name: "CRC left at zero", find: checksum::zero },
    Mistake { name: "needless CRC", find: checksum::needless },
    Mistake { name: "wrong length", find: layout::length },
    Mistake { name: "no CRC", find: checksum::missing },
    Mistake { name: "other direction", find: layout::direction },
    Mistake { name: "wrong header", find: layout::header },
    Mistake { name: "wrong end byte", find: layout::end },
    Mistake { name: "CRC over other bytes", find: checksum::range },
    Mistake { name: "other CRC", find: checksum::algorithm },
    Mistake { name: "bytes after the packet", find: layout::trailing },
    Mistake { name: "cut short", find: layout::cut },
    Mistake { name: "one byte too many", find: byte::needless },
    Mistake { name: "one bit changed", find: byte::bit },
    Mistake { name: "one byte changed", find: byte::changed },
    Mistake { name: "one byte missing", find: byte::missing },
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
