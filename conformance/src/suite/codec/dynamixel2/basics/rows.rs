//! The smallest packet for each thing that may go wrong on its own.

use actucheck_spec::wire::dynamixel2::reference::{self, BROADCAST, PATTERN};
use actucheck_spec::wire::dynamixel2::{Block, Packet};

use super::super::kind::REGISTER;
use super::super::{BACKUP, CLEAR};
use super::{RECEIVE, TRANSMIT};

/// A packet, and which packets go wrong with it.
pub(super) struct Row {
    /// The name with the packet's kind.
    pub(super) name: String,
    pub(super) packet: Packet,
    pub(super) has: Has,
    /// The requirement on its sender.
    pub(super) sent: &'static str,
    /// The requirement on its receiver.
    pub(super) read: &'static str,
    /// The requirement on a receiver that reads it alone, but does not find it in a stream.
    pub(super) found: &'static str,
}

/// Whether a packet has what a row is about.
#[derive(Clone, Copy)]
pub(super) enum Has {
    Packet(fn(&Packet) -> bool),
    /// By its instruction, error and parameters before stuffing.
    Body(fn(&[u8]) -> bool),
}

const fn kind(packet: &Packet) -> &'static str {
    match packet {
        Packet::Instruction { .. } => "instruction",
        Packet::Status { .. } => "status",
        Packet::FastStatus { .. } => "fast-status",
    }
}

impl Row {
    /// The name of another check of the same kind of packet.
    pub(super) fn sibling(&self, what: &str) -> String {
        format!("{what}.{}", kind(&self.packet))
    }
}

/// A row whose sentence is about senders and receivers.
fn row(what: &str, both: &'static str, packet: Packet, has: fn(&Packet) -> bool) -> Row {
    let name = format!("{what}.{}", kind(&packet));
    Row { name, packet, has: Has::Packet(has), sent: both, read: both, found: both }
}

fn instruction(id: u8, instruction: u8, params: &[u8]) -> Packet {
    Packet::Instruction { id, instruction, params: params.to_vec().into() }
}

fn status(id: u8, error: u8, params: &[u8]) -> Packet {
    Packet::Status { id, error, params: params.to_vec().into() }
}

/// The plainest packets, with IDs and data whose CRC has two equal bytes, each with one whose CRC
/// has not.
pub(super) fn plain() -> [(Row, Packet); 2] {
    let of_instruction = "dynamixel2.packet.layout";
    let of_status = "dynamixel2.status-packet.layout";
    [
        (
            row("plain", of_instruction, instruction(113, 0x01, &[]), |_| true),
            instruction(1, 0x01, &[]),
        ),
        (row("plain", of_status, status(1, 0, &[0x17]), |_| true), status(1, 0, &[0x2A])),
    ]
}

/// Single fields, and the number of parameters.
pub(super) fn fields() -> Vec<Row> {
    let id = "dynamixel2.packet.id.range";
    let error = "dynamixel2.status-packet.error.fields";
    vec![
        row(
            "parameter",
            "dynamixel2.packet.length.instruction",
            instruction(1, 0x06, &[0xFF]),
            |it| params(it) > 0,
        ),
        row("no-parameter", "dynamixel2.packet.length.status", status(1, 0, &[]), |it| {
            params(it) == 0
        }),
        row("id-0", id, instruction(0, 0x01, &[]), |it| ids(it, |id| id == 0)),
        row("id-0", id, status(0, 0, &[0x2A]), |it| ids(it, |id| id == 0)),
        row("id-252", id, instruction(252, 0x01, &[]), |it| {
            ids(it, |id| (128..=252).contains(&id))
        }),
        row("id-252", id, status(252, 0, &[0x2A]), |it| ids(it, |id| (128..=252).contains(&id))),
        row("broadcast", "dynamixel2.packet.layout", instruction(BROADCAST, 0x01, &[]), |it| {
            ids(it, |id| id == BROADCAST)
        }),
        row("error", error, status(1, 0x07, &[]), |it| errors(it, |error| error & 0x7F != 0)),
        row("alert", error, status(1, 0x80, &[]), |it| errors(it, |error| error & 0x80 != 0)),
    ]
}

fn params(packet: &Packet) -> usize {
    match packet {
        Packet::Instruction { params, .. } | Packet::Status { params, .. } => params.len(),
        Packet::FastStatus { .. } => 0,
    }
}

fn ids(packet: &Packet, is: fn(u8) -> bool) -> bool {
    match packet {
        Packet::Instruction { id, .. } | Packet::Status { id, .. } => is(*id),
        Packet::FastStatus { .. } => false,
    }
}

