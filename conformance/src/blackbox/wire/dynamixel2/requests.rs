//! Requests to a device that only read, right ones and damaged ones.

use actucheck_spec::wire::dynamixel2::reference::{BROADCAST, HEADER};
use actucheck_spec::wire::dynamixel2::{Packet, WIRE};
use proptest::collection::vec;
use proptest::prelude::{BoxedStrategy, Just, Strategy, any};
use proptest::prop_oneof;
use proptest::sample::select;
use proptest::strategy::Union;

use super::packets::{address, length, packet_of};
use super::writes::{between, reads_back, writes};
use crate::adapter::{Permission, Permissions};
use crate::blackbox::ask::Request;
use crate::blackbox::probe::{Part, damages};
use crate::suite::Author;
use crate::suite::device::Target;
use crate::suite::device::dynamixel2::{UNDEFINED, places};
use crate::suite::random::data;

/// How many requests a conversation has at most.
const MOST: usize = 6;

const PING: u8 = 0x01;
const READ: u8 = 0x02;
/// Sync Read and Fast Sync Read.
const SYNC: [u8; 2] = [0x82, 0x8A];
const BULK: u8 = 0x92;

pub(super) fn requests(
    author: Author<'_>,
    target: &Target<'_>,
    allowed: &Permissions,
) -> BoxedStrategy<Vec<Request>> {
    let reads = vec(request(own(target), target), 1..=MOST);
    let places = places(author, target);
    if places.is_empty() || !allowed.has(Permission::WriteRam) {
        return reads.boxed();
    }
    let of_place = |place| {
        let packet = prop_oneof![4 => writes(target, place), 3 => reads_back(target, place), 1 => own(target)];
        let any = vec(request(packet.boxed(), target), 1..=MOST);
        let between = between(target, place).prop_map(|three| three.map(whole).to_vec());
        prop_oneof![1 => any, 2 => between].boxed()
    };
    let writes = Union::new(places.into_iter().map(of_place));
    prop_oneof![1 => reads, 3 => writes].boxed()
}

/// What only reads from the device.
fn own(target: &Target<'_>) -> BoxedStrategy<Packet> {
    prop_oneof![
        6 => to(Just(target.id).boxed(), target),
        2 => read_with_others(target),
        1 => Just(packet_of(BROADCAST, PING, Vec::new())),
    ]
    .boxed()
}

/// A packet as it is.
fn whole(packet: Packet) -> Request {
    let part = Part { noise: Vec::new(), packet: packet.into(), damage: Vec::new() };
    Request { parts: vec![part], cuts: Vec::new() }
}

fn request(
    own: BoxedStrategy<Packet>,
    target: &Target<'_>,
) -> impl Strategy<Value = Request> + use<> {
    let absent = target.absent(WIRE);
    // What nobody answers may come before it, without a pause.
    let silent = select(vec![absent, BROADCAST]).boxed();
    let before = prop_oneof![6 => Just(0..1), 1 => Just(1..3)];
    let silent = to(silent, target);
    let before = before.prop_flat_map(move |count| vec(part(silent.clone().boxed()), count));
    let other = to(select(vec![absent, 253, BROADCAST, 255]).boxed(), target);
    let last = prop_oneof![8 => part(own), 1 => part(other)];
    let cuts = prop_oneof![7 => Just(Vec::new()), 1 => vec(any::<u16>(), 1..3)];
    (before, last, cuts).prop_map(|(mut parts, last, cuts)| {
        parts.push(last);
        Request { parts, cuts }
    })
}

/// A packet, mostly a right one, and what comes before it.
fn part(packet: BoxedStrategy<Packet>) -> BoxedStrategy<Part> {
    let noise = prop_oneof![
        10 => Just(Vec::new()),
        1 => data(1..6),
        1 => (1..HEADER.len()).prop_map(|size| HEADER.iter().copied().take(size).collect()),
    ];
    let damage = prop_oneof![6 => Just(Vec::new()), 1 => damages()];
    let part =
        |(noise, packet, damage): (_, Packet, _)| Part { noise, packet: packet.into(), damage };
    (noise, packet, damage).prop_map(part).boxed()
}

/// A Ping, a Read, or what there is not, to one of these IDs.
fn to(id: BoxedStrategy<u8>, target: &Target<'_>) -> BoxedStrategy<Packet> {
    let code = prop_oneof![
        2 => Just((PING, Vec::new())),
        7 => range(target).prop_map(|range| (READ, range)),
        1 => (select(&UNDEFINED[..]), data(0..5)),
    ];
    (id, code).prop_map(|(id, (code, params))| packet_of(id, code, params)).boxed()
}

/// What reads from several devices, here from one.
fn read_with_others(target: &Target<'_>) -> BoxedStrategy<Packet> {
    let id = target.id;
    let sync = (select(&SYNC[..]), range(target)).prop_map(move |(code, range)| {
        packet_of(BROADCAST, code, [range.as_slice(), &[id]].concat())
    });
    let bulk = range(target)
        .prop_map(move |range| packet_of(BROADCAST, BULK, [&[id], range.as_slice()].concat()));
    prop_oneof![2 => sync, 1 => bulk].boxed()
}

/// An address and a number of bytes: mostly whole registers in a row, with what is between them, or nearly
/// so.
fn range(target: &Target<'_>) -> BoxedStrategy<Vec<u8>> {
    let params = |(address, length): (u16, u16)| [address, length].map(u16::to_le_bytes).concat();
    let anywhere = (address(), length()).prop_map(|(address, length)| [address, length].concat());
    let registers = target.device.map_or(&[][..], |device| &device.registers);
    let ranges: Vec<_> = registers.iter().map(|it| (it.address, it.kind.size())).collect();
    if ranges.is_empty() {
        return anywhere.boxed();
    }
    let count = prop_oneof![3 => Just(1), 2 => 2..12_usize];
    let row = (0..ranges.len(), count)
        .prop_map(move |(first, count)| {
            let row = ranges.iter().skip(first).take(count);
            let ends = row.clone().map(|(address, size)| address + size);
            let begin = row.map(|(address, _)| *address).min().unwrap_or_default();
            (begin, ends.max().unwrap_or(begin) - begin)
        })
        .boxed();
    let near = (row.clone(), -2..3_i16, -2..3_i16).prop_map(|((address, length), at, more)| {
        (address.saturating_add_signed(at), length.saturating_add_signed(more))
    });
    prop_oneof![8 => row.prop_map(params), 2 => near.prop_map(params), 1 => anywhere].boxed()
}
