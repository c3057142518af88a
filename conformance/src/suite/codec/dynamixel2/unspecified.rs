//! Questions that the DYNAMIXEL and JA40 documents leave unspecified. The answers are not judged;
//! they are the subject's profile.

use actucheck_spec::model::HexBytes;
use actucheck_spec::wire::Direction;
use actucheck_spec::wire::dynamixel2::Packet;
use actucheck_spec::wire::dynamixel2::reference::{self, BROADCAST, STATUS};

use crate::adapter::{Output, Question};
use crate::suite::check::{Check, Demand};
use crate::suite::{Author, changed, hex};

pub(super) fn checks(author: &Author<'_>) -> Vec<Check> {
    let mut checks = bare_patterns(author);
    checks.push(broadcast(author));
    checks.extend(repeated_ids(author));
    checks.extend(two_faults(author));
    checks
}

fn record(author: &Author<'_>, id: &str, requirement: &str, op: Question, demand: Demand) -> Check {
    let id = format!("dynamixel2.open.{id}/{}", op.name());
    author.check(id, requirement, op, demand)
}

/// Reads a status packet.
fn decode(author: &Author<'_>, bytes: Vec<u8>) -> Question {
    Question::Decode { wire: author.wire, bytes: bytes.into(), context: Direction::Reply.into() }
}

fn bytes(bytes: &[u8]) -> HexBytes {
    bytes.to_vec().into()
}

fn status(id: u8, params: &[u8]) -> Packet {
    Packet::Status { id, error: 0, params: bytes(params) }
}

/// FF FF FD in a body without the FD that a sender must add.
fn bare_patterns(author: &Author<'_>) -> Vec<Check> {
    let question = "What is FF FF FD in a received body, without the FD that stuffing adds?";
    let requirement = "dynamixel2.stuffing.receive";
    let mut checks = Vec::new();
    for data in [&[0xFF, 0xFF, 0xFD][..], &[0xFF, 0xFF, 0xFD, 0x01], &[1, 0xFF, 0xFF, 0xFD, 0, 2]] {
        let end = data.windows(3).position(|window| window == [0xFF, 0xFF, 0xFD]).unwrap_or(0) + 3;
        let without =
            [data.get(..end), data.get(end + 1..)].map(Option::unwrap_or_default).concat();
        let demand = |of: &dyn Fn(&[u8]) -> Output| {
            Demand::record(
                question,
                [("data as it is", of(data)), ("the byte behind it is dropped", of(&without))],
            )
        };
        let name = format!("bare-pattern.{}", hex(data));
        let op = Question::Unstuff { wire: author.wire, bytes: bytes(data) };
        let body = demand(&|data| Output::Bytes(bytes(data)));
        checks.push(record(author, &name, requirement, op, body));
        let frame = reference::frame(1, &[&[STATUS, 0], data].concat());
        let packet = demand(&|data| Output::Packet(status(1, data).into()));
        checks.push(record(author, &name, requirement, decode(author, frame), packet));
    }
    checks
}

/// A status packet from the broadcast ID.
fn broadcast(author: &Author<'_>) -> Check {
    let question = "Is a status packet with ID 254 read where no fast one is asked for?";
    let packet = status(BROADCAST, &[0x2A]);
    let frame = reference::frame(BROADCAST, &[STATUS, 0, 0x2A]);
    let demand = Demand::record(question, [("accepts it", Output::Packet(packet.into()))]);
    let requirement = "dynamixel2.status-packet.layout";
    record(author, "id.254.status", requirement, decode(author, frame), demand)
}

fn encode(author: &Author<'_>, packet: Packet) -> Question {
    Question::Encode { wire: author.wire, packet: packet.into() }
}

/// An instruction that names a device twice. A host must not send it; whether a codec refuses to
/// build it is unspecified.
fn repeated_ids(author: &Author<'_>) -> Vec<Check> {
    let cases: [(&str, u8, &[u8]); 4] = [
        ("sync-read", 0x82, &[0x44, 0x02, 0x04, 0x00, 1, 1]),
        ("sync-write", 0x83, &[0x34, 0x02, 0x01, 0x00, 1, 0xA0, 1, 0xA1]),
        ("bulk-read", 0x92, &[1, 0x44, 0x02, 0x04, 0x00, 1, 0x34, 0x02, 0x04, 0x00]),
        ("bulk-write", 0x93, &[1, 0x34, 0x02, 0x01, 0x00, 0xA0, 1, 0x35, 0x02, 0x01, 0x00, 0xA1]),
    ];
    let check = |(name, instruction, params): (&str, u8, &[u8])| {
        let packet = Packet::Instruction { id: BROADCAST, instruction, params: bytes(params) };
        let frame = reference::encode(&packet).unwrap_or_default();
        let question = "Is an instruction that names a device twice built?";
        let demand = Demand::record(question, [("builds it", Output::Bytes(frame.into()))]);
        let requirement = match name {
            "bulk-read" => "dynamixel2.bulk-read.no-repeat",
            "bulk-write" => "dynamixel2.bulk-write.no-repeat",
            "sync-read" => "dynamixel2.sync-read.parameters",
            _ => "dynamixel2.sync-write.parameters",
        };
        record(author, &format!("repeated-id.{name}"), requirement, encode(author, packet), demand)
    };
    cases.map(check).into()
}

/// A packet that breaks two rules: the documents do not say which one is reported.
fn two_faults(author: &Author<'_>) -> Vec<Check> {
    let question = |faults: &str| format!("Which fault is named of a packet with {faults}?");
    let accepted = |params: &[u8]| [("accepts it", Output::Packet(status(1, params).into()))];
    let bare = reference::frame(1, &[STATUS, 0, 0xFF, 0xFF, 0xFD, 1]);
    let plain = reference::frame(1, &[STATUS, 0, 0x2A]);
    let replaced = |frame: &[u8], at: usize, value: u8| changed(frame, at, |_| value);
    let last = |frame: &[u8]| frame.len().saturating_sub(1);
    let cases = [
        (
            "crc-stuffing",
            "a wrong CRC and a bare pattern",
            replaced(&bare, last(&bare), 0),
            &[0xFF, 0xFF, 0xFD, 1][..],
        ),
        ("header-crc", "a wrong header and a wrong CRC", replaced(&plain, 0, 0), &[0x2A]),
        ("id-crc", "ID 255 and a wrong CRC", replaced(&plain, 4, 255), &[0x2A]),
        ("length-crc", "too small a length and a wrong CRC", replaced(&plain, 5, 2), &[0x2A]),
    ];
    let check = |(name, faults, frame, params): (&str, &str, Vec<u8>, &[u8])| {
        let demand = Demand::record(&question(faults), accepted(params));
        let id = format!("two-faults.{name}");
        record(author, &id, "dynamixel2.receive.crc", decode(author, frame), demand)
    };
    cases.map(check).into()
}
