//! Many packets, packets of many sizes, and long packets.

use actucheck_spec::wire::dynamixel2::Packet;
use actucheck_spec::wire::dynamixel2::reference::BROADCAST;

use super::{Cut, FOUND, KINDS, Kind, Part, Scenario};
use crate::suite::codec::dynamixel2::LARGEST;

/// Numbers of packets, at which buffers and counters may end.
const NUMBERS: [u8; 13] = [3, 4, 5, 6, 8, 9, 10, 11, 12, 16, 20, 32, 40];

/// Bytes of data, between a lone error byte and more than a chunk of a serial port.
const SIZES: [usize; 13] = [0, 1, 2, 4, 8, 16, 31, 32, 52, 64, 150, 200, 230];

/// Sizes in bytes of whole packets: those that every receiver should take.
const FRAMES: [usize; 3] = [64, 128, 256];

/// Packets of the same size, as from one device that is asked again and again.
pub(super) fn many() -> Vec<Scenario> {
    const CUTS: &[Cut] =
        &[Cut::ByPart, Cut::Every(4), Cut::Every(7), Cut::Every(16), Cut::Every(64), Cut::Every(1)];
    let of = |kind: Kind, number: u8| {
        let parts = move || (0..number).map(|each| Part::Packet(kind.numbered(each))).collect();
        let name = format!("many.{kind}.{number}");
        Scenario::new(name, FOUND, CUTS, parts).cut_everywhere(number == 3)
    };
    KINDS.into_iter().flat_map(|kind| NUMBERS.map(|number| of(kind, number))).collect()
}

/// Bytes of data, packet after packet.
type Sizes = fn() -> Vec<usize>;

/// Packets of many sizes from or to several devices, and one request of each kind.
pub(super) fn mixed() -> Vec<Scenario> {
    const CUTS: &[Cut] = &[
        Cut::ByPart,
        Cut::Every(7),
        Cut::Every(32),
        Cut::Every(64),
        Cut::Every(100),
        Cut::Every(128),
        Cut::Every(1),
    ];
    const ORDERS: [(&str, Sizes); 3] = [
        ("rising", || SIZES.to_vec()),
        ("falling", || SIZES.into_iter().rev().collect()),
        ("in-turn", || {
            let pairs = SIZES.into_iter().zip(SIZES.into_iter().rev());
            pairs.flat_map(|(small, large)| [large, small]).collect()
        }),
    ];
    let of = |kind: Kind, (name, sizes): (&str, Sizes)| {
        let part = move |(place, size): (usize, usize)| {
            let id = u8::try_from(40 - place).unwrap_or_default();
            Part::Packet(with_id(kind.packet(&plain(size)), id))
        };
        let least = usize::from(matches!(kind, Kind::Write)); // a Write has data
        let parts = move || {
            let sizes = sizes().into_iter().map(|size| size.max(least));
            sizes.enumerate().map(part).collect()
        };
        Scenario::new(format!("mixed.{kind}.{name}"), FOUND, CUTS, parts)
    };
    let mut all: Vec<_> =
        KINDS.into_iter().flat_map(|kind| ORDERS.map(|order| of(kind, order))).collect();
    let requests = || requests().into_iter().map(Part::Packet).collect();
    all.push(
        Scenario::new("mixed.requests".to_owned(), FOUND, CUTS, requests).cut_everywhere(true),
    );
    all
}

fn with_id(mut packet: Packet, new: u8) -> Packet {
    if let Packet::Instruction { id, .. } | Packet::Status { id, .. } = &mut packet {
        *id = new;
    }
    packet
}

/// Data without any part of the pattern.
fn plain(size: usize) -> Vec<u8> {
    (0..size).map(|at| u8::try_from(at % 251).unwrap_or_default()).collect()
}

/// A request of each kind.
fn requests() -> Vec<Packet> {
    let cases: [(u8, u8, &[u8]); 12] = [
        (1, 0x01, &[]),
        (1, 0x02, &[0x84, 0, 4, 0]),
        (1, 0x03, &[0x74, 0, 1, 2, 3, 4]),
        (2, 0x04, &[0x74, 0, 1, 2, 3, 4]),
        (BROADCAST, 0x05, &[]),
        (3, 0x08, &[]),
        (BROADCAST, 0x82, &[0x84, 0, 4, 0, 1, 2, 3]),
        (BROADCAST, 0x83, &[0x74, 0, 1, 0, 1, 7, 2, 8]),
        (BROADCAST, 0x8A, &[0x84, 0, 4, 0, 1, 2, 3]),
        (BROADCAST, 0x8B, &[0x74, 0, 1, 0, 1, 7, 2, 8]),
        (BROADCAST, 0x92, &[1, 0x84, 0, 4, 0, 2, 0x7E, 0, 2, 0]),
        (BROADCAST, 0x93, &[1, 0x74, 0, 1, 0, 7, 2, 0x66, 0, 2, 0, 8, 9]),
    ];
    let packet = |(id, instruction, params): (u8, u8, &[u8])| Packet::Instruction {
        id,
        instruction,
        params: params.to_vec().into(),
    };
    cases.map(packet).into()
}

/// A long packet between two short ones, up to the longest that the subject takes.
pub(super) fn long(longest: Option<usize>) -> Vec<Scenario> {
    const CUTS: &[Cut] = &[Cut::ByPart, Cut::Every(64), Cut::Every(1000)];
    let of = |kind: Kind, size: usize, stuffed: bool| {
        let word = if stuffed { "stuffed" } else { "plain" };
        Scenario::new(format!("long.{kind}.{word}.{size}"), FOUND, CUTS, move || {
            let long = if stuffed { stuffed_of(kind, size) } else { plain_of(kind, size) };
            [kind.numbered(1), long, kind.numbered(2)].map(Part::Packet).into()
        })
    };
    let each =
        |size| KINDS.into_iter().flat_map(move |kind| [false, true].map(|it| of(kind, size, it)));
    frame_sizes(longest).into_iter().flat_map(each).collect()
}

/// The sizes of [`FRAMES`], every power of two, and the two sizes up to the stated limit.
fn frame_sizes(longest: Option<usize>) -> Vec<usize> {
    let Some(limit) = longest.map(|limit| limit.min(LARGEST)) else { return FRAMES.into() };
    let powers = (9..16).map(|exponent| 1 << exponent);
    let around = [limit.saturating_sub(1), limit];
    let mut sizes: Vec<_> = FRAMES.into_iter().chain(powers).chain(around).collect();
    sizes.retain(|size| (32..=limit).contains(size));
    sizes.sort_unstable();
    sizes.dedup();
    sizes
}

/// Bytes of such a packet apart from its data.
fn around(kind: Kind) -> usize {
    super::frame(&kind.packet(&[])).len()
}

/// A packet of this size.
fn plain_of(kind: Kind, size: usize) -> Packet {
    kind.packet(&plain(size.saturating_sub(around(kind))))
}

/// A packet of this size that is made of nothing but patterns, as far as these fit.
fn stuffed_of(kind: Kind, size: usize) -> Packet {
    // Three bytes of data become four.
    let room = size.saturating_sub(around(kind));
    let patterns = [0xFF, 0xFF, 0xFD].repeat(room / 4);
    kind.packet(&[patterns, plain(room % 4)].concat())
}
