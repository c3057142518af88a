//! The CRC after bodies that end in the pattern of byte stuffing or in a part of it. It is never
//! stuffed itself.

use actucheck_spec::wire::dynamixel2::Packet;
use actucheck_spec::wire::dynamixel2::reference::{self, PREFIX};

use super::BOTH_WAYS;
use super::kind::Kind;
use crate::suite::check::Check;
use crate::suite::plan::{Family, Group};
use crate::suite::{Author, hex};

/// The end of the data, and the bytes of the CRC.
const ENDS: [(&[u8], [u8; 2]); 17] = [
    (&[], [0x00, 0x01]),
    (&[], [0x01, 0x00]),
    (&[], [0x00, 0xFF]),
    (&[], [0xFF, 0x00]),
    (&[], [0x00, 0x00]),
    (&[], [0xFF, 0xFF]),
    (&[], [0xFD, 0xFF]),
    (&[], [0xFF, 0xFD]),
    // The CRC ends a pattern, which is the beginning of a header too.
    (&[0xFF], [0xFF, 0xFD]),
    (&[0xFF, 0xFF], [0xFD, 0x00]),
    (&[0xFF, 0xFF], [0xFD, 0x01]),
    (&[0xFF, 0xFF], [0xFD, 0xFD]),
    // The CRC follows a pattern.
    (&[0xFF, 0xFF, 0xFD], [0xFD, 0x00]),
    (&[0xFF, 0xFF, 0xFD], [0xFD, 0xFD]),
    (&[0xFF, 0xFF, 0xFD], [0x00, 0xFD]),
    (&[0xFF, 0xFF, 0xFD], [0xFF, 0xFF]),
    (&[0xFF, 0xFF, 0xFD, 0xFD], [0xFD, 0xFD]),
];

pub(super) fn families(author: Author<'_>) -> [Family<'_>; 2] {
    const PREFIX: &str = "dynamixel2.crc.behind-";
    [
        Family::new(PREFIX, move || {
            let kinds = Kind::ALL.into_iter();
            kinds.flat_map(|kind| ENDS.map(|(end, crc)| (kind, end, crc))).map(
                move |(kind, end, crc)| {
                    let stem = format!("{PREFIX}{}.{}.{kind}", hex(end), hex(&crc));
                    Group::new(stem, &BOTH_WAYS, move |stem| {
                        let requirement = match end {
                            [] => "dynamixel2.crc.byte-order",
                            _ => "dynamixel2.stuffing.covers",
                        };
                        author.both_ways(stem, requirement, &ending(kind, end, crc))
                    })
                },
            )
        }),
        Family::of("dynamixel2.crc.before-stuffing.", move || {
            Kind::ALL.map(|kind| before_stuffing(&author, kind)).into()
        }),
    ]
}

/// Every such packet.
pub(crate) fn packets() -> Vec<Packet> {
    let kinds = Kind::ALL.into_iter();
    kinds.flat_map(|kind| ENDS.map(|(end, crc)| ending(kind, end, crc))).collect()
}

/// A packet with this end and this CRC, for which two bytes before the end are chosen.
fn ending(kind: Kind, end: &[u8], crc: [u8; 2]) -> Packet {
    let length = kind.before_data() + 2 + end.len();
    let with = |chosen: [u8; 2]| {
        let mut packet = kind.with_body(length, None);
        let (Packet::Instruction { params, .. } | Packet::Status { params, .. }) = &mut packet
        else {
            return packet;
        };
        params.0.truncate(params.len().saturating_sub(2 + end.len()));
        params.0.extend(chosen);
        params.0.extend(end);
        packet
    };
    let frame = reference::encode(&with([0, 0])).unwrap_or_default();
    let (front, behind) = frame.split_at((PREFIX + kind.before_data()).min(frame.len()));
    let end = behind.get(2..behind.len().saturating_sub(2)).unwrap_or_default();
    with(chosen(front, end, u16::from_le_bytes(crc)))
}

/// The two bytes between `front` and `end` with which the CRC is this one: the steps of the
/// division, undone from the end.
fn chosen(front: &[u8], end: &[u8], crc: u16) -> [u8; 2] {
    let step = |crc: u16| if crc & 1 == 0 { crc >> 1 } else { (crc ^ 0x8005) >> 1 | 0x8000 };
    let byte = |crc: u16| (0..8).fold(crc, |crc, _| step(crc));
    let before = |crc, end: &u8| byte(crc) ^ u16::from(*end) << 8;
    let before_end = end.iter().rev().fold(crc, before);
    (byte(byte(before_end)) ^ reference::crc(front)).to_be_bytes()
}

/// A packet whose CRC was computed before stuffing.
fn before_stuffing(author: &Author<'_>, kind: Kind) -> Check {
    let body = match kind {
        Kind::Write => &[0x03, 0x74, 0x00, 0xFF, 0xFF, 0xFD, 0x01][..],
        Kind::Status => &[0x55, 0x00, 0xFF, 0xFF, 0xFD, 0x01],
    };
    let plain = reference::frame(1, body);
    let mut frame = reference::frame(1, &reference::stuff(body));
    frame.truncate(frame.len().saturating_sub(2));
    frame.extend(plain.iter().skip(plain.len().saturating_sub(2)));
    let packet = kind.with_body(kind.before_data() + 1, None).into();
    let id = format!("dynamixel2.crc.before-stuffing.{kind}/decode");
    author.decoded(id, "dynamixel2.stuffing.crc", author.wire.direction(&packet), frame)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_chosen_bytes_make_the_crc() {
        for kind in Kind::ALL {
            for (end, crc) in ENDS {
                let frame = reference::encode(&ending(kind, end, crc)).unwrap();
                let end = [&reference::stuff(end), crc.as_slice()].concat();
                assert!(frame.ends_with(&end), "{frame:02x?} {end:02x?}");
            }
        }
    }
}
