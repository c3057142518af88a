//! Implementations that are wrong with some lengths, IDs, addresses or numbers of devices.

use actucheck::adapter::{Output, Question};
use actucheck_spec::wire::Context;
use actucheck_spec::wire::dynamixel2::{Packet, reference};

use super::sizes::encoded;
use super::{body_of, read_leniently, with_crc};
use crate::{Mutant, Wrong, bytes};

pub(super) static MUTANTS: [Mutant; 6] = [
    Mutant {
        name: "sends the CRC's high byte first",
        blames: "dynamixel2.crc.byte-order",
        wrong: Wrong::Answers(|op| encoded(op).map(|frame| bytes(crc_swapped(frame)))),
        found_by: "dynamixel2.id.1.ping/encode",
        found_by_documents: true,
    },
    Mutant {
        name: "reads the CRC's high byte first",
        blames: "dynamixel2.crc.byte-order",
        wrong: Wrong::Rejects(|op| match op {
            Question::Decode { bytes, context: Context { fast: None, .. }, .. } => {
                reference::decode(bytes).is_ok() && crc_swapped(bytes.0.clone()) != bytes.0
            }
            _ => false,
        }),
        found_by: "dynamixel2.id.1.ping/decode",
        found_by_documents: true,
    },
    Mutant {
        name: "reads a packet with ID 253 or 255",
        blames: "dynamixel2.receive.id",
        wrong: Wrong::Answers(|op| match op {
            Question::Decode { bytes, context: Context { fast: None, .. }, .. }
                if matches!(bytes.get(4), Some(253 | 255)) =>
            {
                let mut frame = bytes.0.clone();
                frame[4] = 1;
                read_leniently(&with_crc(frame))
            }
            _ => None,
        }),
        found_by: "dynamixel2.open.id.253.status/decode",
        found_by_documents: false,
    },
    Mutant {
        name: "builds a packet for ID 253 or 255",
        blames: "dynamixel2.packet.id.range",
        wrong: Wrong::Answers(|op| {
            let (id, body) = body_of(op)?;
            matches!(id, 253 | 255).then(|| bytes(reference::frame(id, &reference::stuff(&body))))
        }),
        found_by: "dynamixel2.open.id.255.ping/encode",
        found_by_documents: false,
    },
    Mutant {
        name: "finds a packet with ID 253 or 255 in a stream",
        blames: "dynamixel2.receive.id",
        wrong: Wrong::Answers(|op| {
            let mut frame = stream(op).filter(|stream| stream.starts_with(&reference::HEADER))?;
            let id = frame.get_mut(4).filter(|id| matches!(id, 253 | 255))?;
            *id = 1;
            Some(Output::packets(reference::packets(&with_crc(frame))))
        }),
        found_by: "dynamixel2.open.id.255.status/stream",
        found_by_documents: false,
    },
    Mutant {
        name: "leaves stuffing in what it finds in a stream",
        blames: "dynamixel2.stuffing.receive",
        wrong: Wrong::Answers(|op| {
            let stuffed = |packet| match packet {
                Packet::Instruction { id, instruction, params } => {
                    let params = reference::stuff(&params).into();
                    Packet::Instruction { id, instruction, params }
                }
                Packet::Status { id, error, params } => {
                    Packet::Status { id, error, params: reference::stuff(&params).into() }
                }
                fast @ Packet::FastStatus { .. } => fast,
            };
            let found = reference::packets(&stream(op)?);
            Some(Output::packets(found.into_iter().map(stuffed)))
        }),
        found_by: "dynamixel2.stuffing.in-status.fffffd/stream",
        found_by_documents: false,
    },
];

/// All chunks of a stream.
fn stream(op: &Question) -> Option<Vec<u8>> {
    let Question::Stream { chunks, .. } = op else { return None };
    Some(chunks.iter().flat_map(|chunk| chunk.0.clone()).collect())
}

fn crc_swapped(mut frame: Vec<u8>) -> Vec<u8> {
    let crc = frame.len() - 2;
    frame.swap(crc, crc + 1);
    frame
}
