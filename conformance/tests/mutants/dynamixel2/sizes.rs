//! Implementations that are wrong with some lengths, addresses, numbers of devices or limits.

use actucheck::adapter::{Output, Question};
use actucheck_spec::wire::dynamixel2::Packet;
use actucheck_spec::wire::dynamixel2::reference::{self, PATTERN, PREFIX};
use actucheck_spec::wire::{self, Context};

use super::{body_of, read_leniently, with_crc};
use crate::{LIMITS, Mutant, Wrong, bytes};

pub(super) static MUTANTS: [Mutant; 23] = [
    Mutant {
        name: "builds a Bulk Write with addresses of one byte",
        blames: "dynamixel2.bulk-write.parameters",
        wrong: Wrong::Answers(|op| {
            built(
                op,
                |body| {
                    *body.get_mut(3)? = 0;
                    Some(())
                },
                0x93,
            )
        }),
        found_by: "dynamixel2.address.bulk-write.256/encode",
        found_by_documents: false,
    },
    Mutant {
        name: "leaves out an address of 0",
        blames: "dynamixel2.write.parameters",
        wrong: Wrong::Answers(|op| {
            built(
                op,
                |body| {
                    body.get(1..3).filter(|address| *address == [0, 0])?;
                    body.drain(1..3);
                    Some(())
                },
                0x03,
            )
        }),
        found_by: "dynamixel2.address.write.0/encode",
        found_by_documents: false,
    },
    Mutant {
        name: "builds a Read of up to 255 bytes",
        blames: "dynamixel2.read.parameters",
        wrong: Wrong::Answers(|op| {
            built(
                op,
                |body| {
                    *body.get_mut(4)? = 0;
                    Some(())
                },
                0x02,
            )
        }),
        found_by: "dynamixel2.number-of-bytes.read.256/encode",
        found_by_documents: false,
    },
    Mutant {
        name: "builds a Sync Read for up to 252 devices",
        blames: "dynamixel2.sync-read.parameters",
        wrong: Wrong::Rejects(|op| {
            body_of(op).is_some_and(|(_, body)| body[0] == 0x82 && body.len() > 5 + 252)
        }),
        found_by: "dynamixel2.devices.sync-read.253/encode",
        found_by_documents: false,
    },
    Mutant {
        name: "builds a Fast Sync Write for up to 64 devices",
        blames: "ja40.fast-sync-write.parameters",
        wrong: Wrong::Rejects(|op| {
            body_of(op).is_some_and(|(_, body)| body[0] == 0x8B && body.len() > 5 + 64 * 3)
        }),
        found_by: "dynamixel2.devices.fast-sync-write.65/encode",
        found_by_documents: false,
    },
    Mutant {
        name: "reads a Bulk Read for up to 252 devices",
        blames: "dynamixel2.bulk-read.parameters",
        wrong: Wrong::Rejects(|op| {
            let body = read(op);
            body.is_some_and(|body| body.first() == Some(&0x92) && body.len() > 1 + 252 * 5)
        }),
        found_by: "dynamixel2.devices.bulk-read.253/decode",
        found_by_documents: false,
    },
    Mutant {
        name: "stuffs each 64 bytes alone",
        blames: "dynamixel2.stuffing.transmit",
        wrong: Wrong::Answers(|op| {
            stuffed(op, |body| body.chunks(64).flat_map(reference::stuff).collect())
        }),
        found_by: "dynamixel2.body.65.write.pattern-at-62/encode",
        found_by_documents: false,
    },
    Mutant {
        name: "loses a pattern across byte 128 when it reads",
        blames: "dynamixel2.stuffing.receive",
        wrong: Wrong::Rejects(|op| {
            read(op).is_some_and(|body| [126, 127].iter().any(|at| has_pattern(&body, *at)))
        }),
        found_by: "dynamixel2.body.129.status.pattern-at-126/decode",
        found_by_documents: false,
    },
    Mutant {
        name: "loses the last byte of 64",
        blames: "dynamixel2.packet.length.instruction",
        wrong: Wrong::Answers(|op| {
            stuffed(op, |body| {
                reference::stuff(&body[..body.len() - usize::from(body.len() == 64)])
            })
        }),
        found_by: "dynamixel2.body.64.write.plain/encode",
        found_by_documents: false,
    },
    Mutant {
        name: "reads no status packet with 150 to 230 bytes of data",
        blames: "dynamixel2.packet.length.status",
        wrong: Wrong::Rejects(|op| {
            read(op).is_some_and(|body| body[0] == 0x55 && (152..=232).contains(&body.len()))
        }),
        found_by: "dynamixel2.body.200.status.plain/decode",
        found_by_documents: false,
    },
    Mutant {
        name: "sends the length's high byte first",
        blames: "dynamixel2.packet.length.byte-order",
        wrong: Wrong::Answers(|op| {
            let mut frame = encoded(op)?;
            frame.swap(5, 6);
            Some(bytes(with_crc(frame)))
        }),
        found_by: "dynamixel2.body.254.write.plain/encode",
        found_by_documents: true,
    },
    Mutant {
        name: "does not stuff a pattern at the very end",
        blames: "dynamixel2.stuffing.transmit",
        wrong: Wrong::Answers(|op| {
            stuffed(op, |body| {
                let (last, before) = body.split_last().unwrap_or((&0, &[]));
                [&reference::stuff(before), &[*last][..]].concat()
            })
        }),
        found_by: "dynamixel2.pattern.reg-write.last-data/encode",
        found_by_documents: false,
    },
    Mutant {
        name: "stuffs address and data apart",
        blames: "dynamixel2.stuffing.transmit",
        wrong: Wrong::Answers(|op| {
            stuffed(op, |body| {
                let (address, data) = body.split_at(body.len().min(3));
                [reference::stuff(address), reference::stuff(data)].concat()
            })
        }),
        found_by: "dynamixel2.pattern.write.address-and-data/encode",
        found_by_documents: false,
    },
    Mutant {
        name: "stuffs a CRC that ends a pattern",
        blames: "dynamixel2.stuffing.covers",
        wrong: Wrong::Answers(|op| {
            let mut frame = encoded(op)?;
            let high = frame.len() - 1;
            frame[..high].ends_with(&PATTERN).then(|| {
                frame.insert(high, 0xFD);
                bytes(frame)
            })
        }),
        found_by: "dynamixel2.crc.behind-ffff.fd01.write/encode",
        found_by_documents: false,
    },
    Mutant {
        name: "takes an FD of the CRC for stuffing",
        blames: "dynamixel2.stuffing.covers",
        wrong: Wrong::Rejects(|op| match op {
            Question::Decode { bytes, context: Context { fast: None, .. }, .. } => {
                bytes.ends_with(&[0xFF, 0xFF, 0xFD, 0xFD])
            }
            _ => false,
        }),
        found_by: "dynamixel2.crc.behind-ffff.fdfd.status/decode",
        found_by_documents: false,
    },
    Mutant {
        name: "removes stuffing before it computes the CRC",
        blames: "dynamixel2.stuffing.crc",
        wrong: Wrong::Answers(|op| {
            let Question::Decode { bytes, context: Context { fast: None, .. }, .. } = op else {
                return None;
            };
            let (stuffed, crc) = bytes.get(PREFIX..)?.split_last_chunk::<2>()?;
            let plain = reference::frame(bytes[4], &reference::unstuff(stuffed).ok()?);
            plain.ends_with(crc).then(|| read_leniently(&with_crc(bytes.0.clone())))?
        }),
        found_by: "dynamixel2.crc.before-stuffing.status/decode",
        found_by_documents: false,
    },
    Mutant {
        name: "lets a length of 65,536 begin at 0 again",
        blames: "dynamixel2.packet.length.limit",
        wrong: Wrong::Answers(|op| {
            let (id, body) = body_of(op)?;
            let body = reference::stuff(&body);
            (body.len() + 2 > 0xFFFF).then(|| {
                let mut frame = reference::frame(id, &body);
                frame[5..7].copy_from_slice(&[0, 0]);
                bytes(with_crc(frame))
            })
        }),
        found_by: "dynamixel2.limit.length-field.write.stuffed/encode",
        found_by_documents: false,
    },
    Mutant {
        name: "builds a packet of a byte more than its limit",
        blames: "dynamixel2.packet.length.limit",
        wrong: Wrong::Answers(|op| {
            encoded(op)
                .filter(|frame| Some(frame.len()) == LIMITS.send().map(|limit| limit + 1))
                .map(bytes)
        }),
        found_by: "dynamixel2.limit.send.above.write.plain/encode",
        found_by_documents: false,
    },
    Mutant {
        name: "leaves stuffing out when it compares with its limit",
        blames: "dynamixel2.packet.length.limit",
        wrong: Wrong::Answers(|op| {
            let (_, body) = body_of(op)?;
            let limit = LIMITS.send()?;
            let fits = body.len() + PREFIX + 2 <= limit;
            encoded(op).filter(|frame| fits && frame.len() > limit).map(bytes)
        }),
        found_by: "dynamixel2.limit.send.above.status.stuffed/encode",
        found_by_documents: false,
    },
    Mutant {
        name: "builds packets shorter than its limit only",
        blames: "dynamixel2.packet.length",
        wrong: Wrong::Rejects(|op| encoded(op).is_some_and(|it| Some(it.len()) == LIMITS.send())),
        found_by: "dynamixel2.limit.send.at.status.plain/encode",
        found_by_documents: false,
    },
    Mutant {
        name: "reads packets shorter than its limit only",
        blames: "dynamixel2.packet.length",
        wrong: Wrong::Rejects(|op| match op {
            Question::Decode { bytes, .. } => Some(bytes.len()) == LIMITS.receive(),
            _ => false,
        }),
        found_by: "dynamixel2.limit.receive.at.status.stuffed/decode",
        found_by_documents: false,
    },
    Mutant {
        name: "reads packets longer than its limit",
        blames: "dynamixel2.packet.length.limit",
        wrong: Wrong::Answers(|op| {
            let Question::Decode { bytes, context: Context { fast: None, .. }, .. } = op else {
                return None;
            };
            (Some(bytes.len()) > LIMITS.receive()).then(|| read_leniently(bytes))?
        }),
        found_by: "dynamixel2.limit.receive.above.write.plain/decode",
        found_by_documents: false,
    },
    Mutant {
        name: "finds packets longer than its limit in a stream",
        blames: "dynamixel2.packet.length.limit",
        wrong: Wrong::Answers(|op| {
            let Question::Stream { chunks, .. } = op else { return None };
            let stream: Vec<u8> = chunks.iter().flat_map(|chunk| chunk.0.clone()).collect();
            (Some(stream.len()) > LIMITS.receive())
                .then(|| Output::packets(reference::packets(&stream)))
        }),
        found_by: "dynamixel2.limit.receive.above.status.plain/stream",
        found_by_documents: false,
    },
];

