//! Single sentences of the documents, each by calls that show little else.

use actucheck_spec::wire::dynamixel2::{Packet, WIRE};

use super::{
    BROADCAST, Right, all, block, calls, data, failed, frame, instruction, read, status, step,
};
use crate::adapter::Reported;
use crate::suite::check::{Check, Demand};
use crate::suite::due::Due;
use crate::suite::{Author, changed};

/// The pattern of byte stuffing.
const PATTERN: [u8; 3] = [0xFF, 0xFF, 0xFD];
const TRANSMIT: &str = "dynamixel2.stuffing.transmit";
const RECEIVE: &str = "dynamixel2.stuffing.receive";
const ID: &str = "dynamixel2.receive.id";
/// The smallest number of data bytes that a Write's length can't tell, as it counts the instruction, the
/// address and the CRC too.
const TOO_MANY: usize = 0x1_0000 - 5;

/// The place of the stuffing in an answer whose data begin with the pattern.
const STUFFING: usize = 12;

/// A requirement, what comes after it in the check's id, and the packet that must be sent.
type Sent = (&'static str, String, Packet);
/// A requirement, what comes after it in the check's id, a call, and what answers it.
type Answered = (&'static str, String, Packet, Vec<u8>, Due);

pub(super) fn checks(author: &Author<'_>) -> Vec<Check> {
    let id = |requirement: &str, more: &str, about: &str| {
        let sentence = requirement.strip_prefix("dynamixel2.").unwrap_or(requirement);
        format!("dynamixel2.host.said.{sentence}{more}/{about}")
    };
    let sent = [parts(), codes(), to_several(), stuffed()].into_iter().flatten();
    let sent = sent.map(|(requirement, more, packet): Sent| {
        let answer = answer_to(&packet);
        let right = Right::new(packet, answer, Due::default(), [requirement; 2]);
        author.sent(id(requirement, &more, "sent"), requirement, vec![right.step()])
    });
    let answered = [in_one_packet(), stuffed_answers(), no_answers()].into_iter().flatten();
    let answered = answered.map(|(requirement, more, packet, answer, due): Answered| {
        let right = Right::new(packet, answer, due.clone(), [requirement; 2]);
        author.returned(id(requirement, &more, "result"), requirement, vec![right.step()], due)
    });
    let mut checks: Vec<_> = sent.chain(answered).collect();
    let limit = "dynamixel2.packet.length.limit";
    let too_long = vec![step(write(1, 116, &vec![0x5A; TOO_MANY]), Vec::new())];
    let too_long = author.sent(id(limit, "", "sent"), limit, too_long);
    checks.push(Check { demand: Demand::Withhold, ..too_long });
    checks
}

/// What a device answers, with some data if a Ping or a Read asks for them.
fn answer_to(packet: &Packet) -> Vec<u8> {
    match packet {
        Packet::Instruction { id: BROADCAST, .. } => Vec::new(),
        Packet::Instruction { id, instruction: 0x01, .. } => status(*id, 0, &[0x5A, 0x14, 0x26]),
        Packet::Instruction { id, instruction: 0x02, .. } => {
            status(*id, 0, &[0x11, 0x22, 0x33, 0x44])
        }
        Packet::Instruction { id, .. } => status(*id, 0, &[]),
        _ => Vec::new(),
    }
}

fn write(id: u8, address: u16, data: &[u8]) -> Packet {
    instruction(id, 0x03, [&address.to_le_bytes(), data].concat())
}

/// Parts of an instruction packet.
fn parts() -> Vec<Sent> {
    let covers = completed(|data| frame(write(1, 116, data)));
    let rows = [
        ("dynamixel2.packet.layout", write(17, 0x0102, &[3, 4, 5])),
        ("dynamixel2.packet.length", write(1, 116, &PATTERN.repeat(3))),
        ("dynamixel2.packet.length.byte-order", write(1, 116, &[0x5A; 300])),
        ("dynamixel2.packet.length.instruction", write(1, 116, &[0x5A])),
        ("dynamixel2.crc.value", write(1, 116, &[0; 40])),
        ("dynamixel2.crc.byte-order", write(1, 116, &[0x01, 0x02])),
        ("dynamixel2.stuffing.length", write(1, 116, &PATTERN.repeat(2))),
        ("dynamixel2.stuffing.crc", write(1, 116, &PATTERN)),
        ("dynamixel2.stuffing.covers", write(1, 116, &covers)),
    ];
    let mut rows: Vec<_> =
        rows.map(|(requirement, packet)| (requirement, String::new(), packet)).into();
    // The same parameters of two instructions.
    let parameters = "dynamixel2.packet.parameters";
    rows.push((parameters, ".read".to_owned(), read(1, 132, 4)));
    rows.push((parameters, ".write".to_owned(), write(1, 132, &[4, 0])));
    rows
}

/// Data that end with FF FF, before a CRC that begins with FD in a frame: a pattern that nobody stuffs.
fn completed(framed: impl Fn(&[u8]) -> Vec<u8>) -> Vec<u8> {
    let mut data = (0..=u16::MAX).map(|number| [&number.to_le_bytes()[..], &[0xFF, 0xFF]].concat());
    data.find(|data| framed(data).iter().rev().nth(1) == Some(&0xFD)).unwrap_or_default()
}

/// Each instruction, to a device that no other check has.
fn codes() -> Vec<Sent> {
    let code = |right: Right| {
        let name = format!(".{}", right.name());
        let Packet::Instruction { id, instruction: code, params } = right.packet else {
            return None;
        };
        let id = if id == BROADCAST { id } else { 17 };
        let requirement = match code {
            0x20 | 0x8A | 0x8B => "ja40.instruction.codes",
            _ => "dynamixel2.packet.instruction.codes",
        };
        Some((requirement, name, instruction(id, code, params.0)))
    };
    calls::every().into_iter().filter_map(code).collect()
}

/// Calls to several devices that name one, which go to the broadcast ID all the same; and the same registers
/// of three.
fn to_several() -> Vec<Sent> {
    let register = [132_u16, 4].map(u16::to_le_bytes).concat();
    let one = [&register[..], &[1]].concat();
    let of_one = [&[1], &register[..]].concat();
    let one_written = [&register[..], &[1, 0xA6, 0x01, 0x02, 0x83]].concat();
    let of_one_written = [&of_one[..], &[0xA6, 0x01, 0x02, 0x83]].concat();
    let three = [&register[..], &[1, 2, 3]].concat();
    let written = [1, 2, 3].map(|id| [id, 0xA6, id, 0x02, 0x83]).concat();
    let three_written = [&register[..], &written].concat();
    [
        ("dynamixel2.sync-read.broadcast-id", 0x82, one.clone()),
        ("dynamixel2.sync-write.broadcast-id", 0x83, one_written.clone()),
        ("dynamixel2.bulk-read.broadcast-id", 0x92, of_one),
        ("dynamixel2.bulk-write.broadcast-id", 0x93, of_one_written),
        ("ja40.fast-sync-read.broadcast-id", 0x8A, one),
        ("ja40.fast-sync-write.broadcast-id", 0x8B, one_written),
        ("ja40.fast-sync-read.same-registers", 0x8A, three),
        ("ja40.fast-sync-write.same-registers", 0x8B, three_written),
    ]
    .map(|(requirement, code, params)| {
        (requirement, String::new(), instruction(BROADCAST, code, params))
    })
    .into()
}

/// The pattern at each place of what a call writes.
fn stuffed() -> Vec<Sent> {
    let plain = [0x11, 0x22, 0x33, 0x44, 0x55, 0x66];
    let at = |place: usize| {
        let mut data = plain;
        data.iter_mut().skip(place).zip(PATTERN).for_each(|(byte, pattern)| *byte = pattern);
        data
    };
    let of_one = |code: u8, data: &[u8]| instruction(1, code, [&[0x74, 0x00], data].concat());
    let mut rows = Vec::new();
    for place in 0..=3 {
        for (call, code) in [("write", 0x03), ("reg-write", 0x04)] {
            rows.push((TRANSMIT, format!(".{call}.at-{place}"), of_one(code, &at(place))));
        }
        let (first, second) = (at(place), at(3 - place));
        let register = [0x74, 0x00, 0x06, 0x00];
        let sync = [&register[..], &[1], &first, &[2], &plain, &[3], &second].concat();
        let bulk = [&[1], &register[..], &first, &[2], &register, &second].concat();
        for (call, code, params) in [
            ("sync-write", 0x83, sync.clone()),
            ("bulk-write", 0x93, bulk),
            ("fast-sync-write", 0x8B, sync),
        ] {
            let packet = instruction(BROADCAST, code, params);
            rows.push((TRANSMIT, format!(".{call}.at-{place}"), packet));
        }
    }
    for (name, data) in [
        ("overlapping", &[0xFF, 0xFF, 0xFF, 0xFD, 0xFF, 0xFF, 0xFD][..]),
        ("like-stuffed", &[0xFF, 0xFF, 0xFD, 0xFD]),
        ("almost", &[0xFF, 0xFD, 0xFF, 0xFF, 0xFE]),
    ] {
        rows.push((TRANSMIT, format!(".write.{name}"), of_one(0x03, data)));
    }
    rows
}

/// Answers of one and of three devices in one packet.
fn in_one_packet() -> Vec<Answered> {
    let register = [132_u16, 4].map(u16::to_le_bytes).concat();
    let mut rows = Vec::new();
    for (name, ids) in [(".one", &[1][..]), (".three", &[1, 2, 3])] {
        let held = |id: u8| [0xA6, id, 0x02, 0x83];
        let asked = instruction(BROADCAST, 0x8A, [&register[..], ids].concat());
        let blocks = ids.iter().map(|id| block(*id, &held(*id))).collect();
        let due: Vec<_> = ids.iter().map(|id| data(*id, &held(*id))).collect();
        let answer = frame(Packet::FastStatus { blocks });
        rows.push(("ja40.fast-sync-read.length", name.to_owned(), asked, answer, all(due)));
        let each: Vec<_> = ids.iter().flat_map(|id| [*id, 0xA6, 0x01, 0x02, 0x83]).collect();
        let asked = instruction(BROADCAST, 0x8B, [&register[..], &each].concat());
        let blocks = ids.iter().map(|id| block(*id, &[])).collect();
        let due: Vec<_> =
            ids.iter().map(|id| Reported { id: *id, ..Reported::default() }).collect();
        let answer = frame(Packet::FastStatus { blocks });
        rows.push(("ja40.fast-sync-write.length", name.to_owned(), asked, answer, all(due)));
    }
    rows
}

/// The pattern in answers.
fn stuffed_answers() -> Vec<Answered> {
    let plain = [0x11, 0x22, 0x33, 0x44, 0x55, 0x66];
    let mut rows = Vec::new();
    for place in 0..=3 {
        let mut held = plain;
        held.iter_mut().skip(place).zip(PATTERN).for_each(|(byte, pattern)| *byte = pattern);
        let register = [132_u16, 6].map(u16::to_le_bytes).concat();
        let both = [status(1, 0, &held), status(2, 0, &plain)].concat();
        let due = all([data(1, &held), data(2, &plain)]);
        let name = |call: &str| format!(".{call}.at-{place}");
        let sync = instruction(BROADCAST, 0x82, [&register[..], &[1, 2]].concat());
        let bulk = instruction(BROADCAST, 0x92, [&[1], &register[..], &[2], &register].concat());
        let one = all([data(1, &held)]);
        rows.push((RECEIVE, name("read"), read(1, 132, 6), status(1, 0, &held), one));
        rows.push((RECEIVE, name("sync-read"), sync, both.clone(), due.clone()));
        rows.push((RECEIVE, name("bulk-read"), bulk, both, due));
    }
    let pinged = Reported {
        id: 1,
        model_number: Some(0xFFFF),
        firmware_version: Some(0xFD),
        ..Reported::default()
    };
    let answer = status(1, 0, &PATTERN);
    rows.push((RECEIVE, ".ping".to_owned(), instruction(1, 0x01, []), answer, all([pinged])));
    let covers = completed(|data| status(1, 0, data));
    let (answer, due) = (status(1, 0, &covers), all([data(1, &covers)]));
    rows.push(("dynamixel2.stuffing.covers", ".read".to_owned(), read(1, 132, 4), answer, due));
    rows
}

/// What is no answer to a Read, though it is like one.
fn no_answers() -> Vec<Answered> {
    let held = [0xFF, 0xFF, 0xFD, 0x11];
    let stuffed = status(1, 0, &held);
    // A CRC of the bytes without the stuffing, and a length without it.
    let mut bare: Vec<u8> = stuffed
        .iter()
        .enumerate()
        .filter(|(at, _)| *at != STUFFING)
        .map(|(_, byte)| *byte)
        .collect();
    WIRE.repair(&mut bare);
    let mut wrong_crc = stuffed.clone();
    wrong_crc.iter_mut().rev().zip(bare.iter().rev()).take(2).for_each(|(byte, crc)| *byte = *crc);
    let mut wrong_length = changed(&stuffed, 5, |length| length - 1);
    WIRE.repair(&mut wrong_length);
    let plain = status(1, 0, &[0xA6, 0x01, 0x02, 0x83]);
    let of_id = |id: u8| {
        let mut answer = changed(&plain, 4, |_| id);
        WIRE.repair(&mut answer);
        answer
    };
    let mut no_header = changed(&plain, 3, |_| 0xFD);
    WIRE.repair(&mut no_header);
    let header = "dynamixel2.receive.header.stuffed";
    let none = |requirement, more: &str, answer| {
        (requirement, more.to_owned(), read(1, 132, 4), answer, failed())
    };
    let behind = [&[0xFF, 0xFF, 0xFD, 0xFD, 0x00], &plain[..]].concat();
    let found = all([data(1, &[0xA6, 0x01, 0x02, 0x83])]);
    vec![
        none("dynamixel2.stuffing.crc", "", wrong_crc),
        none("dynamixel2.stuffing.length", "", wrong_length),
        none(ID, ".fd", of_id(0xFD)),
        none(ID, ".ff", of_id(0xFF)),
        none(header, "", no_header),
        (header, ".before".to_owned(), read(1, 132, 4), behind, found),
    ]
}
