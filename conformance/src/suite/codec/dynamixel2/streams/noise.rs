//! Bytes of headers, and damaged packets, between good packets.

use super::{Cut, FOUND, KINDS, Kind, Part, Scenario, frame};
use crate::suite::{changed, hex};

const CUTS: &[Cut] = &[Cut::ByPart, Cut::Every(7), Cut::Every(1)];

/// The same bytes before each of three packets.
pub(super) fn between() -> Vec<Scenario> {
    const NOISE: [&[u8]; 16] = [
        &[0xFF],
        &[0xFF; 2],
        &[0xFF; 3],
        &[0xFF; 4],
        &[0xFF; 8],
        &[0xFF; 64],
        &[0xFD],
        &[0xFF, 0xFD],
        &[0xFF, 0xFF, 0xFD],
        &[0xFF, 0xFF, 0xFF, 0xFD],
        &[0xFF, 0xFF, 0x00],
        &[0xFF, 0xFF, 0xFD, 0x01],
        &[0xFF, 0xFE, 0xFD, 0x00],
        &[0x00],
        &[0x55],
        &[0x12; 300],
    ];
    let of = |kind: Kind, noise: &'static [u8]| {
        let parts = move || {
            let part = |number| [Part::Other(noise.to_vec()), Part::Packet(kind.numbered(number))];
            (1..=3).flat_map(part).collect()
        };
        let (first, rest) = noise.split_at(noise.len().min(4));
        let more = if rest.is_empty() { String::new() } else { format!("-of-{}", noise.len()) };
        let name = format!("noise.{kind}.{}{more}", hex(first));
        // Bytes of headers, few enough to cut the stream at each place.
        let everywhere = noise.starts_with(&[0xFF]) && rest.is_empty();
        Scenario::new(name, FOUND, CUTS, parts).cut_everywhere(everywhere)
    };
    KINDS.into_iter().flat_map(|kind| NOISE.map(|noise| of(kind, noise))).collect()
}

/// The place of a byte in a packet of this size.
type Place = fn(usize) -> usize;

/// Many packets of which each third is damaged, without damage to its length.
pub(super) fn damaged() -> Vec<Scenario> {
    const PLACES: [(&str, Place); 5] = [
        ("header", |_| 1),
        ("reserved", |_| 3),
        ("instruction", |_| 7),
        ("params", |size| size - 4),
        ("crc", |size| size - 1),
    ];
    let of = |kind: Kind, number: u8, (place, at): (&str, Place)| {
        let part = move |each: u8| {
            let packet = kind.numbered(each);
            if each % 3 != 1 {
                return Part::Packet(packet);
            }
            let bytes = frame(&packet);
            Part::Other(changed(&bytes, at(bytes.len()), |byte| byte ^ 0x20))
        };
        let name = format!("damaged.{kind}.{place}.{number}");
        Scenario::new(name, FOUND, CUTS, move || (0..number).map(part).collect())
    };
    let each = |kind| {
        let places = PLACES.into_iter();
        places.flat_map(move |place| [6, 12, 40].map(|number| of(kind, number, place)))
    };
    KINDS.into_iter().flat_map(each).collect()
}
