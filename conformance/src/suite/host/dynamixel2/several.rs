//! Devices that are missing, swapped or damaged among several that are read at once.

use actucheck_spec::wire::dynamixel2::Packet;

use super::{BROADCAST, NO_ANSWER, burst, data, instruction, status, step};
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
    let parameters = "dynamixel2.status-packet.parameters";
    let (all, without_second) = (&[1, 2, 3][..], &[1, 3][..]);
    [
        ("first-missing", parameters, [&second[..], &third].concat(), &[2, 3][..]),
        ("second-missing", parameters, [&first[..], &third].concat(), without_second),
        ("last-missing", parameters, [&first[..], &second].concat(), &[1, 2]),
        ("swapped", parameters, [&second[..], &first, &third].concat(), all),
        (
            "damaged",
            "dynamixel2.receive.crc",
            [&first[..], &damaged, &third].concat(),
            without_second,
        ),
    ]
    .into_iter()
    .map(|(name, requirement, played, there)| {
        let there = DEVICES.iter().filter(|(id, _)| there.contains(id));
        let devices = there.map(|(id, held)| data(*id, held)).collect();
        let due = Due { devices, partly: true, or: NO_ANSWER.to_vec() };
        let steps = vec![step(packet.clone(), vec![vec![burst(played)]])];
        let id = format!("dynamixel2.host.{call}.{name}/result");
        author.returned(id, requirement, steps, due)
    })
    .collect()
}
