//! Implementations that are wrong with fast status packets.

use actucheck::adapter::{Output, Question};
use actucheck_spec::wire::dynamixel2::reference::{self, PATTERN, PREFIX};
use actucheck_spec::wire::dynamixel2::{Block, Packet};
use actucheck_spec::wire::{self, Fast};

use crate::{Mutant, Wrong, bytes};

/// The bytes of a fast status packet that is to be read, and the request that it answers.
fn read(op: &Question) -> Option<(&[u8], &Fast)> {
    match op {
        Question::Decode { bytes, context, .. } => Some((bytes, context.fast.as_ref()?)),
        _ => None,
    }
}

/// The blocks of a fast status packet that is to be built.
fn built(op: &Question) -> Option<&[Block]> {
    match op {
        Question::Encode { packet, .. } => match &packet.packet {
            wire::Packet::Dynamixel2(Packet::FastStatus { blocks }) => Some(blocks),
            _ => None,
        },
        _ => None,
    }
}

/// The packet of a question with other blocks.
fn reread(op: &Question, change: impl Fn(&mut Vec<Block>)) -> Option<Output> {
    let (bytes, fast) = read(op)?;
    let Ok(Packet::FastStatus { mut blocks }) = reference::decode_fast(bytes, fast) else {
        return None;
    };
    change(&mut blocks);
    Some(Output::Packet(Packet::FastStatus { blocks }.into()))
}

fn rebuilt(op: &Question, change: impl Fn(&mut Vec<Block>)) -> Option<Output> {
    let mut blocks = built(op)?.to_vec();
    change(&mut blocks);
    Some(bytes(reference::encode(&Packet::FastStatus { blocks })?))
}

/// Every block gets the error of the first.
fn first_error(blocks: &mut Vec<Block>) {
    let first = blocks[0].error;
    for block in blocks {
        block.error = first;
    }
}

/// The same bytes with the right CRC after each block.
fn mended(frame: &[u8], fast: &Fast) -> Vec<u8> {
    let mut frame = frame.to_vec();
    let block = usize::from(fast.length) + 4;
    for end in (PREFIX + 1 + block..=frame.len()).step_by(block) {
        reference::repair(&mut frame[..end]);
    }
    frame
}

/// The packet of these bytes, as another receiver reads it.
fn accepted(frame: &[u8], fast: &Fast) -> Option<Output> {
    reference::decode_fast(frame, fast).ok().map(|packet| Output::Packet(packet.into()))
}

/// Reads a packet, looking only at the CRCs of the blocks for which `looks` holds, which gets a
/// block's number and the number of blocks.
fn with_some_crcs(op: &Question, looks: impl Fn(usize, usize) -> bool) -> Option<Output> {
    let (frame, fast) = read(op)?;
    let devices = fast.ids.len();
    let block = usize::from(fast.length) + 4;
    let is_right = |number: usize| {
        let (before, end) = frame.get(..PREFIX + 1 + (number + 1) * block)?.split_last_chunk()?;
        Some(reference::crc(before) == u16::from_le_bytes(*end))
    };
    let are_right = (0..devices)
        .filter(|number| looks(*number, devices))
        .all(|number| is_right(number).unwrap_or_default());
    are_right.then(|| accepted(&mended(frame, fast), fast))?
}

/// The frame in which the CRC of each block is computed over a part of the bytes before it.
fn with_crcs(blocks: &[Block], part: impl Fn(&[u8], usize) -> Vec<u8>) -> Option<Output> {
    let mut frame = reference::encode(&Packet::FastStatus { blocks: blocks.to_vec() })?;
    let mut at = PREFIX + 1;
    for block in blocks {
        let start = at;
        at += block.data.len() + 4;
        let crc = reference::crc(&part(&frame[..at - 2], start));
        frame[at - 2..at].copy_from_slice(&crc.to_le_bytes());
    }
    Some(bytes(frame))
}

const STATUS: &str = "ja40.fast-sync-read.status";

const fn mutant(
    name: &'static str,
    blames: &'static str,
    wrong: fn(&Question) -> Option<Output>,
    found_by: &'static str,
) -> Mutant {
    Mutant { name, blames, wrong: Wrong::Answers(wrong), found_by, found_by_documents: false }
}

