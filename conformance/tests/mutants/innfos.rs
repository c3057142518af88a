//! Implementations of the INNFOS Ethernet protocol that are wrong in one way each.

use actucheck::adapter::{Output, Question};
use actucheck_spec::wire::innfos::{Packet, reference};
use actucheck_spec::wire::{self, Direction};

use super::{Mutant, Wrong, bytes};

/// Every mutant.
pub(super) static LISTS: [&[Mutant]; 1] = [&MUTANTS];

static MUTANTS: [Mutant; 7] = [
    Mutant {
        name: "sends the CRC's high byte first",
        blames: "innfos.crc.byte-order",
        wrong: Wrong::Answers(|op| {
            let mut frame = reference::encode(packet(op)?)?;
            let crc = frame.len().checked_sub(3)?;
            (frame.len() > 8).then(|| {
                frame.swap(crc, crc + 1);
                bytes(frame)
            })
        }),
        found_by: "innfos.request.size.4/encode",
        found_by_documents: true,
    },
    Mutant {
        name: "sends the length's low byte first",
        blames: "innfos.frame.length",
        wrong: Wrong::Answers(|op| {
            let mut frame = reference::encode(packet(op)?)?;
            frame.swap(3, 4);
            Some(bytes(frame))
        }),
        found_by: "innfos.request.size.1/encode",
        found_by_documents: true,
    },
    Mutant {
        name: "reads the length's low byte only",
        blames: "innfos.frame.length",
        wrong: Wrong::Rejects(
            |op| matches!(op, Question::Decode { bytes, .. } if bytes.get(3).is_some_and(|high| *high > 0)),
        ),
        found_by: "innfos.reply.size.256/decode",
        found_by_documents: false,
    },
    Mutant {
        name: "does not look at the CRC",
        blames: "innfos.crc.verify",
        wrong: Wrong::Answers(|op| {
            let Question::Decode { bytes, context, .. } = op else { return None };
            let mut frame = bytes.0.clone();
            let crc = reference::crc(frame.get(5..frame.len().checked_sub(3)?)?).to_le_bytes();
            let at = frame.len() - 3;
            frame[at..at + 2].copy_from_slice(&crc);
            read(context.direction.unwrap_or(Direction::Reply), &frame)
        }),
        found_by: "innfos.negative.reply.flip-9-0/decode",
        found_by_documents: true,
    },
    Mutant {
        name: "does not look at the tail",
        blames: "innfos.frame.tail",
        wrong: Wrong::Answers(|op| {
            let Question::Decode { bytes, context, .. } = op else { return None };
            let mut frame = bytes.0.clone();
            *frame.last_mut()? = 0xED;
            read(context.direction.unwrap_or(Direction::Reply), &frame)
        }),
        found_by: "innfos.negative.request.flip-11-0/decode",
        found_by_documents: false,
    },
    Mutant {
        name: "takes the first ED for the tail",
        blames: "innfos.frame.transparent",
        wrong: Wrong::Rejects(|op| match op {
            Question::Decode { bytes, .. } => {
                bytes.iter().position(|byte| *byte == 0xED) != Some(bytes.len().saturating_sub(1))
            }
            _ => false,
        }),
        found_by: "innfos.request.data.ed/decode",
        found_by_documents: false,
    },
    Mutant {
        name: "reads the first frame of a datagram only",
        blames: "innfos.frame.transparent",
        wrong: Wrong::Answers(|op| {
            let Question::Stream { chunks, direction, .. } = op else { return None };
            let found = chunks.iter().filter_map(|chunk| {
                reference::packets(direction.unwrap_or(Direction::Reply), chunk).into_iter().next()
            });
            Some(Output::packets(found))
        }),
        found_by: "innfos.reply.size.4/stream-twice",
        found_by_documents: false,
    },
];

/// The packet to encode.
fn packet(op: &Question) -> Option<&Packet> {
    let Question::Encode { packet, .. } = op else { return None };
    let wire::Packet::Innfos(packet) = &packet.packet else { return None };
    Some(packet)
}

fn read(kind: Direction, frame: &[u8]) -> Option<Output> {
    reference::decode(kind, frame).ok().map(|packet| Output::Packet(packet.into()))
}
