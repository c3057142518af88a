//! The basic checks of the INNFOS Ethernet protocol: the smallest packet for each sentence.
//!
//! Requests and replies have checks of their own, as a library may do with only one of the two.

use std::sync::LazyLock;

use actucheck_spec::model::Fault;
use actucheck_spec::wire::innfos::reference::{self, TAIL};
use actucheck_spec::wire::innfos::{Packet, WIRE};
use actucheck_spec::wire::{self, Direction};

use super::{BEHIND, LENGTH};
use crate::adapter::{Output, Question};
use crate::suite::basics::{Basic, Basics, Wrong};
use crate::suite::changed;
use crate::suite::check::Demand;

/// All of them, the most basic first.
pub(in crate::suite::codec) fn all() -> &'static [Basic] {
    static ALL: LazyLock<Vec<Basic>> = LazyLock::new(write);
    &ALL
}

fn write() -> Vec<Basic> {
    let mut basics = Basics::of(WIRE);
    crc(&mut basics);
    for direction in [Direction::Request, Direction::Reply] {
        plain(&mut basics, direction);
        wrong(&mut basics, direction);
        for row in rows(direction) {
            both_ways(&mut basics, direction, &row);
        }
    }
    basics.finish()
}

fn crc(basics: &mut Basics) {
    let question = Question::Crc { wire: WIRE, bytes: vec![0x01].into() };
    let numbers = WIRE.checksum(&[0x01]).into_iter().map(Output::Crc).collect();
    let demand = Demand::YieldOneOf(numbers);
    basics.add(("one-byte", "crc"), "innfos.crc.value", question, demand, |about| {
        matches!(about.question, Question::Crc { .. })
            || about.packets.iter().any(|packet| has_crc(packet))
    });
}

fn has_crc(packet: &wire::Packet) -> bool {
    let wire::Packet::Innfos(packet) = packet else { return false };
    packet.data.len() > usize::from(packet.direction == Direction::Reply)
}

/// A packet with this data: a protection temperature that is set, or a temperature that is read.
fn packet(direction: Direction, data: &[u8]) -> Packet {
    let command = if direction == Direction::Request { 0x61 } else { 0x5F };
    Packet { direction, address: 6, command, data: data.to_vec().into() }
}

/// Data whose CRC has two equal bytes.
const EVEN: [u8; 2] = [0x03, 0x03];

/// What everything rests on: a packet built, read and received, and its byte order.
fn plain(basics: &mut Basics, direction: Direction) {
    let name = |what: &str| format!("{what}.{direction}");
    let has = move |packet: &wire::Packet| WIRE.direction(packet) == direction;
    let layout = "innfos.frame.layout";
    let (even, odd) = (packet(direction, &EVEN).into(), packet(direction, &[0x12, 0x34]).into());
    let plain = name("plain");
    basics.built(&plain, layout, &odd, frames(&odd, May::LengthAndCrc), has);
    basics.read(&plain, layout, &even, has);
    basics.streamed(&plain, layout, &even, has);
    let frame = WIRE.encode(&even).unwrap_or_default();
    let datagrams = vec![frame.clone(), frame];
    basics.found((&plain, "two-datagrams"), layout, direction, datagrams, move |about| {
        about.chunks().len() > 1 && about.packets.iter().any(|packet| has(packet))
    });
    basics.built(&name("length"), "innfos.frame.length", &odd, frames(&odd, May::Crc), has);
    let has = move |packet: &wire::Packet| has(packet) && has_crc(packet);
    let value = frames(&odd, May::CrcOrder);
    basics.built(&name("crc-value"), "innfos.crc.value", &odd, value, has);
    let right = WIRE.encode(&odd).unwrap_or_default();
    basics.built(&name("crc-order"), "innfos.crc.byte-order", &odd, vec![right], has);
    basics.read(&name("crc-order"), "innfos.crc.byte-order", &odd, has);
}

/// What may be wrong in a frame: a check of one sentence does not depend on the later ones.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum May {
    CrcOrder,
    Crc,
    LengthAndCrc,
}

/// The frames of a packet, the right one first. The length may be in the other byte order or count
/// the CRC; the CRC may be in the other byte order or that of everything before it.
fn frames(packet: &wire::Packet, may: May) -> Vec<Vec<u8>> {
    let right = WIRE.encode(packet).unwrap_or_default();
    let (before, behind) = right.split_at(right.len().saturating_sub(BEHIND));
    let [crc_first, crc_second, tail] = *behind else { return Vec::new() };
    let mut lengths = vec![before.to_vec()];
    if may >= May::LengthAndCrc {
        let mut turned = before.to_vec();
        turned.swap(LENGTH, LENGTH + 1);
        let with_crc = changed(before, LENGTH + 1, |low| low + 2);
        lengths.extend([turned, with_crc]);
    }
    let frames = lengths.into_iter().flat_map(|before| {
        let of_all = reference::crc(&before);
        let mut crcs = vec![[crc_first, crc_second], [crc_second, crc_first]];
        if may >= May::Crc {
            crcs.extend([of_all.to_le_bytes(), of_all.to_be_bytes()]);
        }
        let frame = move |[first, second]: [u8; 2]| [&before[..], &[first, second, tail]].concat();
        crcs.into_iter().map(frame)
    });
    frames.collect()
}

