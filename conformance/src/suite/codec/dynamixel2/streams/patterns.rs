//! Packets with byte stuffing, and what is left of one whose front is lost: FF FF FD FD, which is no
//! header, with bytes after it that would be an ID and a length.

use super::{Cut, FOUND, KINDS, Kind, Part, Scenario, frame};

/// The requirement that FF FF FD FD is no header.
const NO_HEADER: &str = "dynamixel2.receive.header.stuffed";

const STUFFED: [u8; 4] = [0xFF, 0xFF, 0xFD, 0xFD];

/// Data with patterns: one, two in a row, one before FD, one at the end, and the beginning of one
/// before the CRC.
const WORDS: [(&str, &[u8]); 5] = [
    ("one", &[0xFF, 0xFF, 0xFD]),
    ("two", &[0xFF, 0xFF, 0xFD, 0xFF, 0xFF, 0xFD]),
    ("before-fd", &[0xFF, 0xFF, 0xFD, 0xFD, 0x01]),
    ("at-the-end", &[0x01, 0x02, 0xFF, 0xFF, 0xFD]),
    ("begun", &[0x01, 0x02, 0xFF, 0xFF]),
];

/// Three packets with patterns, cut at each place.
pub(super) fn whole() -> Vec<Scenario> {
    let of = |kind: Kind, (name, data): (&str, &'static [u8])| {
        let parts = move || (0..3).map(|_| Part::Packet(kind.packet(data))).collect();
        let name = format!("pattern.{kind}.{name}");
        Scenario::new(name, FOUND, &[Cut::ByPart, Cut::Every(1)], parts).cut_everywhere(true)
    };
    KINDS.into_iter().flat_map(|kind| WORDS.map(|word| of(kind, word))).collect()
}

/// A stuffed header with an ID and a length before good packets. The length ends inside the first
/// packet, after it, or after everything.
pub(super) fn stuffed_headers() -> Vec<Scenario> {
    const LENGTHS: [u16; 12] = [0, 3, 4, 7, 11, 15, 16, 17, 30, 100, 255, 0xFFFF];
    let of = |kind: Kind, length: u16| {
        let parts = move || {
            let claim = || Part::Other([&STUFFED[..], &[1], &length.to_le_bytes()].concat());
            let [one, two, three] = [1, 2, 3].map(|number| Part::Packet(kind.numbered(number)));
            vec![claim(), one, two, claim(), three]
        };
        let name = format!("stuffed-header.{kind}.claims-{length}");
        Scenario::new(name, NO_HEADER, &[Cut::ByPart, Cut::Every(1)], parts)
            .cut_everywhere(length == 16)
    };
    KINDS.into_iter().flat_map(|kind| LENGTHS.map(|length| of(kind, length))).collect()
}

/// A stuffed packet without its first bytes, before good packets. If its pattern is left, what
/// follows that is the ID and the length of a packet that would cover the next one.
pub(super) fn cut_at_front() -> Vec<Scenario> {
    const DATA: [u8; 8] = [0xFF, 0xFF, 0xFD, 0x01, 0x10, 0x00, 0x55, 0x00];
    let of = |kind: Kind, lost: usize| {
        let rest = frame(&kind.packet(&DATA)).split_off(lost);
        let has_header = rest.windows(4).any(|window| window == [0xFF, 0xFF, 0xFD, 0xFD]);
        let requirement = if has_header { NO_HEADER } else { FOUND };
        let parts = move || {
            let [one, two] = [1, 2].map(|number| Part::Packet(kind.numbered(number)));
            vec![Part::Other(rest.clone()), one, two]
        };
        let name = format!("stuffed-cut.{kind}.without-{lost}");
        Scenario::new(name, requirement, &[Cut::ByPart, Cut::Every(1)], parts)
    };
    let losses = |kind: Kind| 1..frame(&kind.packet(&DATA)).len();
    KINDS.into_iter().flat_map(|kind| losses(kind).map(move |lost| of(kind, lost))).collect()
}