/// The right bytes of a packet that is to be encoded.
pub(super) fn encoded(op: &Question) -> Option<Vec<u8>> {
    let Question::Encode { packet, .. } = op else { return None };
    let wire::Packet::Dynamixel2(packet) = &packet.packet else { return None };
    reference::encode(packet)
}

/// A packet that is to be encoded, stuffed in another way.
fn stuffed(op: &Question, stuff: fn(&[u8]) -> Vec<u8>) -> Option<Output> {
    let (id, body) = body_of(op)?;
    let stuffed = stuff(&body);
    (stuffed != reference::stuff(&body)).then(|| bytes(reference::frame(id, &stuffed)))
}

/// An instruction that is to be encoded, with another body.
fn built(op: &Question, change: fn(&mut Vec<u8>) -> Option<()>, code: u8) -> Option<Output> {
    let (id, mut body) = body_of(op).filter(|(_, body)| body[0] == code)?;
    change(&mut body)?;
    Some(bytes(reference::frame(id, &reference::stuff(&body))))
}

/// The body without stuffing of a good packet that is to be read.
fn read(op: &Question) -> Option<Vec<u8>> {
    let Question::Decode { bytes, context: Context { fast: None, .. }, .. } = op else {
        return None;
    };
    match reference::decode(bytes).ok()? {
        Packet::Instruction { instruction, params, .. } => {
            Some([&[instruction], params.0.as_slice()].concat())
        }
        Packet::Status { error, params, .. } => {
            Some([&[0x55, error], params.0.as_slice()].concat())
        }
        Packet::FastStatus { .. } => None,
    }
}

fn has_pattern(body: &[u8], at: usize) -> bool {
    body.get(at..).is_some_and(|rest| rest.starts_with(&PATTERN))
}
