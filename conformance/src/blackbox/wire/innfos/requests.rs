//! Datagrams to a board and its actuators that only read, right ones and damaged ones, and some that write where that is
//! allowed.

use actucheck_spec::wire::Direction;
use actucheck_spec::wire::innfos::{Operation, Packet, WIRE};
use proptest::collection::vec;
use proptest::prelude::{BoxedStrategy, Just, Strategy};
use proptest::prop_oneof;
use proptest::sample::select;
use proptest::strategy::Union;

use super::byte;
use crate::adapter::{Permission, Permissions};
use crate::blackbox::ask::Request;
use crate::blackbox::probe::{Damage, Part, damages};
use crate::suite::Author;
use crate::suite::device::Target;
use crate::suite::device::innfos::{Place, places};

/// How many requests a conversation has at most.
const MOST: usize = 6;

/// The address of the board, and what is asked of it.
const BOARD: u8 = 0;
const HANDSHAKE: u8 = 0x44;
const QUERY: u8 = 0x02;

pub(super) fn requests(
    author: Author<'_>,
    target: &Target<'_>,
    allowed: &Permissions,
) -> BoxedStrategy<Vec<Request>> {
    let rows = author.spec.wires.innfos.content.commands.iter();
    let reads = rows.filter(|row| row.operation == Operation::Read).map(|row| row.code);
    let reads: Vec<_> = reads.filter(|code| ![HANDSHAKE, QUERY].contains(code)).collect();
    let only_read = vec(request(&reads, target), 1..=MOST);
    let places = places(author.spec);
    if places.is_empty() || !allowed.has(Permission::WriteRam) {
        return only_read.boxed();
    }
    let of_place = |place: Place| {
        let reads_back = Just(packet(target.id, place.read, Vec::new())).prop_map(whole);
        let one =
            prop_oneof![4 => writes(target, place), 3 => reads_back, 1 => request(&reads, target)];
        vec(one, 1..=MOST).boxed()
    };
    prop_oneof![1 => only_read, 3 => Union::new(places.into_iter().map(of_place))].boxed()
}

/// A write of a value, mostly to the actuator.
fn writes(target: &Target<'_>, place: Place) -> impl Strategy<Value = Request> + use<> {
    let to = prop_oneof![10 => Just(target.id), 1 => Just(target.absent(WIRE))];
    let ends = select(vec![place.min, place.max]);
    let value = if place.has_others {
        prop_oneof![1 => ends, 2 => place.min..=place.max].boxed()
    } else {
        ends.boxed()
    };
    (to, value).prop_map(move |(id, value)| whole(packet(id, place.write, place.bytes(value))))
}

fn whole(packet: Packet) -> Request {
    let part = Part { noise: Vec::new(), packet: packet.into(), damage: Vec::new() };
    Request { parts: vec![part], cuts: Vec::new() }
}

fn request(reads: &[u8], target: &Target<'_>) -> impl Strategy<Value = Request> + use<> {
    let (id, absent) = (target.id, target.absent(WIRE));
    let read = |id| select(reads.to_vec()).prop_map(move |command| packet(id, command, Vec::new()));
    // A request may be in the data of another, which is for nobody.
    let inner = read(id).prop_map(|inner| WIRE.encode(&inner.into()).unwrap_or_default());
    let data = prop_oneof![vec(byte(), 1..6), inner];
    let for_nobody = (select(reads.to_vec()), data)
        .prop_map(move |(command, data)| packet(absent, command, data));
    // The query takes half a second.
    let packet = prop_oneof![
        40 => read(id),
        4 => read(absent),
        2 => for_nobody,
        2 => Just(packet(BOARD, HANDSHAKE, Vec::new())),
        1 => Just(packet(BOARD, QUERY, Vec::new())),
    ];
    // Before the end, the CRC of no data.
    let crc = vec![Damage::Insert(u16::MAX - 1, 0xFF); 2];
    let damage = prop_oneof![20 => Just(Vec::new()), 8 => damages(), 1 => Just(crc)];
    (packet, damage).prop_map(|(packet, damage)| {
        let part = Part { noise: Vec::new(), packet: packet.into(), damage };
        Request { parts: vec![part], cuts: Vec::new() }
    })
}

fn packet(address: u8, command: u8, data: Vec<u8>) -> Packet {
    Packet { direction: Direction::Request, address, command, data: data.into() }
}
