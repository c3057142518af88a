//! Mutants that build or read frames wrongly.

use actucheck::adapter::{Output, Question};
use actucheck_spec::wire::innfos::{Packet, reference};
use actucheck_spec::wire::{self, Direction};

use super::super::{Mutant, Wrong, bytes};

pub(super) static BUILDING: [Mutant; 8] = [
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
        name: "counts the CRC in the length",
        blames: "innfos.frame.length",
        wrong: Wrong::Answers(|op| {
            let mut frame = reference::encode(packet(op)?)?;
            frame[4] = u8::try_from(frame.len() - 6).ok()?;
            Some(bytes(frame))
        }),
        found_by: "innfos.reply.size.4/encode",
        found_by_documents: true,
    },
    Mutant {
        name: "sends the CRC of no data",
        blames: "innfos.frame.no-data",
        wrong: Wrong::Answers(|op| {
            let packet = packet(op)?;
            packet.data.is_empty().then(|| bytes(with_crc(packet, &[])))
        }),
        found_by: "innfos.request.size.0/encode",
        found_by_documents: true,
    },
    Mutant {
        name: "sends a CRC in replies with one byte",
        blames: "innfos.crc.reply",
        wrong: Wrong::Answers(|op| {
            let packet = packet(op)?;
            let short = packet.direction == Direction::Reply && packet.data.len() == 1;
            short.then(|| bytes(with_crc(packet, &packet.data)))
        }),
        found_by: "innfos.reply.command.fe/encode",
        found_by_documents: true,
    },
    Mutant {
        name: "sends requests with one byte like replies, without a CRC",
        blames: "innfos.crc.request",
        wrong: Wrong::Answers(|op| {
            let packet = packet(op).filter(|packet| packet.data.len() == 1)?;
            let reply = Packet { direction: Direction::Reply, ..packet.clone() };
            Some(bytes(reference::encode(&reply)?))
        }),
        found_by: "innfos.request.command.07/encode",
        found_by_documents: true,
    },
    Mutant {
        name: "computes the CRC of the whole frame",
        blames: "innfos.crc.value",
        wrong: Wrong::Answers(|op| {
            let packet = packet(op).filter(|packet| packet.data.len() > 1)?;
            let frame = reference::encode(packet)?;
            Some(bytes(with_crc(packet, frame.get(..frame.len() - 3)?)))
        }),
        found_by: "innfos.request.size.4/encode",
        found_by_documents: true,
    },
    Mutant {
        name: "sends nothing to address 0",
        blames: "innfos.frame.address",
        wrong: Wrong::Rejects(|op| packet(op).is_some_and(|packet| packet.address == 0)),
        found_by: "innfos.request.address.00/encode",
        found_by_documents: true,
    },
];

