//! Packets of every length: without the pattern of byte stuffing, and with it at every place.
//!
//! The length is that of the body without stuffing: the bytes from the instruction up to the CRC.

use actucheck_spec::wire::dynamixel2::reference::{PATTERN, PREFIX};

use super::BOTH_WAYS;
use super::kind::Kind;
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

/// If an implementation states a limit, lengths up to it are tried too.
pub(super) fn family(author: Author<'_>, limits: Limits) -> Family<'_> {
    const PREFIX: &str = "dynamixel2.body.";
    let limit = limits.send().max(limits.receive()).unwrap_or_default();
    Family::new(PREFIX, move || {
        lengths(limit).flat_map(move |length| {
            let kinds = Kind::ALL.into_iter().filter(move |kind| least(*kind) <= length);
            kinds.flat_map(move |kind| {
                let stem = format!("{PREFIX}{length}.{kind}");
                let plain = Group::new(format!("{stem}.plain"), &BOTH_WAYS, move |stem| {
                    author.both_ways(stem, of_length(kind, length), &kind.with_body(length, None))
                });
                let patterns = places(kind, length).map(move |place| {
                    Group::new(format!("{stem}.pattern-at-{place}"), &BOTH_WAYS, move |stem| {
                        let packet = kind.with_body(length, Some(place));
                        author.both_ways(stem, "dynamixel2.stuffing.transmit", &packet)
                    })
                });
                std::iter::once(plain).chain(patterns)
            })
        })
    })
}

/// The requirement on the length of this packet.
const fn of_length(kind: Kind, length: usize) -> &'static str {
    match kind {
        // The length field counts the CRC too.
        _ if length + 2 > 0xFF => "dynamixel2.packet.length.byte-order",
        Kind::Write => "dynamixel2.packet.length.instruction",
        Kind::Status => "dynamixel2.packet.length.status",
    }
}

/// The shortest body; a Write writes something.
const fn least(kind: Kind) -> usize {
    match kind {
        Kind::Write => kind.before_data() + 1,
        Kind::Status => kind.before_data(),
    }
}

/// The first place of the pattern. A status packet has no error, as libraries return no data with
/// one.
const fn first_place(kind: Kind) -> usize {
    match kind {
        Kind::Write => 1,
        Kind::Status => kind.before_data(),
    }
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
    let first = first_place(kind);
    let last = length.saturating_sub(PATTERN.len());
    (first..=last).filter(move |place| all || [first, length / 2, last].contains(place))
}
