//! Devices that are missing, swapped or damaged among several that are read at once.

use actucheck_spec::wire::dynamixel2::{Block, Packet, WIRE};

use super::{BROADCAST, NO_ANSWER, all, burst, data, failed, frame, instruction, status, step};
use crate::suite::check::Check;
use crate::suite::due::Due;
use crate::suite::{Author, changed};

/// Three devices, and what each of them holds.
const DEVICES: [(u8, [u8; 4]); 3] =
    [(1, [0xA6, 0x01, 0x02, 0x83]), (2, [0x17, 0x28, 0x39, 0x4A]), (3, [0x61, 0x72, 0x03, 0x14])];

/// Sync Read.
pub(super) fn sync(author: &Author<'_>) -> Vec<Check> {
    let register = [132_u16, 4].map(u16::to_le_bytes).concat();
    let ids = DEVICES.map(|(id, _)| id);
    checks(author, "sync-read", &instruction(BROADCAST, 0x82, [&register[..], &ids].concat()))
}

/// Bulk Read.
pub(super) fn bulk(author: &Author<'_>) -> Vec<Check> {
    let register = [132_u16, 4].map(u16::to_le_bytes).concat();
    let devices = DEVICES.map(|(id, _)| [&[id], &register[..]].concat()).concat();
    checks(author, "bulk-read", &instruction(BROADCAST, 0x92, devices))
}

fn checks(author: &Author<'_>, call: &str, packet: &Packet) -> Vec<Check> {
    let [first, second, third] = DEVICES.map(|(id, held)| status(id, 0, &held));
    let damaged = changed(&second, 9, |byte| byte ^ 0x10);
    let uninvited = status(9, 0, &[0x5A; 4]);
    let (stream, parameters) = ("dynamixel2.receive.stream", "dynamixel2.status-packet.parameters");
    // What is missing may be told by an error, but what has come is not lost without one.
    let missing = [
        ("first-missing", vec![&second, &third], &[2, 3][..]),
        ("second-missing", vec![&first, &third], &[1, 3]),
        ("last-missing", vec![&first, &second], &[1, 2]),
    ];
    let partly = [
        ("swapped", parameters, vec![&second, &first, &third], &[1, 2, 3][..]),
        ("damaged", "dynamixel2.receive.crc", vec![&first, &damaged, &third], &[1, 3]),
        ("uninvited", parameters, vec![&first, &uninvited, &second, &third], &[1, 2, 3]),
    ];
    let asked = |played: &[&Vec<u8>]| {
        step(
            packet.clone(),
            vec![vec![burst(played.iter().copied().flatten().copied().collect::<Vec<_>>())]],
        )
    };
    let id = |name: &str| format!("dynamixel2.host.{call}.{name}/result");
    let mut checks = Vec::new();
    for (name, played, there) in missing {
        let due = Due { or: NO_ANSWER.to_vec(), ..these(there) };
        checks.push(author.returned(id(name), stream, vec![asked(&played)], due));
    }
    for (name, requirement, played, there) in partly {
        let due = Due { partly: true, or: NO_ANSWER.to_vec(), ..these(there) };
        checks.push(author.returned(id(name), requirement, vec![asked(&played)], due));
    }
    let before = DEVICES.map(|(id, _)| status(id, 0, &[0x5A; 4]));
    let steps = vec![asked(&before.iter().collect::<Vec<_>>()), asked(&[&first, &third])];
    let due = Due { partly: true, or: NO_ANSWER.to_vec(), ..these(&[1, 3]) };
    checks.push(author.returned(id("missing-after-right"), parameters, steps, due));
    checks
}

/// What these devices hold.
fn these(ids: &[u8]) -> Due {
    let there = DEVICES.iter().filter(|(id, _)| ids.contains(id));
    all(there.map(|(id, held)| data(*id, held)).collect::<Vec<_>>())
}

/// Fast Sync Read, whose devices answer with one packet.
pub(super) fn fast(author: &Author<'_>) -> Vec<Check> {
    let register = [132_u16, 4].map(u16::to_le_bytes).concat();
    let packet = instruction(BROADCAST, 0x8A, [&register[..], &[1, 2]].concat());
    let [first, second, _] = DEVICES;
    let pattern = [0xFF, 0xFF, 0xFD, 0xFD];
    let right = blocks(&[first, second]);
    // The first CRC follows the first block's data.
    let mut damaged = changed(&right, 14, |byte| byte ^ 0x10);
    WIRE.repair(&mut damaged);
    let last = changed(&right, right.len() - 1, |byte| byte ^ 0x10);
    let status = "ja40.fast-sync-read.status";
    let swapped = Due { partly: true, or: NO_ANSWER.to_vec(), ..these(&[1, 2]) };
    let raw = all([data(1, &pattern), data(2, &second.1)]);
    [
        ("swapped", status, blocks(&[second, first]), swapped),
        ("first-crc", status, damaged, Due { partly: true, or: NO_ANSWER.to_vec(), ..these(&[2]) }),
        ("last-crc", status, last, failed()),
        ("pattern", "ja40.fast-sync-read.unstuffed", blocks(&[(1, pattern), second]), raw),
    ]
    .into_iter()
    .map(|(name, requirement, played, due)| {
        let answer = vec![burst(played)];
        let steps = vec![step(packet.clone(), vec![answer.clone(), answer.clone(), answer])];
        let id = format!("dynamixel2.host.fast-sync-read.{name}/result");
        author.returned(id, requirement, steps, due)
    })
    .collect()
}

fn blocks(held: &[(u8, [u8; 4])]) -> Vec<u8> {
    let block =
        |(id, data): &(u8, [u8; 4])| Block { error: 0, id: *id, data: data.to_vec().into() };
    frame(Packet::FastStatus { blocks: held.iter().map(block).collect() })
}
