//! Packets of every kind, at the ends of what their fields allow.

use actucheck_spec::wire::Direction;
use actucheck_spec::wire::dynamixel2::reference::{
    BROADCAST, HEADER, PATTERN, STATUS, frame, stuff,
};
use actucheck_spec::wire::dynamixel2::{Block, Packet};
use proptest::collection::vec;
use proptest::prelude::{BoxedStrategy, Just, Strategy, any};
use proptest::prop_oneof;
use proptest::sample::select;
use proptest::strategy::Union;

use super::exists::{BACKUP, CLEAR, FACTORY_RESET};
use crate::adapter::Limits;
use crate::blackbox::payload::payload;
use crate::suite::codec::dynamixel2::crc;
use crate::suite::random::data;

/// Numbers at the ends of a byte and of two bytes, and those whose bytes are of the pattern.
const ENDS: [u16; 10] = [0, 1, 255, 256, 0x00FD, 0xFDFF, 0xFFFD, 0xFFFE, 0xFFFF, 0xFF00];
/// How many devices there are: around powers of two, and most often every one.
const MANY: [usize; 14] = [16, 31, 32, 63, 64, 65, 127, 128, 129, 252, 253, 253, 253, 253];
/// The IDs that no packet may have.
const NO_DEVICES: [u8; 2] = [253, 255];
/// The number of IDs that devices may have.
const DEVICES: usize = 253;
/// Bytes of a frame around the parameters of an instruction, and of a status packet.
const AROUND: [usize; 2] = [10, 11];

pub(super) fn packet(limits: &Limits) -> BoxedStrategy<Packet> {
    prop_oneof![
        8 => status(limits),
        10 => instruction(limits),
        4 => fast_status(),
        1 => pattern_from_the_instruction(),
        1 => to_no_device(limits),
        // One packet of many thousands has such a CRC by chance.
        1 => select(crc::packets()),
    ]
    .boxed()
}

pub(super) fn streamed(limits: &Limits, direction: Direction) -> BoxedStrategy<Packet> {
    match direction {
        Direction::Reply => status(limits),
        Direction::Request => instruction(limits),
    }
}

/// What looks like the beginning of a packet and is none, or is a packet that others send.
pub(super) fn noise() -> BoxedStrategy<Vec<u8>> {
    let claim = || (id(), prop_oneof![3..40_u16, any::<u16>()], data(0..24));
    prop_oneof![
        (1..=HEADER.len()).prop_map(|size| HEADER.iter().copied().take(size).collect()),
        // A header that byte stuffing has made harmless, with a length after it.
        claim().prop_map(|claim| claiming(&[&PATTERN[..], &[0xFD]].concat(), claim)),
        claim().prop_map(|claim| claiming(&HEADER, claim)),
        // A packet of the other direction, such as a host's own Write.
        (id(), data(1..8)).prop_map(|(id, data)| frame(
            id,
            &stuff(&[&[0x03, 0x74, 0x00], data.as_slice()].concat())
        )),
        // A whole packet, but for its ID.
        (select(&NO_DEVICES[..]), data(0..8)).prop_map(|(id, params)| {
            frame(id, &stuff(&[&[STATUS, 0], params.as_slice()].concat()))
        }),
    ]
    .boxed()
}

fn claiming(header: &[u8], (id, length, behind): (u8, u16, Vec<u8>)) -> Vec<u8> {
    [header, &[id], &length.to_le_bytes(), &behind].concat()
}

fn status(limits: &Limits) -> BoxedStrategy<Packet> {
    // Many libraries return no data if there is an error.
    let error = prop_oneof![6 => Just(0), 1 => Just(0xFF), 2 => any::<u8>()];
    (id(), error, payload(AROUND[1], limits))
        .prop_map(|(id, error, params)| Packet::Status { id, error, params: params.into() })
        .boxed()
}

/// One packet with the answers of several devices.
fn fast_status() -> BoxedStrategy<Packet> {
    let size = prop_oneof![2 => Just(0), 2 => Just(4), 3 => 1..12_usize, 1 => 12..250_usize];
    (ids(), size, data(1..40), vec(prop_oneof![Just(0), any::<u8>()], 1..8))
        .prop_map(|(ids, size, pool, errors)| {
            let mut bytes = pool.into_iter().cycle();
            let block = |(id, error)| {
                let data: Vec<_> = bytes.by_ref().take(size).collect();
                Block { error, id, data: data.into() }
            };
            let blocks = ids.into_iter().zip(errors.into_iter().cycle()).map(block);
            Packet::FastStatus { blocks: blocks.collect() }
        })
        .boxed()
}

/// A body in which the pattern begins with the instruction.
fn pattern_from_the_instruction() -> impl Strategy<Value = Packet> {
    data(0..8).prop_map(|rest| packet_of(1, 0xFF, [&PATTERN[1..], &rest].concat()))
}

/// A packet with an ID that no packet may have.
fn to_no_device(limits: &Limits) -> BoxedStrategy<Packet> {
    let packet = prop_oneof![status(limits), instruction(limits)];
    let named = |(packet, id)| match packet {
        Packet::Status { error, params, .. } => Packet::Status { id, error, params },
        Packet::Instruction { instruction, params, .. } => packet_of(id, instruction, params.0),
        fast @ Packet::FastStatus { .. } => fast,
    };
    (packet, select(&NO_DEVICES[..])).prop_map(named).boxed()
}