fn errors(packet: &Packet, is: fn(u8) -> bool) -> bool {
    matches!(packet, Packet::Status { error, .. } if is(*error))
}

/// The word as the data of a Write and of a status packet.
pub(super) fn of_word(what: &str, word: &[u8], has: fn(&[u8]) -> bool) -> [Row; 2] {
    let write = instruction(1, 0x03, &[&REGISTER, word].concat());
    [write, status(1, 0, word)].map(|packet| Row {
        name: format!("{what}.{}", kind(&packet)),
        packet,
        has: Has::Body(has),
        sent: TRANSMIT,
        read: RECEIVE,
        found: RECEIVE,
    })
}

/// Bodies of 64 and of 128 bytes: some libraries work in blocks.
pub(super) fn blocks() -> [Row; 4] {
    let write = |size: usize| instruction(1, 0x03, &[&REGISTER, &*vec![0x11; size]].concat());
    let block = |what: &str, both, packet: Packet, has| Row {
        name: format!("{what}.{}", kind(&packet)),
        packet,
        has: Has::Body(has),
        sent: both,
        read: both,
        found: "dynamixel2.receive.stream",
    };
    let of_instruction = "dynamixel2.packet.length.instruction";
    let of_status = "dynamixel2.packet.length.status";
    [
        block("body-64", of_instruction, write(61), |body| body.len() == 64),
        block("body-64", of_status, status(1, 0, &[0x11; 62]), |body| body.len() == 64),
        block("body-128", of_instruction, write(125), |body| body.len() == 128),
        block("body-128", of_status, status(1, 0, &[0x11; 126]), |body| body.len() == 128),
    ]
}

/// The smallest lengths of 257, which has two equal bytes.
pub(super) fn long() -> [Row; 2] {
    let is_long = |body: &[u8]| reference::stuff(body).len() + 2 > 255;
    let write = instruction(1, 0x03, &[&REGISTER, [0x11; 252].as_slice()].concat());
    [write, status(1, 0, &[0x11; 253])].map(|packet| Row {
        name: format!("length-257.{}", kind(&packet)),
        packet,
        has: Has::Body(is_long),
        sent: "dynamixel2.packet.length",
        read: "dynamixel2.receive.length",
        found: "dynamixel2.receive.stream",
    })
}

/// Each instruction with one device, then with two, then with an address of two bytes.
pub(super) fn instructions() -> Vec<Row> {
    let one = |what: &str, requirement, code, params: &[u8], has| {
        row(what, requirement, instruction(1, code, params), has)
    };
    let all = |what: &str, requirement, code, params: &[u8], has| {
        row(what, requirement, instruction(BROADCAST, code, params), has)
    };
    let write = "dynamixel2.write.parameters";
    vec![
        one("read", "dynamixel2.read.parameters", 0x02, &[132, 0, 4, 0], |it| is(it, 0x02)),
        one("write", write, 0x03, &[64, 0, 1], |it| is(it, 0x03)),
        one("reg-write", "dynamixel2.reg-write.parameters", 0x04, &[64, 0, 1], |it| is(it, 0x04)),
        one("action", "dynamixel2.action.parameters", 0x05, &[], |it| is(it, 0x05)),
        one("factory-reset", "dynamixel2.factory-reset.parameters", 0x06, &[0x01], |it| {
            is(it, 0x06)
        }),
        one("reboot", "dynamixel2.reboot.parameters", 0x08, &[], |it| is(it, 0x08)),
        one("clear", "dynamixel2.clear.parameters", 0x10, &CLEAR, |it| is(it, 0x10)),
        one("backup", "ja40.backup.parameters", 0x20, &BACKUP, |it| is(it, 0x20)),
        all("sync-read", "dynamixel2.sync-read.parameters", 0x82, &[132, 0, 4, 0, 7], |it| {
            is(it, 0x82)
        }),
        all(
            "sync-read-two",
            "dynamixel2.sync-read.parameters",
            0x82,
            &[132, 0, 4, 0, 7, 3],
            |it| several(it, 0x82),
        ),
        all("sync-write", "dynamixel2.sync-write.parameters", 0x83, &[64, 0, 1, 0, 7, 1], |it| {
            is(it, 0x83)
        }),
        all(
            "sync-write-two",
            "dynamixel2.sync-write.parameters",
            0x83,
            &[64, 0, 1, 0, 7, 1, 3, 0],
            |it| several(it, 0x83),
        ),
        all("bulk-read", "dynamixel2.bulk-read.parameters", 0x92, &[7, 132, 0, 4, 0], |it| {
            is(it, 0x92)
        }),
        all(
            "bulk-read-two",
            "dynamixel2.bulk-read.parameters",
            0x92,
            &[7, 132, 0, 4, 0, 3, 126, 0, 2, 0],
            |it| several(it, 0x92),
        ),
        all("bulk-write", "dynamixel2.bulk-write.parameters", 0x93, &[7, 64, 0, 1, 0, 1], |it| {
            is(it, 0x93)
        }),
        all(
            "bulk-write-two",
            "dynamixel2.bulk-write.parameters",
            0x93,
            &[7, 64, 0, 1, 0, 1, 3, 102, 0, 2, 0, 0x2A, 0x01],
            |it| several(it, 0x93),
        ),
        all("fast-sync-read", "ja40.fast-sync-read.parameters", 0x8A, &[132, 0, 4, 0, 7], |it| {
            is(it, 0x8A)
        }),
        all(
            "fast-sync-read-two",
            "ja40.fast-sync-read.parameters",
            0x8A,
            &[132, 0, 4, 0, 7, 3],
            |it| several(it, 0x8A),
        ),
        all(
            "fast-sync-write",
            "ja40.fast-sync-write.parameters",
            0x8B,
            &[64, 0, 1, 0, 7, 1],
            |it| is(it, 0x8B),
        ),
        all(
            "fast-sync-write-two",
            "ja40.fast-sync-write.parameters",
            0x8B,
            &[64, 0, 1, 0, 7, 1, 3, 0],
            |it| several(it, 0x8B),
        ),
        one("high-address-write", write, 0x03, &[0x34, 0x02, 1], |it| {
            !is(it, 0x02) && high_address(it)
        }),
        one("high-address-read", "dynamixel2.read.parameters", 0x02, &[0x44, 0x02, 4, 0], |it| {
            is(it, 0x02) && high_address(it)
        }),
    ]
}

