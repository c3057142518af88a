//! Fast status packets that break one rule each.

use actucheck_spec::wire::Fast;
use actucheck_spec::wire::dynamixel2::reference::{self, BROADCAST, HEADER, PREFIX, STATUS};
use actucheck_spec::wire::dynamixel2::{Block, Packet};

use super::{Kind, asked, blocks, ids};
use crate::adapter::{Output, Question};
use crate::suite::check::{Check, Demand};
use crate::suite::plan::Family;
use crate::suite::{Author, changed};

const LAST_CRC: &str = "dynamixel2.receive.crc";
const LENGTH: &str = "dynamixel2.receive.length";

pub(super) fn families(author: Author<'_>) -> [Family<'_>; 3] {
    [
        Family::of("ja40.fast.crc.", move || crcs(&author)),
        Family::of("ja40.fast.length.", move || lengths(&author)),
        Family::of("ja40.fast.field.", move || fields(&author)),
    ]
}

/// The bytes of a fast status packet. `crc` yields the CRC of each block from the block's number,
/// the bytes before the CRC, and the right one.
fn frame(blocks: &[Block], crc: impl Fn(usize, &[u8], u16) -> u16) -> Vec<u8> {
    let size: usize = blocks.iter().map(|block| block.data.len() + 4).sum();
    let length = u16::try_from(size + 1).unwrap_or(u16::MAX);
    let mut frame = [&HEADER[..], &[BROADCAST], &length.to_le_bytes(), &[STATUS]].concat();
    let (mut sum, mut summed) = (0, 0);
    for (number, block) in blocks.iter().enumerate() {
        frame.extend([block.error, block.id]);
        frame.extend(block.data.iter());
        sum = reference::crc_behind(sum, frame.get(summed..).unwrap_or_default());
        summed = frame.len();
        let crc = crc(number, &frame, sum);
        frame.extend(crc.to_le_bytes());
    }
    frame
}

fn right(blocks: &[Block]) -> Vec<u8> {
    frame(blocks, |_, _, right| right)
}

/// A wrong CRC after each block alone, after every block, and computed over other bytes. The CRCs
/// after a wrong one are those of the bytes as they are.
fn crcs(author: &Author<'_>) -> Vec<Check> {
    let mut checks = Vec::new();
    for kind in Kind::ALL {
        let id = |name: String| format!("ja40.fast.crc.{}.{name}/decode", kind.name());
        let three = blocks(&ids(3), kind.size());
        let mut add = |name, requirement, blocks: &[Block], bytes| {
            checks.push(author.decoded(id(name), requirement, asked(blocks), bytes));
        };
        for wrong in 0..3 {
            let requirement = if wrong == 2 { LAST_CRC } else { kind.status() };
            for bit in 0..16 {
                let bytes = flipped(&three, wrong, bit);
                add(format!("block-{}.bit-{bit}", wrong + 1), requirement, &three, bytes);
            }
        }
        for devices in [16, 253] {
            let many = blocks(&ids(devices), kind.size());
            for wrong in [0, devices / 2, devices - 2] {
                let bytes = flipped(&many, wrong, 0);
                add(format!("{devices}-devices.block-{}", wrong + 1), kind.status(), &many, bytes);
            }
        }
        let every = frame(&three, |_, _, right| !right);
        add("every-block".to_owned(), LAST_CRC, &three, every);
        let own = kind.size() + 2;
        let alone = with_inner(&three, |before| before.get(before.len() - own..));
        add("of-the-block-alone".to_owned(), kind.status(), &three, alone);
        let body = with_inner(&three, |before| before.get(PREFIX..));
        add("without-the-header".to_owned(), kind.status(), &three, body);
    }
    checks
}

/// One bit of the CRC after one block is wrong.
fn flipped(blocks: &[Block], wrong: usize, bit: u32) -> Vec<u8> {
    frame(blocks, |number, _, right| right ^ if number == wrong { 1 << bit } else { 0 })
}

/// Every CRC but the last one is that of a part of the bytes before it.
fn with_inner(blocks: &[Block], part: impl Fn(&[u8]) -> Option<&[u8]>) -> Vec<u8> {
    frame(blocks, |number, before, right| {
        let inner = part(before).filter(|_| number + 1 < blocks.len());
        inner.map_or(right, reference::crc)
    })
}

