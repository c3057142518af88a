//! Trivial implementations: a check that passes on all of them and on every mutant could not fail.

use actucheck::adapter::{Output, Question, Told};
use actucheck_spec::model::HexBytes;
use actucheck_spec::wire::dynamixel2::{self, reference};
use actucheck_spec::wire::{Direction, Packet, innfos};

use super::{Mutant, Wrong, bytes};

pub(super) static MUTANTS: [Mutant; 11] = [
    stub("knows no values", Wrong::Rejects(|op| matches!(op, Question::Value { .. }))),
    stub(
        "answers CRC 1",
        Wrong::Answers(|op| matches!(op, Question::Crc { .. }).then_some(Output::Crc(1))),
    ),
    stub(
        "hands out a byte too many",
        Wrong::Answers(|op| match op {
            Question::Stuff { bytes: body, .. } => {
                Some(bytes([&reference::stuff(body), &[0][..]].concat()))
            }
            Question::Unstuff { bytes: body, .. } => {
                Some(bytes([&reference::unstuff(body).ok()?, &[0][..]].concat()))
            }
            _ => None,
        }),
    ),
    stub(
        "builds nothing",
        Wrong::Answers(|op| matches!(op, Question::Encode { .. }).then(|| bytes(Vec::new()))),
    ),
    stub("rejects what it is to read", Wrong::Rejects(|op| matches!(op, Question::Decode { .. }))),
    stub(
        "accepts whatever it is to read",
        Wrong::Answers(|op| match op {
            Question::Decode { wire, .. } if *wire == dynamixel2::WIRE => {
                Some(Output::Packet(status()))
            }
            Question::Decode { .. } => Some(Output::Packet(reply())),
            _ => None,
        }),
    ),
    stub(
        "builds nothing from messages",
        Wrong::Answers(|op| match op {
            Question::Message { told: Told::Message { .. }, .. } => Some(bytes(Vec::new())),
            _ => None,
        }),
    ),
    stub(
        "reads no message",
        Wrong::Rejects(|op| matches!(op, Question::Message { told: Told::Frame { .. }, .. })),
    ),
    stub(
        "finds nothing in a stream",
        Wrong::Answers(|op| {
            matches!(op, Question::Stream { .. }).then(|| Output::Packets(Vec::new()))
        }),
    ),
    stub(
        "finds a packet in every stream",
        Wrong::Answers(|op| {
            matches!(op, Question::Stream { .. }).then(|| Output::Packets(vec![status()]))
        }),
    ),
    stub(
        "stumbles over what it has rejected",
        Wrong::RejectsAfter(|last| match last {
            Question::Decode { bytes, .. } => reference::decode(bytes).is_err(),
            _ => false,
        }),
    ),
];

const fn stub(name: &'static str, wrong: Wrong) -> Mutant {
    Mutant { name, blames: "", wrong, found_by: "", found_by_documents: true }
}

fn status() -> Packet {
    dynamixel2::Packet::Status { id: 200, error: 0, params: HexBytes::default() }.into()
}

fn reply() -> Packet {
    let direction = Direction::Reply;
    innfos::Packet { direction, address: 200, command: 0, data: HexBytes::default() }.into()
}