fn is(packet: &Packet, code: u8) -> bool {
    matches!(packet, Packet::Instruction { instruction, .. } if *instruction == code)
}

/// Whether it is this instruction, for several devices.
fn several(packet: &Packet, code: u8) -> bool {
    let Packet::Instruction { params, .. } = packet else { return false };
    let one = match (code, params.0.as_slice()) {
        (0x82 | 0x8A | 0x92, _) => 5,
        (0x83 | 0x8B, [_, _, low, high, ..]) | (0x93, [_, _, _, low, high, ..]) => {
            5 + usize::from(u16::from_le_bytes([*low, *high]))
        }
        _ => return false,
    };
    is(packet, code) && params.len() > one
}

/// Whether an address needs its second byte.
fn high_address(packet: &Packet) -> bool {
    let Packet::Instruction { instruction, params, .. } = packet else { return false };
    match (instruction, params.0.as_slice()) {
        (0x02 | 0x03 | 0x04 | 0x82 | 0x83 | 0x8A | 0x8B, [_, high, ..])
        | (0x92 | 0x93, [_, _, high, ..]) => *high != 0,
        _ => false,
    }
}

/// The answers of several devices at once.
pub(super) fn fast() -> [Row; 5] {
    let read = "ja40.fast-sync-read.status";
    let write = "ja40.fast-sync-write.status";
    let blocks = |ids: &[u8], data: &[u8]| Packet::FastStatus {
        blocks: ids
            .iter()
            .map(|id| Block { error: 0, id: *id, data: data.to_vec().into() })
            .collect(),
    };
    [
        row("read", read, blocks(&[7], &[0x2A]), |it| {
            all_blocks(it).iter().any(|it| !it.data.is_empty())
        }),
        row("read-two", read, blocks(&[7, 3], &[0x2A]), |it| {
            all_blocks(it).iter().filter(|block| !block.data.is_empty()).count() > 1
        }),
        row("write", write, blocks(&[7], &[]), |it| {
            all_blocks(it).iter().any(|it| it.data.is_empty())
        }),
        row("write-two", write, blocks(&[7, 3], &[]), |it| {
            all_blocks(it).iter().filter(|block| block.data.is_empty()).count() > 1
        }),
        row("unstuffed", "ja40.fast-sync-read.unstuffed", blocks(&[7], &PATTERN), |it| {
            all_blocks(it).iter().any(|block| super::has_pattern(&block.data, &PATTERN))
        }),
    ]
}

fn all_blocks(packet: &Packet) -> &[Block] {
    match packet {
        Packet::FastStatus { blocks } => blocks,
        _ => &[],
    }
}