/// What is no frame, by each rule.
fn wrong(basics: &mut Basics, direction: Direction) {
    let frame = reference::encode(&packet(direction, &EVEN)).unwrap_or_default();
    let without =
        |bytes: usize| frame.get(..frame.len().saturating_sub(bytes)).unwrap_or_default().to_vec();
    let last = frame.len().saturating_sub(1);
    let replaced = |at: usize, value: u8| changed(&frame, at, |_| value);
    // Of bytes that are cut off, whether only the end is missing.
    let cases: [Wrong; 5] = [
        ("wrong-header", "innfos.frame.header", replaced(0, 0xEF), Fault::Header, None),
        ("wrong-crc", "innfos.crc.verify", replaced(last - 1, 0x40), Fault::Crc, None),
        ("wrong-end", "innfos.frame.tail", replaced(last, 0xEE), Fault::Tail, None),
        ("without-end", "innfos.frame.tail", without(1), Fault::Truncated, Some(true)),
        ("cut-short", "innfos.frame.length", without(2), Fault::Truncated, Some(false)),
    ];
    for (what, requirement, bytes, fault, lacks_end) in cases {
        let name = format!("{what}.{direction}");
        basics.rejected((&name, fault), requirement, direction, bytes, move |about| {
            let Question::Decode { bytes, context, .. } = about.question else { return false };
            let ended = [bytes.0.as_slice(), &[TAIL]].concat();
            let would_end = reference::decode(direction, &ended).is_ok();
            context.direction == Some(direction)
                && about.fault == Some(fault)
                && lacks_end.is_none_or(|lacks_end| lacks_end == would_end)
        });
    }
}

/// A packet, and which packets go wrong with it.
struct Row {
    what: &'static str,
    requirement: &'static str,
    packet: Packet,
    has: fn(&Packet) -> bool,
}

fn rows(direction: Direction) -> Vec<Row> {
    let row = |what, requirement, packet, has| Row { what, requirement, packet, has };
    let of = |address, command, data: &[u8]| Packet {
        direction,
        address,
        command,
        data: data.to_vec().into(),
    };
    let one_byte = |requirement| {
        row("one-byte", requirement, of(6, 0x2A, &[0x01]), |packet| packet.data.len() == 1)
    };
    let own = match direction {
        Direction::Request => vec![
            row("no-data", "innfos.frame.no-data", of(6, 0x06, &[]), |packet| {
                packet.data.is_empty()
            }),
            one_byte("innfos.crc.request"),
        ],
        Direction::Reply => vec![one_byte("innfos.crc.reply")],
    };
    let transparent = "innfos.frame.transparent";
    let both = [
        row(
            "address-ff",
            "innfos.frame.address",
            Packet { address: 0xFF, ..packet(direction, &EVEN) },
            |packet| packet.address > 127,
        ),
        row("end-inside", transparent, packet(direction, &[0xED, 0x01]), |packet| {
            inside(packet, 0xED)
        }),
        row("header-inside", transparent, packet(direction, &[0xEE, 0x01]), |packet| {
            inside(packet, 0xEE)
        }),
    ];
    own.into_iter().chain(both).collect()
}

/// Whether a frame has this byte between its first and its last.
fn inside(packet: &Packet, byte: u8) -> bool {
    let frame = reference::encode(packet).unwrap_or_default();
    let end = frame.len().saturating_sub(1);
    frame.get(1..end).unwrap_or_default().contains(&byte)
}

/// A packet built, read alone, and received in a datagram.
fn both_ways(basics: &mut Basics, direction: Direction, row: &Row) {
    let (name, requirement, has) = (format!("{}.{direction}", row.what), row.requirement, row.has);
    let has = move |packet: &wire::Packet| {
        let wire::Packet::Innfos(packet) = packet else { return false };
        packet.direction == direction && has(packet)
    };
    let packet = row.packet.clone().into();
    let frame = WIRE.encode(&packet).unwrap_or_default();
    basics.built(&name, requirement, &packet, vec![frame], has);
    basics.read(&name, requirement, &packet, has);
    basics.streamed(&name, requirement, &packet, has);
}
