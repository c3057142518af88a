//! Packets that break one rule of the receive procedure each, and the packets after them. Fast status
//! packets are in `fast.rs`, streams in `streams`.
//!
//! Behaviour that the documents leave unspecified is in `unspecified.rs`.

use actucheck_spec::wire::Direction;
use actucheck_spec::wire::dynamixel2::{Packet, reference};

use crate::suite::check::Check;
use crate::suite::plan::{Family, Group};
use crate::suite::{Author, changed};

pub(super) fn family(author: Author<'_>) -> Family<'_> {
    Family::new("dynamixel2.negative.", move || broken(author))
}

/// Each packet as it is, then damaged. The remains of a damaged packet must not affect the next one,
/// so one subject is asked them all in order.
fn broken(author: Author<'_>) -> impl Iterator<Item = Group<'_>> {
    packets().into_iter().map(move |(name, packet)| {
        let stem = format!("dynamixel2.negative.{name}.");
        let frame = reference::encode(&packet).unwrap_or_default();
        let direction = author.wire.direction(&packet.into());
        let requirement = match direction {
            Direction::Request => "dynamixel2.packet.layout",
            Direction::Reply => "dynamixel2.status-packet.layout",
        };
        let good = format!("{stem}good/decode");
        let mut checks = vec![author.decoded(good.clone(), requirement, direction, frame.clone())];
        for (fault, requirement, bytes) in damaged(&frame) {
            let id = format!("{stem}{fault}");
            checks.push(author.decoded(format!("{id}/decode"), requirement, direction, bytes));
            let id = format!("{id}/decode-good-after");
            let requirement = "dynamixel2.receive.stream";
            let after = author.decoded(id, requirement, direction, frame.clone());
            checks.push(Check { requires: Some(good.clone()), ..after });
        }
        Group::of(stem, checks)
    })
}

/// A packet of each kind, one of them stuffed.
fn packets() -> [(&'static str, Packet); 3] {
    let status = |params: &[u8]| {
        let params = params.to_vec().into();
        Packet::Status { id: 1, error: 0, params }
    };
    let params = vec![0x34, 0x02, 0xD0, 0x07, 0x00, 0x00].into();
    [
        ("status", status(&[0xA6, 0x00, 0x00, 0x00])),
        ("status-stuffed", status(&[0xFF, 0xFF, 0xFD, 0xFF])),
        ("write", Packet::Instruction { id: 1, instruction: 0x03, params }),
    ]
}

/// A frame with each kind of damage, its name, and the requirement that it breaks.
fn damaged(frame: &[u8]) -> Vec<(String, &'static str, Vec<u8>)> {
    let mut list = Vec::new();
    let replaced = |at, byte| changed(frame, at, |_| byte);
    let mut add = |name: String, requirement, bytes| list.push((name, requirement, bytes));

    for (at, bytes) in [(0, [0xFE, 0x00]), (1, [0xFE, 0x00]), (2, [0xFC, 0xFF])] {
        for byte in bytes {
            let name = format!("header-{at}-{byte:02x}");
            add(name, "dynamixel2.receive.header", with_crc(replaced(at, byte)));
        }
    }
    for byte in [0xFD, 0xFF, 0x01] {
        let bytes = with_crc(replaced(3, byte));
        add(format!("reserved-{byte:02x}"), "dynamixel2.packet.reserved", bytes);
    }
    let [low, high] = [frame.get(5), frame.get(6)].map(|byte| byte.copied().unwrap_or_default());
    for byte in [0, 1, 2, low - 1, low + 1, 0xFF] {
        let bytes = with_crc(replaced(5, byte));
        add(format!("length-low-{byte:02x}"), "dynamixel2.receive.length", bytes);
    }
    for byte in [high + 1, 0xFF] {
        let bytes = with_crc(replaced(6, byte));
        add(format!("length-high-{byte:02x}"), "dynamixel2.receive.length", bytes);
    }
    for end in 0..frame.len() {
        let bytes = frame.get(..end).unwrap_or_default().to_vec();
        add(format!("cut-at-{end}"), "dynamixel2.receive.length", bytes);
    }
    for at in 0..frame.len() {
        for bit in 0..8 {
            let requirement = match at {
                0..3 => "dynamixel2.receive.header",
                3 => "dynamixel2.packet.reserved",
                _ => "dynamixel2.receive.crc",
            };
            add(
                format!("flip-{at}-{bit}"),
                requirement,
                changed(frame, at, |byte| byte ^ 1 << bit),
            );
        }
    }
    list
}

/// The same bytes with a matching CRC.
fn with_crc(mut frame: Vec<u8>) -> Vec<u8> {
    reference::repair(&mut frame);
    frame
}