/// Packets with more or fewer bytes or devices than asked for.
fn lengths(author: &Author<'_>) -> Vec<Check> {
    let mut checks = Vec::new();
    for kind in Kind::ALL {
        let id = |name: String| format!("ja40.fast.length.{}.{name}/decode", kind.name());
        let [two, three] = [2, 3].map(|devices| blocks(&ids(devices), kind.size()));
        let (whole, fast) = (right(&two), asked(&two));
        let mut add = |name: String, requirement, fast: &Fast, bytes| {
            checks.push(author.decoded(id(name), requirement, fast.clone(), bytes));
        };
        for end in 0..whole.len() {
            let bytes = whole.get(..end).unwrap_or_default().to_vec();
            add(format!("cut-at-{end}"), LENGTH, &fast, bytes);
        }
        add("device-missing".to_owned(), kind.length(), &asked(&three), whole.clone());
        add("device-more".to_owned(), kind.length(), &fast, right(&three));
        add("no-device".to_owned(), kind.length(), &fast, right(&[]));
        for size in [1, 2, 8] {
            let other = right(&blocks(&ids(2), size));
            add(format!("{size}-bytes"), kind.length(), &fast, other);
        }
        let followed = |name: &str, behind: &[u8]| {
            followed(author, id(name.to_owned()), &two, [whole.as_slice(), behind].concat())
        };
        checks.push(followed("trailing-00", &[0x00]));
        checks.push(followed("trailing-55", &[0x55]));
        checks.push(followed("trailing-ff", &[0xFF]));
        checks.push(followed("twice", &whole));
    }
    checks
}

/// A good packet with bytes after it. It is complete, and no sentence says that it is refused for them.
fn followed(author: &Author<'_>, id: String, blocks: &[Block], bytes: Vec<u8>) -> Check {
    let packet = Packet::FastStatus { blocks: blocks.to_vec() };
    let demand = Demand::record(
        "Is a fast status packet read that has bytes behind it?",
        [("without them", Output::Packet(packet.into()))],
    );
    let context = asked(blocks).into();
    let question = Question::Decode { wire: author.wire, bytes: bytes.into(), context };
    author.check(id, LENGTH, question, demand)
}

/// Packets with a wrong byte whose CRCs after it are right, or with a wrong byte that only the last
/// CRC takes into account.
fn fields(author: &Author<'_>) -> Vec<Check> {
    let mut checks = Vec::new();
    for kind in Kind::ALL {
        let three = blocks(&ids(3), kind.size());
        let (whole, fast) = (right(&three), asked(&three));
        let mut add = |name: &str, requirement, bytes| {
            let id = format!("ja40.fast.field.{}.{name}/decode", kind.name());
            checks.push(author.decoded(id, requirement, fast.clone(), bytes));
        };
        for (name, requirement, at, byte) in [
            ("header-1", "dynamixel2.receive.header", 0, 0xFE),
            ("header-2", "dynamixel2.receive.header", 1, 0xFE),
            ("header-3", "dynamixel2.receive.header", 2, 0xFC),
            ("reserved", "dynamixel2.packet.reserved", 3, 0x01),
            ("instruction", "dynamixel2.status-packet.layout", PREFIX, 0x54),
        ] {
            add(name, requirement, mended(&changed(&whole, at, |_| byte), kind));
        }
        let block = kind.size() + 4;
        for number in 0..2 {
            let begin = PREFIX + 1 + number * block;
            // All of the block but its ID and CRC.
            for at in (begin..begin + block - 2).filter(|at| *at != begin + 1) {
                let mut bytes = changed(&whole, at, |byte| byte ^ 0x10);
                reference::repair(&mut bytes);
                add(&format!("block-{}.byte-{}", number + 1, at - begin), kind.status(), bytes);
            }
        }
    }
    checks
}

/// The same bytes with the right CRC after each block.
fn mended(bytes: &[u8], kind: Kind) -> Vec<u8> {
    let mut frame = bytes.get(..=PREFIX).unwrap_or_default().to_vec();
    let blocks = bytes.get(PREFIX + 1..).unwrap_or_default().chunks(kind.size() + 4);
    for block in blocks {
        frame.extend(block.split_last_chunk::<2>().map_or(block, |(block, _)| block));
        let crc = reference::crc(&frame);
        frame.extend(crc.to_le_bytes());
    }
    frame
}
