//! Implementations of the INNFOS Ethernet protocol that are wrong in one way each.

mod frames;
mod messages;

use actucheck::adapter::{Output, Question};
use actucheck_spec::model::Fault;
use actucheck_spec::wire::innfos::reference;
use actucheck_spec::wire::{Context, Direction};

use super::{Mutant, Wrong};

/// Every mutant.
pub(super) static LISTS: [&[Mutant]; 4] =
    [&CRC, &frames::BUILDING, &frames::READING, &messages::VALUES];

static CRC: [Mutant; 2] = [
    Mutant {
        name: "computes the CRC with a zero after the data",
        blames: "innfos.crc.value",
        wrong: Wrong::Answers(|op| match op {
            Question::Crc { bytes, .. } => {
                let more = [bytes.0.as_slice(), &[0]].concat();
                Some(Output::Crc(reference::crc(&more).into()))
            }
            _ => None,
        }),
        found_by: "innfos.example.write.reply/crc",
        found_by_documents: true,
    },
    Mutant {
        name: "reads the CRC's bytes in the other order",
        blames: "innfos.crc.byte-order",
        wrong: Wrong::Rejects(|op| {
            let Question::Decode { bytes, context: Context { direction, .. }, .. } = op else {
                return false;
            };
            let direction = direction.unwrap_or(Direction::Reply);
            let mut frame = bytes.0.clone();
            let Some(crc) = frame.len().checked_sub(3) else { return false };
            frame.swap(crc, crc + 1);
            let had_crc = reference::decode(direction, &frame) == Err(Fault::Crc);
            had_crc && reference::decode(direction, bytes).is_ok()
        }),
        found_by: "innfos.request.size.4/decode",
        found_by_documents: true,
    },
];