pub(super) static MUTANTS: [Mutant; 18] = [
    mutant(
        "reports the first block's error for all",
        STATUS,
        |op| reread(op, first_error),
        "ja40.fast.error.read.04.block-1/decode",
    ),
    mutant(
        "builds every block with the first one's error",
        STATUS,
        |op| rebuilt(op, first_error),
        "ja40.fast.error.read.04.block-2/encode",
    ),
    mutant(
        "drops the alert bit of a block",
        STATUS,
        |op| reread(op, |blocks| blocks.iter_mut().for_each(|block| block.error &= 0x7F)),
        "ja40.fast.error.read.80.block-3/decode",
    ),
    mutant(
        "has no data of a device with an error",
        STATUS,
        |op| {
            reread(op, |blocks| {
                let failed = blocks.iter_mut().filter(|block| block.error != 0);
                failed.for_each(|block| block.data.0.clear());
            })
        },
        "ja40.fast.error.read.04.block-2/decode",
    ),
    mutant(
        "gives up at the first block with an error",
        STATUS,
        |op| {
            reread(op, |blocks| {
                let good = blocks.iter().position(|block| block.error != 0);
                blocks.truncate(good.map_or(blocks.len(), |place| place + 1));
            })
        },
        "ja40.fast.error.write.04.block-1/decode",
    ),
    mutant(
        "sorts the blocks by ID",
        STATUS,
        |op| reread(op, |blocks| blocks.sort_by_key(|block| block.id)),
        "ja40.fast.order.read.descending/decode",
    ),
    mutant(
        "builds the blocks by rising ID",
        STATUS,
        |op| rebuilt(op, |blocks| blocks.sort_by_key(|block| block.id)),
        "ja40.fast.order.read.rotated/encode",
    ),
    mutant(
        "looks at the last CRC only",
        STATUS,
        |op| with_some_crcs(op, |number, devices| number + 1 == devices),
        "ja40.fast.crc.read.block-1.bit-0/decode",
    ),
    mutant(
        "looks at the last CRC only when there is no data",
        "ja40.fast-sync-write.status",
        |op| {
            read(op).filter(|(_, fast)| fast.length == 0)?;
            with_some_crcs(op, |number, devices| number + 1 == devices)
        },
        "ja40.fast.crc.write.block-2.bit-15/decode",
    ),
    mutant(
        "does not look at the last CRC",
        "dynamixel2.receive.crc",
        |op| with_some_crcs(op, |number, devices| number + 1 < devices),
        "ja40.fast.crc.read.block-3.bit-0/decode",
    ),
    mutant(
        "looks at the CRCs of the first two blocks and the last one",
        STATUS,
        |op| with_some_crcs(op, |number, devices| number < 2 || number + 1 == devices),
        "ja40.fast.crc.read.16-devices.block-9/decode",
    ),
    Mutant {
        found_by_documents: true,
        ..mutant(
            "computes each CRC over its own block",
            STATUS,
            |op| with_crcs(built(op)?, |before, start| before[start..].to_vec()),
            "ja40.fast.order.read.ascending/encode",
        )
    },
    Mutant {
        found_by_documents: true,
        ..mutant(
            "leaves the earlier CRCs out of the later ones",
            STATUS,
            |op| {
                let blocks = built(op)?;
                let size = blocks.first()?.data.len() + 4;
                with_crcs(blocks, |before, _| {
                    let (start, blocks) = before.split_at(PREFIX + 1);
                    let plain = |block: &[u8]| block[..block.len().min(size - 2)].to_vec();
                    [start.to_vec(), blocks.chunks(size).flat_map(plain).collect()].concat()
                })
            },
            "ja40.fast.order.read.ascending/encode",
        )
    },
    Mutant {
        wrong: Wrong::Rejects(|op| {
            read(op).is_some_and(|(frame, _)| {
                let body = frame.get(PREFIX..).unwrap_or_default();
                body.windows(3).any(|window| window == PATTERN)
            })
        }),
        ..mutant(
            "looks for stuffing in what it reads",
            "ja40.fast-sync-read.unstuffed",
            |_| None,
            "ja40.fast.pattern.across.crc-error/decode",
        )
    },
    mutant(
        "stuffs a fast status packet",
        "ja40.fast-sync-read.unstuffed",
        |op| {
            let frame = reference::encode(&Packet::FastStatus { blocks: built(op)?.to_vec() })?;
            Some(bytes(reference::frame(0xFE, &reference::stuff(&frame[PREFIX..frame.len() - 2]))))
        },
        "ja40.fast.pattern.fffffd.first.block-1/encode",
    ),
    mutant(
        "reads 252 devices at most",
        "ja40.fast-sync-write.length",
        |op| reread(op, |blocks| blocks.truncate(252)),
        "ja40.fast.size.4-bytes.253-devices/decode",
    ),
    mutant(
        "builds the length's low byte only",
        "ja40.fast-sync-write.length",
        |op| {
            let blocks = built(op)?;
            let mut frame = reference::encode(&Packet::FastStatus { blocks: blocks.to_vec() })?;
            frame[6] = 0;
            let length = u16::try_from(blocks.first()?.data.len()).ok()?;
            Some(bytes(mended(&frame, &Fast { length, ids: Vec::new() })))
        },
        "ja40.fast.size.4-bytes.64-devices/encode",
    ),
    mutant(
        "takes an answer in which a device is missing",
        "ja40.fast-sync-read.length",
        |op| {
            let (frame, fast) = read(op)?;
            let devices = frame.len().checked_sub(PREFIX + 1)? / (usize::from(fast.length) + 4);
            let ids = fast.ids.iter().take(devices).copied().collect();
            accepted(frame, &Fast { ids, ..*fast })
        },
        "ja40.fast.length.read.device-missing/decode",
    ),
];