pub(super) static READING: [Mutant; 15] = [
    Mutant {
        name: "reads the length's low byte only",
        blames: "innfos.frame.length",
        wrong: Wrong::Answers(|op| read_after(op, |_, frame| frame[3] = 0)),
        found_by: "innfos.negative.request.flip-3-0/decode",
        found_by_documents: false,
    },
    Mutant {
        name: "does not look at the header",
        blames: "innfos.frame.header",
        wrong: Wrong::Answers(|op| read_after(op, |_, frame| frame[0] = 0xEE)),
        found_by: "innfos.negative.reply.06.header/decode",
        found_by_documents: false,
    },
    Mutant {
        name: "does not look at the CRC",
        blames: "innfos.crc.verify",
        wrong: Wrong::Answers(|op| read_after(op, |_, frame| mend_crc(frame))),
        found_by: "innfos.negative.reply.flip-9-0/decode",
        found_by_documents: true,
    },
    Mutant {
        name: "does not look at the CRC of single bytes",
        blames: "innfos.crc.verify",
        wrong: Wrong::Answers(|op| {
            read_after(op, |direction, frame| {
                if direction == Direction::Request && frame.len() == 9 {
                    mend_crc(frame);
                }
            })
        }),
        found_by: "innfos.negative.request.2a.crc/decode",
        found_by_documents: false,
    },
    Mutant {
        name: "takes the CRC's bytes in either order",
        blames: "innfos.crc.verify",
        wrong: Wrong::Answers(|op| {
            read_after(op, |_, frame| {
                let at = frame.len().saturating_sub(3);
                let crc = frame.get(5..at).map(reference::crc).unwrap_or_default();
                if frame.get(at..at + 2) == Some(&crc.to_be_bytes()) {
                    frame.swap(at, at + 1);
                }
            })
        }),
        found_by: "innfos.negative.reply.5f.crc-high-byte-first/decode",
        found_by_documents: false,
    },
    Mutant {
        name: "takes zeros for any CRC",
        blames: "innfos.crc.verify",
        wrong: Wrong::Answers(|op| {
            read_after(op, |_, frame| {
                let at = frame.len().saturating_sub(3);
                if frame.get(at..at + 2) == Some(&[0, 0]) && frame.len() > 8 {
                    mend_crc(frame);
                }
            })
        }),
        found_by: "innfos.negative.reply.ff.crc-zero/decode",
        found_by_documents: false,
    },
    Mutant {
        name: "reads requests with one byte like replies, without a CRC",
        blames: "innfos.crc.request",
        wrong: Wrong::Answers(|op| {
            let Question::Decode { bytes, context, .. } = op else { return None };
            let is_request = context.direction == Some(Direction::Request);
            let reply = reference::decode(Direction::Reply, bytes).ok()?;
            let request = Packet { direction: Direction::Request, ..reply };
            (is_request && request.data.len() == 1).then(|| Output::Packet(request.into()))
        }),
        found_by: "innfos.negative.reply-as-request.78/decode",
        found_by_documents: false,
    },
    Mutant {
        name: "wants a CRC in replies with one byte",
        blames: "innfos.crc.reply",
        wrong: Wrong::Rejects(|op| {
            matches!(op, Question::Decode { bytes, context, .. }
                if context.direction == Some(Direction::Reply) && bytes.len() == 7)
        }),
        found_by: "innfos.reply.command.88/decode",
        found_by_documents: true,
    },
    Mutant {
        name: "skips a CRC where there is no data",
        blames: "innfos.frame.no-data",
        wrong: Wrong::Answers(|op| {
            read_after(op, |_, frame| {
                if let [_, _, _, 0, 0, 0xFF, 0xFF, 0xED] = **frame {
                    frame.drain(5..7);
                }
            })
        }),
        found_by: "innfos.negative.request.06.with-crc/decode",
        found_by_documents: false,
    },
    Mutant {
        name: "does without the CRC of data",
        blames: "innfos.crc.reply",
        wrong: Wrong::Answers(|op| {
            read_after(op, |direction, frame| {
                if direction == Direction::Reply && frame.len() == 6 + usize::from(frame[4]) {
                    let crc = frame.get(5..frame.len() - 1).map(reference::crc).unwrap_or_default();
                    let at = frame.len() - 1;
                    frame.splice(at..at, crc.to_le_bytes());
                }
            })
        }),
        found_by: "innfos.negative.reply.04.without-crc/decode",
        found_by_documents: false,
    },
    Mutant {
        name: "does not look at the tail",
        blames: "innfos.frame.tail",
        wrong: Wrong::Answers(|op| {
            read_after(op, |_, frame| {
                let last = frame.len() - 1;
                frame[last] = 0xED;
            })
        }),
        found_by: "innfos.negative.request.flip-11-0/decode",
        found_by_documents: false,
    },
    Mutant {
        name: "adds the tail to a frame without one",
        blames: "innfos.frame.tail",
        wrong: Wrong::Answers(|op| read_after(op, |_, frame| frame.push(0xED))),
        found_by: "innfos.receive.no-tail/decode",
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
        found_by: "innfos.request.data.000000ed/decode",
        found_by_documents: false,
    },
    Mutant {
        name: "begins anew at an EE in the data",
        blames: "innfos.frame.transparent",
        wrong: Wrong::Rejects(|op| match op {
            Question::Decode { bytes, .. } => {
                bytes.get(5..).is_some_and(|bytes| bytes.contains(&0xEE))
            }
            _ => false,
        }),
        found_by: "innfos.reply.data.0100ee00/decode",
        found_by_documents: false,
    },
    Mutant {
        name: "receives the first datagram only",
        blames: "innfos.frame.layout",
        wrong: Wrong::Answers(|op| {
            let Question::Stream { chunks, direction, .. } = op else { return None };
            let found = reference::packets(direction.unwrap_or(Direction::Reply), chunks.first()?);
            Some(Output::packets(found))
        }),
        found_by: "innfos.reply.command.06/stream",
        found_by_documents: false,
    },
];

/// The packet to encode.
fn packet(op: &Question) -> Option<&Packet> {
    let Question::Encode { packet, .. } = op else { return None };
    let wire::Packet::Innfos(packet) = &packet.packet else { return None };
    Some(packet)
}

/// The frame of a packet with the CRC of these bytes.
fn with_crc(packet: &Packet, covered: &[u8]) -> Vec<u8> {
    let Packet { address, command, data, .. } = packet;
    let mut frame = vec![0xEE, *address, *command];
    frame.extend(u16::try_from(data.len()).unwrap().to_be_bytes());
    frame.extend(data.iter());
    frame.extend(reference::crc(covered).to_le_bytes());
    frame.push(0xED);
    frame
}

/// Reads a frame after a change that makes a wrong one right.
fn read_after(op: &Question, change: fn(Direction, &mut Vec<u8>)) -> Option<Output> {
    let Question::Decode { bytes, context, .. } = op else { return None };
    let direction = context.direction?;
    let mut frame = bytes.0.clone();
    if frame.len() < 6 {
        return None;
    }
    change(direction, &mut frame);
    reference::decode(direction, &frame).ok().map(|packet| Output::Packet(packet.into()))
}

fn mend_crc(frame: &mut [u8]) {
    let at = frame.len().saturating_sub(3);
    if let Some(crc) = frame.get(5..at).map(reference::crc) {
        frame[at..at + 2].copy_from_slice(&crc.to_le_bytes());
    }
}
