//! Checks of single instructions and their answers: for each sentence of the documents, packets
//! that come out wrong if the sentence is not followed.

use actucheck_spec::wire::dynamixel2::Packet;
use actucheck_spec::wire::dynamixel2::reference::BROADCAST;

use crate::suite::Author;
use crate::suite::check::Check;

pub(super) fn checks(author: &Author<'_>) -> Vec<Check> {
    let mut checks = Vec::new();
    for (requirement, name, packet) in packets() {
        let (document, rest) = requirement.split_once('.').unwrap_or(("", requirement));
        let id = format!("{document}.said.{rest}.{name}");
        checks.extend(author.both_ways(&id, requirement, &packet));
    }
    checks
}

/// The requirement, a name, and a packet that follows it.
fn packets() -> Vec<(&'static str, &'static str, Packet)> {
    // Registers at 580 and 564 are those of the JA40; addresses below 256 are from the DYNAMIXEL
    // document.
    let to_all = |code, params: &[u8]| instruction(BROADCAST, code, params);
    vec![
        ("dynamixel2.packet.parameters", "read", instruction(1, 0x02, &[0x84, 0, 4, 0])),
        ("dynamixel2.packet.parameters", "write", instruction(1, 0x03, &[0x84, 0, 4, 0])),
        ("dynamixel2.packet.parameters", "reg-write", instruction(1, 0x04, &[0x84, 0, 4, 0])),
        ("dynamixel2.status-packet.parameters", "of-write", status(&[])),
        ("dynamixel2.status-packet.parameters", "of-ping", status(&[0x06, 0x04, 0x26])),
        ("dynamixel2.status-packet.parameters", "of-read", status(&[0xA6, 0, 0, 0])),
        ("dynamixel2.sync-read.broadcast-id", "one", to_all(0x82, &[132, 0, 4, 0, 7])),
        ("dynamixel2.sync-read.broadcast-id", "two", to_all(0x82, &[132, 0, 4, 0, 7, 3])),
        ("dynamixel2.sync-read.same-registers", "three", to_all(0x82, &[132, 0, 4, 0, 7, 3, 9])),
        ("dynamixel2.sync-write.broadcast-id", "one", to_all(0x83, &[64, 0, 1, 0, 7, 1])),
        ("dynamixel2.sync-write.broadcast-id", "two", to_all(0x83, &[64, 0, 1, 0, 7, 1, 3, 0])),
        ("dynamixel2.bulk-read.broadcast-id", "one", to_all(0x92, &[7, 132, 0, 4, 0])),
        (
            "dynamixel2.bulk-read.parameters",
            "three-registers",
            to_all(0x92, &[7, 132, 0, 4, 0, 3, 126, 0, 2, 0, 9, 146, 0, 1, 0]),
        ),
        ("dynamixel2.bulk-write.broadcast-id", "one", to_all(0x93, &[7, 64, 0, 1, 0, 1])),
        (
            "dynamixel2.bulk-write.parameters",
            "two-registers",
            to_all(0x93, &[7, 64, 0, 1, 0, 1, 3, 102, 0, 2, 0, 0x2A, 0x01]),
        ),
        ("ja40.fast-sync-read.broadcast-id", "one", to_all(0x8A, &[0x44, 0x02, 4, 0, 7])),
        ("ja40.fast-sync-read.broadcast-id", "two", to_all(0x8A, &[132, 0, 4, 0, 7, 3])),
        ("ja40.fast-sync-read.same-registers", "three", to_all(0x8A, &[132, 0, 4, 0, 7, 3, 9])),
        ("ja40.fast-sync-write.broadcast-id", "one", to_all(0x8B, &[64, 0, 1, 0, 7, 1])),
        ("ja40.fast-sync-write.broadcast-id", "two", to_all(0x8B, &[64, 0, 1, 0, 7, 1, 3, 0])),
        (
            "ja40.fast-sync-write.same-registers",
            "three",
            to_all(0x8B, &[64, 0, 1, 0, 7, 1, 3, 0, 9, 1]),
        ),
    ]
}

fn instruction(id: u8, instruction: u8, params: &[u8]) -> Packet {
    Packet::Instruction { id, instruction, params: params.to_vec().into() }
}

fn status(params: &[u8]) -> Packet {
    Packet::Status { id: 1, error: 0, params: params.to_vec().into() }
}