fn id() -> BoxedStrategy<u8> {
    prop_oneof![1 => Just(0), 1 => Just(252), 6 => 0..=252_u8].boxed()
}

/// Different IDs, in an order that is not always ascending.
fn ids() -> BoxedStrategy<Vec<u8>> {
    let count = prop_oneof![12 => 1..6_usize, 2 => 6..40_usize, 2 => select(&MANY[..])];
    // Steps that have no divisor in common with the number of IDs reach each of them.
    (count, 0..DEVICES, select(vec![1, 2, 5, 100, 252_usize]))
        .prop_map(|(count, first, step)| {
            let ids = (0..count).map(|index| (first + index * step) % DEVICES);
            ids.filter_map(|id| u8::try_from(id).ok()).collect()
        })
        .boxed()
}

/// An address. Half of them are below 256, as some libraries support no others.
pub(super) fn address() -> BoxedStrategy<[u8; 2]> {
    prop_oneof![2 => select(&ENDS[..]), 3 => 0..256_u16, 2 => any::<u16>()]
        .prop_map(u16::to_le_bytes)
        .boxed()
}

/// A number of bytes to read.
pub(super) fn length() -> BoxedStrategy<[u8; 2]> {
    prop_oneof![2 => select(&ENDS[1..]), 5 => 1..512_u16, 1 => 1..=u16::MAX]
        .prop_map(u16::to_le_bytes)
        .boxed()
}

/// Any instruction, with parameters that fit it.
fn instruction(limits: &Limits) -> BoxedStrategy<Packet> {
    let none = || Just(Vec::new()).boxed();
    let read = (address(), length()).prop_map(|(address, length)| [address, length].concat());
    let write = || {
        (address(), payload(AROUND[0] + 2, limits))
            .prop_map(|(address, data)| [&address, data.as_slice()].concat())
            .boxed()
    };
    // To one device, or for some instructions to all.
    let one = |code: u8, params: BoxedStrategy<Vec<u8>>, all: u32| {
        let id = prop_oneof![8 => id(), all => Just(BROADCAST)];
        (id, params).prop_map(move |(id, params)| packet_of(id, code, params)).boxed()
    };
    let several = |code: u8, params: BoxedStrategy<Vec<u8>>| {
        params.prop_map(move |params| packet_of(BROADCAST, code, params)).boxed()
    };
    let fixed = |code: u8, params: &[&'static [u8]]| {
        let params = params.iter().map(|params| params.to_vec()).collect::<Vec<_>>();
        (id(), select(params)).prop_map(move |(id, params)| packet_of(id, code, params)).boxed()
    };
    Union::new_weighted(vec![
        (1, one(0x01, none(), 1)),
        (3, one(0x02, read.boxed(), 0)),
        (6, one(0x03, write(), 1)),
        (3, one(0x04, write(), 1)),
        (1, one(0x05, none(), 1)),
        (1, fixed(0x06, &FACTORY_RESET)),
        (1, one(0x08, none(), 0)),
        (1, fixed(0x10, &CLEAR)),
        (1, fixed(0x20, &BACKUP)),
        (3, several(0x82, sync_read())),
        (4, several(0x83, sync_write())),
        (3, several(0x8A, sync_read())),
        (3, several(0x8B, sync_write())),
        (3, several(0x92, bulk_read())),
        (3, several(0x93, bulk_write())),
    ])
    .boxed()
}

fn sync_read() -> BoxedStrategy<Vec<u8>> {
    (address(), length(), ids())
        .prop_map(|(address, length, ids)| [&address[..], &length, &ids].concat())
        .boxed()
}

fn sync_write() -> BoxedStrategy<Vec<u8>> {
    let size = prop_oneof![8 => 1..9_u16, 1 => 9..250_u16];
    (address(), size, ids(), data(1..40))
        .prop_map(|(address, size, ids, pool)| {
            let mut bytes = pool.into_iter().cycle();
            let mut params = [address, size.to_le_bytes()].concat();
            for id in ids {
                params.push(id);
                params.extend(bytes.by_ref().take(size.into()));
            }
            params
        })
        .boxed()
}

fn bulk_read() -> BoxedStrategy<Vec<u8>> {
    (ids(), vec((address(), length()), 1..6))
        .prop_map(|(ids, ranges)| {
            let device = |(id, (address, length)): (u8, ([u8; 2], [u8; 2]))| {
                [&[id][..], &address, &length].concat()
            };
            ids.into_iter().zip(ranges.into_iter().cycle()).flat_map(device).collect()
        })
        .boxed()
}

fn bulk_write() -> BoxedStrategy<Vec<u8>> {
    let data = prop_oneof![8 => data(1..9), 1 => data(9..250)];
    (ids(), vec((address(), data), 1..6))
        .prop_map(|(ids, writes)| {
            let device = |(id, (address, data)): (u8, ([u8; 2], Vec<u8>))| {
                let length = u16::try_from(data.len()).unwrap_or_default().to_le_bytes();
                [&[id][..], &address, &length, &data].concat()
            };
            ids.into_iter().zip(writes.into_iter().cycle()).flat_map(device).collect()
        })
        .boxed()
}

pub(super) fn packet_of(id: u8, instruction: u8, params: Vec<u8>) -> Packet {
    Packet::Instruction { id, instruction, params: params.into() }
}
