//! Packets of every length: without the pattern of byte stuffing, and with it at every place.
//!
//! The length is that of the body without stuffing: the bytes from the instruction up to the CRC.

use actucheck_spec::wire::dynamixel2::Packet;
use actucheck_spec::wire::dynamixel2::reference::{PATTERN, PREFIX};

use super::BOTH_WAYS;
use crate::adapter::Limits;
use crate::suite::Author;
use crate::suite::plan::{Family, Group};

/// All lengths up to this one are tried.
const LONGEST: usize = 300;

/// The pattern is tried at every place of bodies of at most this length.
const SHORT: usize = 40;

/// Around these lengths too: an implementation may search windows of such sizes.
const WINDOWS: [usize; 3] = [64, 128, 256];

/// The powers of two beyond [`LONGEST`] that the length of a body can be.
const POWERS: std::ops::Range<u32> = 9..16;

/// A packet with a body of any length.
#[derive(Clone, Copy)]
pub(super) enum Kind {
    /// A Write.
    Write,
    /// A status packet.
    Status,
}

impl Kind {
    pub(super) const ALL: [Self; 2] = [Self::Write, Self::Status];

    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Write => "write",
            Self::Status => "status",
        }
    }

    /// The bytes before the data: the instruction and the address, or the instruction and the error.
    pub(super) const fn before_data(self) -> usize {
        match self {
            Self::Write => 3,
            Self::Status => 2,
        }
    }

    /// The shortest body; a Write writes something.
    const fn least(self) -> usize {
        match self {
            Self::Write => self.before_data() + 1,
            Self::Status => self.before_data(),
        }
    }

    /// The first place of the pattern. A status packet has no error, as libraries return no data
    /// with one.
    const fn first_place(self) -> usize {
        match self {
            Self::Write => 1,
            Self::Status => self.before_data(),
        }
    }

    /// The packet with a body of this length, which has the pattern at `place`.
    pub(super) fn packet(self, length: usize, place: Option<usize>) -> Packet {
        // Of bytes that no pattern has; each differs from its neighbours.
        let mut body: Vec<u8> = (0x10..0xD0).cycle().take(length).collect();
        // Address 116, as some libraries support addresses up to 255 only; and no error.
        let (from, fixed): (usize, &[u8]) = match self {
            Self::Write => (1, &[0x74, 0x00]),
            Self::Status => (1, &[0x00]),
        };
        put(&mut body, from, fixed);
        if let Some(place) = place {
            put(&mut body, place, &PATTERN);
        }
        let rest = body.get(1..).unwrap_or_default();
        match (self, rest) {
            (Self::Status, [error, params @ ..]) => {
                Packet::Status { id: 1, error: *error, params: params.to_vec().into() }
            }
            _ => Packet::Instruction { id: 1, instruction: 0x03, params: rest.to_vec().into() },
        }
    }

    /// The requirement on the length of this packet.
    pub(super) const fn of_length(self, length: usize) -> &'static str {
        match self {
            // The length field counts the CRC too.
            _ if length + 2 > 0xFF => "dynamixel2.packet.length.byte-order",
            Self::Write => "dynamixel2.packet.length.instruction",
            Self::Status => "dynamixel2.packet.length.status",
        }
    }
}

/// Overwrites bytes, as far as there are any.
fn put(body: &mut [u8], from: usize, bytes: &[u8]) {
    for (slot, byte) in body.iter_mut().skip(from).zip(bytes) {
        *slot = *byte;
    }
}

/// If an implementation states a limit, lengths up to it are tried too.
pub(super) fn family(author: Author<'_>, limits: Limits) -> Family<'_> {
    const PREFIX: &str = "dynamixel2.body.";
    let limit = limits.send().max(limits.receive()).unwrap_or_default();
    Family::new(PREFIX, move || {
        lengths(limit).flat_map(move |length| {
            let kinds = Kind::ALL.into_iter().filter(move |kind| kind.least() <= length);
            kinds.flat_map(move |kind| {
                let stem = format!("{PREFIX}{length}.{}", kind.name());
                let plain = Group::new(format!("{stem}.plain"), &BOTH_WAYS, move |stem| {
                    author.both_ways(stem, kind.of_length(length), &kind.packet(length, None))
                });
                let patterns = places(kind, length).map(move |place| {
                    Group::new(format!("{stem}.pattern-at-{place}"), &BOTH_WAYS, move |stem| {
                        let packet = kind.packet(length, Some(place));
                        author.both_ways(stem, "dynamixel2.stuffing.transmit", &packet)
                    })
                });
                std::iter::once(plain).chain(patterns)
            })
        })
    })
}

fn lengths(limit: usize) -> impl Iterator<Item = usize> {
    // A pattern adds a byte.
    let longest = limit.saturating_sub(PREFIX + 2 + 1);
    let powers = POWERS.flat_map(|power| around(1 << power));
    (1..=LONGEST).chain(powers.filter(move |length| *length <= longest))
}

fn around(length: usize) -> std::ops::RangeInclusive<usize> {
    length - 1..=length + 1
}

/// The places of the pattern: all, or the first, the last and one in the middle.
fn places(kind: Kind, length: usize) -> impl Iterator<Item = usize> {
    let all = length <= SHORT || WINDOWS.iter().any(|window| around(*window).contains(&length));
    let first = kind.first_place();
    let last = length.saturating_sub(PATTERN.len());
    (first..=last).filter(move |place| all || [first, length / 2, last].contains(place))
}
