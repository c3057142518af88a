//! Implementations of DYNAMIXEL Protocol 2.0 that are wrong in one way each.

mod fast;
mod packets;
mod sizes;
mod streams;
mod values;

use actucheck::adapter::{Output, Question};
use actucheck_spec::wire::dynamixel2::Packet;
use actucheck_spec::wire::dynamixel2::reference::{self, HEADER};
use actucheck_spec::wire::{self, Context};

use super::{Mutant, Wrong, bytes};

/// Every mutant.
pub(super) static LISTS: [&[Mutant]; 8] = [
    &MUTANTS,
    &fast::MUTANTS,
    &packets::MUTANTS,
    &sizes::MUTANTS,
    &streams::MUTANTS,
    &values::NUMBERS,
    &values::WRITING,
    &values::NAMES,
];

pub(super) static MUTANTS: [Mutant; 14] = [
    Mutant {
        name: "sends without byte stuffing",
        blames: "dynamixel2.stuffing.transmit",
        wrong: Wrong::Answers(|op| {
            body_of(op).map(|(id, body)| bytes(reference::frame(id, &body)))
        }),
        found_by: "dynamixel2.stuffing.in-write.fffffd/encode",
        found_by_documents: false,
    },
    Mutant {
        name: "looks for the pattern in the parameters only",
        blames: "dynamixel2.stuffing.transmit",
        wrong: Wrong::Answers(|op| {
            let (id, body) = body_of(op)?;
            let (code, params) = body.split_first()?;
            let stuffed = [&[*code], reference::stuff(params).as_slice()].concat();
            // Only an instruction FF shows the bug.
            (*code == 0xFF).then(|| bytes(reference::frame(id, &stuffed)))
        }),
        found_by: "dynamixel2.stuffing.from-instruction/encode",
        found_by_documents: false,
    },
    Mutant {
        name: "stuffs the first pattern only",
        blames: "dynamixel2.stuffing.transmit",
        wrong: Wrong::Answers(|op| match op {
            Question::Stuff { bytes: body, .. } => {
                let at = body.windows(3).position(|window| window == [0xFF, 0xFF, 0xFD])? + 3;
                Some(bytes([&body[..at], &[0xFD], &body[at..]].concat()))
            }
            _ => None,
        }),
        found_by: "dynamixel2.stuffing.body.fffffdfffffd/stuff",
        found_by_documents: false,
    },
    Mutant {
        name: "counts the length before stuffing",
        blames: "dynamixel2.stuffing.length",
        wrong: Wrong::Answers(|op| {
            let (id, body) = body_of(op)?;
            let mut frame = reference::frame(id, &reference::stuff(&body));
            frame[5..7].copy_from_slice(&u16::try_from(body.len() + 2).ok()?.to_le_bytes());
            Some(bytes(with_crc(frame)))
        }),
        found_by: "dynamixel2.length.3.tricky.write/encode",
        found_by_documents: false,
    },
    Mutant {
        name: "computes the CRC before stuffing",
        blames: "dynamixel2.stuffing.crc",
        wrong: Wrong::Answers(|op| {
            let (id, body) = body_of(op)?;
            let mut frame = reference::frame(id, &reference::stuff(&body));
            let plain = reference::frame(id, &body);
            let (end, plain_end) = (frame.len() - 2, plain.len() - 2);
            frame[end..].copy_from_slice(&plain[plain_end..]);
            Some(bytes(frame))
        }),
        found_by: "dynamixel2.stuffing.in-status.fffffd/encode",
        found_by_documents: false,
    },
    Mutant {
        name: "takes every FD after FF FD for stuffing",
        blames: "dynamixel2.stuffing.receive",
        wrong: Wrong::Answers(|op| match op {
            Question::Unstuff { bytes: body, .. } => {
                let mut out: Vec<u8> = Vec::new();
                for byte in body.iter() {
                    if *byte != 0xFD || !out.ends_with(&[0xFF, 0xFD]) {
                        out.push(*byte);
                    }
                }
                Some(bytes(out))
            }
            _ => None,
        }),
        found_by: "dynamixel2.stuffing.body.fffdfd/unstuff",
        found_by_documents: false,
    },
    Mutant {
        name: "leaves stuffing in what it reads",
        blames: "dynamixel2.stuffing.receive",
        wrong: Wrong::Answers(|op| match op {
            Question::Decode { bytes, context: Context { fast: None, .. }, .. } => {
                match reference::decode(bytes).ok()? {
                    Packet::Status { id, error, .. } => {
                        let params = bytes[9..bytes.len() - 2].to_vec().into();
                        Some(Output::Packet(Packet::Status { id, error, params }.into()))
                    }
                    _ => None,
                }
            }
            _ => None,
        }),
        found_by: "dynamixel2.stuffing.status/decode",
        found_by_documents: false,
    },
    Mutant {
        name: "starts the CRC with FFFF",
        blames: "dynamixel2.crc.value",
        wrong: Wrong::Answers(|op| match op {
            Question::Crc { bytes, .. } => {
                let whole = [&[0xFF, 0xFF], bytes.0.as_slice()].concat();
                Some(Output::Crc(reference::crc(&whole).into()))
            }
            _ => None,
        }),
        found_by: "ja40.ping.instruction/crc",
        found_by_documents: true,
    },
    Mutant {
        name: "does not look at the CRC",
        blames: "dynamixel2.receive.crc",
        wrong: Wrong::Answers(|op| match op {
            Question::Decode { bytes, context: Context { fast: None, .. }, .. } => {
                read_leniently(&with_crc(bytes.0.clone()))
            }
            _ => None,
        }),
        found_by: "dynamixel2.negative.status.flip-13-0/decode",
        found_by_documents: true, // by the bytes that they print wrongly
    },
    Mutant {
        name: "does not look at the reserved byte",
        blames: "dynamixel2.packet.reserved",
        wrong: Wrong::Answers(|op| match op {
            Question::Decode { bytes, context: Context { fast: None, .. }, .. }
                if bytes.len() > 7 =>
            {
                let mut frame = bytes.0.clone();
                let right = reference::crc(&frame[..frame.len() - 2]).to_le_bytes();
                frame[3] = HEADER[3];
                frame.ends_with(&right).then(|| read_leniently(&with_crc(frame)))?
            }
            _ => None,
        }),
        found_by: "dynamixel2.negative.status.reserved-01/decode",
        found_by_documents: false,
    },
    Mutant {
        name: "reads the length's low byte only",
        blames: "dynamixel2.packet.length",
        wrong: Wrong::Answers(|op| match op {
            Question::Encode { packet, .. } => {
                let mut frame = packet.packet.wire().encode(&packet.packet)?;
                frame[6] = 0;
                Some(bytes(with_crc(frame)))
            }
            _ => None,
        }),
        found_by: "dynamixel2.length.257.plain.write/encode",
        found_by_documents: false,
    },
    Mutant {
        name: "drops the alert bit",
        blames: "dynamixel2.status-packet.error.fields",
        wrong: Wrong::Answers(|op| match op {
            Question::Decode { bytes, context: Context { fast: None, .. }, .. } => {
                match reference::decode(bytes).ok()? {
                    Packet::Status { id, error, params } => Some(Output::Packet(
                        Packet::Status { id, error: error & 0x7F, params }.into(),
                    )),
                    _ => None,
                }
            }
            _ => None,
        }),
        found_by: "dynamixel2.error.80/decode",
        found_by_documents: false,
    },
    Mutant {
        name: "forgets what it has of a packet when a chunk ends",
        blames: "dynamixel2.receive.stream",
        wrong: Wrong::Answers(|op| match op {
            Question::Stream { chunks, .. } => {
                Some(Output::packets(chunks.iter().flat_map(|chunk| reference::packets(chunk))))
            }
            _ => None,
        }),
        found_by: "dynamixel2.stream.good-good/bytewise",
        found_by_documents: true, // cut byte by byte
    },
    Mutant {
        name: "gives up the stream at a wrong CRC",
        blames: "dynamixel2.receive.stream",
        wrong: Wrong::Answers(|op| match op {
            Question::Stream { chunks, .. } => {
                let stream: Vec<u8> = chunks.iter().flat_map(|chunk| chunk.0.clone()).collect();
                let at = stream.windows(4).position(|window| window == HEADER)?;
                let frame = &stream[at..];
                let size = 7 + usize::from(*frame.get(5)?) + 256 * usize::from(*frame.get(6)?);
                let right = reference::decode(frame.get(..size)?).is_ok();
                (!right).then(|| Output::Packets(Vec::new()))
            }
            _ => None,
        }),
        found_by: "dynamixel2.stream.bad-crc-good/stream",
        found_by_documents: false,
    },
];

/// ID and body of a packet that is to be encoded.
fn body_of(op: &Question) -> Option<(u8, Vec<u8>)> {
    let Question::Encode { packet, .. } = op else { return None };
    let wire::Packet::Dynamixel2(packet) = &packet.packet else { return None };
    match packet {
        Packet::Instruction { id, instruction, params } => {
            Some((*id, [&[*instruction], params.0.as_slice()].concat()))
        }
        Packet::Status { id, error, params } => {
            Some((*id, [&[0x55, *error], params.0.as_slice()].concat()))
        }
        Packet::FastStatus { .. } => None,
    }
}

fn with_crc(mut frame: Vec<u8>) -> Vec<u8> {
    frame.truncate(frame.len().saturating_sub(2));
    let crc = reference::crc(&frame).to_le_bytes();
    frame.extend(crc);
    frame
}

fn read_leniently(frame: &[u8]) -> Option<Output> {
    reference::decode(frame).ok().map(|packet| Output::Packet(packet.into()))
}
