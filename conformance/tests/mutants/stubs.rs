//! Trivial implementations: a check that passes on all of them and on every mutant could not fail.

use actucheck::adapter::{Output, Question, Wire};
use actucheck_spec::model::{HexBytes, Packet};
use actucheck_spec::wire::dynamixel2::reference;

use super::{Mutant, Wrong, bytes};

pub(super) static MUTANTS: [Mutant; 8] = [
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
            Question::Decode { wire: Wire::Dynamixel2, .. } => {
                Some(Output::Packet(Packet::Status {
                    id: 200,
                    error: 0,
                    params: HexBytes::default(),
                }))
            }
            Question::Decode { wire: Wire::Innfos, .. } => Some(Output::Packet(Packet::Reply {
                address: 200,
                command: 0,
                data: HexBytes::default(),
            })),
            _ => None,
        }),
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
            let packet = Packet::Status { id: 200, error: 0, params: HexBytes::default() };
            matches!(op, Question::Stream { .. }).then(|| Output::Packets(vec![packet]))
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
    Mutant { name, wrong, found_by: "", found_by_documents: true }
}
