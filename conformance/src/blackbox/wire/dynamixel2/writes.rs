//! Requests that write a register of a device, in every way, and that read it back.

use actucheck_spec::wire::dynamixel2::reference::BROADCAST;
use actucheck_spec::wire::dynamixel2::{Packet, WIRE};
use proptest::prelude::{BoxedStrategy, Just, Strategy, any};
use proptest::prop_oneof;
use proptest::sample::select;

use super::packets::packet_of;
use crate::suite::device::Target;
use crate::suite::device::dynamixel2::{Place, is_measured};

const READ: u8 = 0x02;
const WRITE: u8 = 0x03;
const REG_WRITE: u8 = 0x04;
const ACTION: u8 = 0x05;
const SYNC_WRITE: u8 = 0x83;
const FAST_SYNC_WRITE: u8 = 0x8B;
const BULK_WRITE: u8 = 0x93;
/// What writes to several devices.
const SEVERAL: [(&str, u8); 3] =
    [("Sync Write", SYNC_WRITE), ("Fast Sync Write", FAST_SYNC_WRITE), ("Bulk Write", BULK_WRITE)];

/// A read of the register.
pub(super) fn reads_back(target: &Target<'_>, place: Place) -> BoxedStrategy<Packet> {
    let range = [place.address, place.size].map(u16::to_le_bytes).concat();
    Just(packet_of(target.id, READ, range)).boxed()
}

/// A write of the register, mostly to the device.
pub(super) fn writes(target: &Target<'_>, place: Place) -> BoxedStrategy<Packet> {
    let (id, absent) = (target.id, target.absent(WIRE));
    let alone = move |(to, code, data): (u8, u8, Vec<u8>)| {
        packet_of(to, code, [&place.address.to_le_bytes()[..], &data].concat())
    };
    let to = prop_oneof![10 => Just(id), 1 => Just(absent), 1 => Just(BROADCAST)];
    let code = prop_oneof![4 => Just(WRITE), 1 => Just(REG_WRITE)];
    let several = several(target, place, value(place));
    // What is for reading only is refused.
    let refused =
        (any::<u32>(), select(refused(target))).prop_map(move |(value, (address, size))| {
            let data = value.to_le_bytes().into_iter().take(size.into());
            let address = address.to_le_bytes().into_iter();
            packet_of(id, WRITE, address.chain(data).collect())
        });
    prop_oneof![
        8 => (to, code, data(place)).prop_map(alone),
        1 => Just(packet_of(id, ACTION, Vec::new())),
        2 => several,
        1 => refused,
    ]
    .boxed()
}

/// A write that is taken, one whose effect is worth to be looked at, and a read of what is held then.
pub(super) fn between(
    target: &Target<'_>,
    place: Place,
) -> impl Strategy<Value = [Packet; 3]> + use<> {
    let to = |id: u8| {
        move |data: Vec<u8>| {
            packet_of(id, WRITE, [&place.address.to_le_bytes()[..], &data].concat())
        }
    };
    let write = to(target.id);
    let outside = select(vec![place.min.saturating_sub(1), place.max.saturating_add(1)])
        .prop_map(move |value| bytes(place, value));
    let odd = prop_oneof![
        2 => prop_oneof![short(place), outside.boxed()].prop_map(write),
        1 => taken(place).prop_map(to(BROADCAST)),
        4 => several(target, place, taken(place)),
    ];
    (taken(place).prop_map(write), odd, reads_back(target, place))
        .prop_map(|(write, odd, read)| [write, odd, read])
}

/// What writes such values to several devices, to this one among them or not.
fn several(
    target: &Target<'_>,
    place: Place,
    value: BoxedStrategy<Vec<u8>>,
) -> BoxedStrategy<Packet> {
    let (id, absent) = (target.id, target.absent(WIRE));
    let ids = vec![vec![id], vec![id, absent], vec![absent, id], vec![absent]];
    let has = |(name, _): &(&str, u8)| {
        target.device.is_some_and(|device| device.instructions.iter().any(|own| own == name))
    };
    let codes: Vec<_> = SEVERAL.into_iter().filter(has).map(|(_, code)| code).collect();
    // What there is not is not asked then.
    let codes = if codes.is_empty() { vec![SYNC_WRITE] } else { codes };
    (select(codes), select(ids), value.clone(), value)
        .prop_map(move |(code, ids, one, other)| to_several(code, place, &ids, &[one, other]))
        .boxed()
}

/// Where nothing can be written: registers for reading, and behind all registers.
fn refused(target: &Target<'_>) -> Vec<(u16, u16)> {
    let registers = target.device.map_or(&[][..], |device| &device.registers);
    let measured = registers.iter().filter(|register| is_measured(register));
    let measured = measured.map(|register| (register.address, register.kind.size()));
    measured.chain([(u16::MAX, 1)]).collect()
}

/// A value of the register, near the ends of its range or anywhere, or a part of one.
fn data(place: Place) -> BoxedStrategy<Vec<u8>> {
    prop_oneof![8 => value(place), 1 => short(place)].boxed()
}

/// A part of a value, if it has parts.
fn short(place: Place) -> BoxedStrategy<Vec<u8>> {
    let size = usize::from(place.size);
    (value(place), 1..=size.max(2) - 1)
        .prop_map(|(data, size)| data.into_iter().take(size).collect())
        .boxed()
}

/// A value of its range.
fn taken(place: Place) -> BoxedStrategy<Vec<u8>> {
    let Place { min, max, .. } = place;
    prop_oneof![1 => select(vec![min, max]), 3 => min..=max]
        .prop_map(move |value| bytes(place, value))
        .boxed()
}

fn bytes(place: Place, value: i64) -> Vec<u8> {
    value.to_le_bytes().into_iter().take(place.size.into()).collect()
}

fn value(place: Place) -> BoxedStrategy<Vec<u8>> {
    let Place { min, max, .. } = place;
    let ends = vec![min, max, min.saturating_sub(1), max.saturating_add(1), min.midpoint(max)];
    prop_oneof![2 => select(ends), 2 => min..=max, 1 => any::<i32>().prop_map(i64::from)]
        .prop_map(move |value| bytes(place, value))
        .boxed()
}

/// An instruction that writes values to several devices.
fn to_several(code: u8, place: Place, ids: &[u8], values: &[Vec<u8>; 2]) -> Packet {
    let range = [place.address, place.size].map(u16::to_le_bytes).concat();
    let (head, each) =
        if code == BULK_WRITE { (&[][..], &range[..]) } else { (&range[..], &[][..]) };
    let blocks = ids.iter().zip(values).flat_map(|(id, data)| [&[*id][..], each, data].concat());
    packet_of(BROADCAST, code, head.iter().copied().chain(blocks).collect())
}
