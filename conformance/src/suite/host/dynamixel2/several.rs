//! Devices that are missing, swapped or damaged among several that are read at once.

use actucheck_spec::wire::dynamixel2::{Block, Packet, WIRE};

use super::faults::{CRC, FIELDS, PARAMETERS, STREAM};
use super::{
    BROADCAST, NO_ANSWER, Right, all, block, burst, data, failed, frame, instruction, status, step,
};
use crate::adapter::{Reported, Trouble};
use crate::suite::check::Check;
use crate::suite::due::Due;
use crate::suite::{Author, changed};

/// Three devices, and what each of them holds.
const DEVICES: [(u8, [u8; 4]); 3] =
    [(1, [0xA6, 0x01, 0x02, 0x83]), (2, [0x17, 0x28, 0x39, 0x4A]), (3, [0x61, 0x72, 0x03, 0x14])];

/// Data Limit Error.
const ERROR: u8 = 6;

/// The checks of a call that reads several devices.
pub(super) fn checks(author: &Author<'_>, right: &Right) -> Vec<Check> {
    let register = [132_u16, 4].map(u16::to_le_bytes).concat();
    let call = right.name();
    let params = match call.as_str() {
        "sync-read" => [&register[..], &DEVICES.map(|(id, _)| id)].concat(),
        "bulk-read" => DEVICES.map(|(id, _)| [&[id], &register[..]].concat()).concat(),
        "fast-sync-read" => return fast(author),
        _ => return Vec::new(),
    };
    let code = if call == "sync-read" { 0x82 } else { 0x92 };
    of_packets(author, &call, &instruction(BROADCAST, code, params))
}

fn of_packets(author: &Author<'_>, call: &str, packet: &Packet) -> Vec<Check> {
    let [first, second, third] = DEVICES.map(|(id, held)| status(id, 0, &held));
    let damaged = changed(&second, 9, |byte| byte ^ 0x10);
    let uninvited = status(9, 0, &[0x5A; 4]);
    // What is missing may be told by an error, but what has come is not lost without one.
    let missing = [
        ("first-missing", vec![&second, &third], &[2, 3][..]),
        ("second-missing", vec![&first, &third], &[1, 3]),
        ("last-missing", vec![&first, &second], &[1, 2]),
    ];
    let partly = [
        ("swapped", PARAMETERS, vec![&second, &first, &third], &[1, 2, 3][..]),
        ("damaged", CRC, vec![&first, &damaged, &third], &[1, 3]),
        ("uninvited", PARAMETERS, vec![&first, &uninvited, &second, &third], &[1, 2, 3]),
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
        checks.push(author.returned(id(name), STREAM, vec![asked(&played)], due));
    }
    for (name, requirement, played, there) in partly {
        let due = Due { partly: true, or: NO_ANSWER.to_vec(), ..these(there) };
        checks.push(author.returned(id(name), requirement, vec![asked(&played)], due));
    }
    let before = DEVICES.map(|(id, _)| status(id, 0, &[0x5A; 4]));
    let steps = vec![asked(&before.iter().collect::<Vec<_>>()), asked(&[&first, &third])];
    let due = Due { partly: true, or: NO_ANSWER.to_vec(), ..these(&[1, 3]) };
    checks.push(author.returned(id("missing-after-right"), PARAMETERS, steps, due));
    for (name, bad, played) in [
        ("error-of-first", 1, [&refusal(1), &second, &third]),
        ("error-of-second", 2, [&first, &refusal(2), &third]),
    ] {
        let due = one_refuses(&[1, 2, 3], bad);
        checks.push(author.returned(id(name), FIELDS, vec![asked(&played)], due));
    }
    checks
}

/// The answer of a device that refuses.
fn refusal(id: u8) -> Vec<u8> {
    status(id, ERROR, &[])
}

/// What is due if one of these devices refuses. Its user learns of it, as of the answer to a Read.
fn one_refuses(ids: &[u8], bad: u8) -> Due {
    let mut due = Due { or: vec![Trouble::Status], ..these(ids) };
    for device in due.devices.iter_mut().flatten().filter(|device| device.id == bad) {
        *device = Reported { id: bad, error: Some(ERROR), ..Reported::default() };
    }
    due
}

/// What these devices hold.
fn these(ids: &[u8]) -> Due {
    let there = DEVICES.iter().filter(|(id, _)| ids.contains(id));
    all(there.map(|(id, held)| data(*id, held)).collect::<Vec<_>>())
}

/// Fast Sync Read, whose devices answer with one packet.
fn fast(author: &Author<'_>) -> Vec<Check> {
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
    let refuses = Packet::FastStatus {
        blocks: vec![block(1, &first.1), Block { error: ERROR, ..block(2, &second.1) }],
    };
    let swapped = Due { partly: true, or: NO_ANSWER.to_vec(), ..these(&[1, 2]) };
    let raw = all([data(1, &pattern), data(2, &second.1)]);
    [
        ("swapped", status, blocks(&[second, first]), swapped),
        ("first-crc", status, damaged, Due { partly: true, or: NO_ANSWER.to_vec(), ..these(&[2]) }),
        ("last-crc", status, last, failed()),
        ("pattern", "ja40.fast-sync-read.unstuffed", blocks(&[(1, pattern), second]), raw),
        ("error-of-second", FIELDS, frame(refuses), one_refuses(&[1, 2], 2)),
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
    frame(Packet::FastStatus { blocks: held.iter().map(|(id, data)| block(*id, data)).collect() })
}
