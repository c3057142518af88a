//! Probes of the INNFOS Ethernet protocol, with the reference model's answers.

mod host;
mod requests;

use actucheck_spec::Spec;
use actucheck_spec::model::Fault;
use actucheck_spec::wire::innfos::{self, WIRE, reference};
use actucheck_spec::wire::{Direction, Packet};
use proptest::collection::vec;
use proptest::prelude::{BoxedStrategy, Just, Strategy, any};
use proptest::prop_oneof;
use proptest::sample::select;

use super::{Asked, Probes};
use crate::adapter::{Output, Question};
use crate::blackbox::probe::{Damage, Part, Probe, damaged};
use crate::suite::Author;
use crate::suite::check::Demand;

pub(super) const PROBES: Probes = Probes {
    wire: WIRE,
    packet: |spec, _| {
        prop_oneof![packet(spec, Direction::Request), packet(spec, Direction::Reply)].boxed()
    },
    streamed: |spec, _, direction| packet(spec, direction),
    noise: || Just(Vec::new()).boxed(),
    name,
    smaller,
    limit: "innfos.frame.length",
    question,
    host: Some(host::PROBES),
    requests: Some(requests::requests),
};

/// Bytes that could be taken for the first or the last one of a frame, flags, modes, and others.
fn byte() -> impl Strategy<Value = u8> {
    prop_oneof![
        3 => 0..=1_u8,
        1 => 0..12_u8,
        2 => Just(0xEE),
        2 => Just(0xED),
        1 => Just(0xFF),
        3 => any::<u8>(),
    ]
}

/// A packet of any command, with as much data as the command's row says.
fn packet(spec: &Spec, direction: Direction) -> BoxedStrategy<Packet> {
    let rows = spec.wires.innfos.content.commands.iter();
    let sizes: Vec<_> =
        rows.filter_map(|row| Some((row.code, usize::from(row.size_in(direction)?)))).collect();
    (byte(), select(sizes))
        .prop_flat_map(move |(address, (command, size))| {
            vec(byte(), size).prop_map(move |data| {
                innfos::Packet { direction, address, command, data: data.into() }.into()
            })
        })
        .boxed()
}

fn own(packet: &Packet) -> Option<&innfos::Packet> {
    let Packet::Innfos(packet) = packet else { return None };
    Some(packet)
}

fn name(_spec: &Spec, packet: &Packet) -> String {
    let command = own(packet).map_or(0, |packet| packet.command);
    format!("{} {command:#04X}", packet.direction())
}

/// The size of the data is the command's own.
fn smaller(packet: &Packet) -> Vec<Packet> {
    let Some(packet) = own(packet) else { return Vec::new() };
    let zeros = (0..packet.data.len()).map(|place| {
        let mut data = packet.data.clone();
        data.0.iter_mut().skip(place).take(1).for_each(|byte| *byte = 0);
        innfos::Packet { data, ..packet.clone() }
    });
    let first = innfos::Packet { address: 1, ..packet.clone() };
    let smaller = zeros.chain((packet.address > 1).then_some(first));
    smaller.filter(|smaller| smaller != packet).map(Into::into).collect()
}

/// Whether the document has such a packet, and one frame for it.
fn exists(spec: &Spec, packet: &innfos::Packet) -> bool {
    reference::is_in_tables(&spec.wires.innfos.content, packet)
}

fn question(author: &Author<'_>, probe: &Probe) -> Option<Asked> {
    let (requirement, op, demand) = match probe {
        Probe::Crc(message) if !message.is_empty() => {
            let numbers = WIRE.checksum(message).into_iter().map(Output::Crc).collect();
            let op = Question::Crc { wire: WIRE, bytes: message.clone().into() };
            ("innfos.crc.value", op, Demand::YieldOneOf(numbers))
        }
        Probe::Encode(packet) if exists(author.spec, own(packet)?) => {
            let frame = WIRE.encode(packet)?;
            let op = Question::Encode { wire: WIRE, packet: packet.clone().into() };
            ("innfos.frame.layout", op, Demand::Yield(Output::Bytes(frame.into())))
        }
        Probe::Decode(packet, damage) => return decode(author, packet, damage),
        Probe::Stream(parts, _) => return stream(author, parts),
        Probe::Converse(talk) => return host::question(author.spec, talk),
        _ => return None,
    };
    Some((requirement.to_owned(), op, demand))
}

fn decode(author: &Author<'_>, packet: &Packet, damage: &[Damage]) -> Option<Asked> {
    let (frame, context) = damaged(packet, damage)?;
    let (requirement, demand) = match WIRE.decode(&frame, &context) {
        _ if WIRE.is_unspecified(&frame, &context) => return None,
        Ok(found) if exists(author.spec, own(&found)?) => {
            ("innfos.frame.layout", Demand::Yield(Output::Packet(found)))
        }
        Ok(_) => return None,
        // A library that only reads datagrams may find the frame between other bytes.
        Err(_) if !reference::packets_anywhere(context.direction?, &frame).is_empty() => {
            return None;
        }
        Err(fault) => {
            let requirement = match fault {
                Fault::Header => "innfos.frame.header",
                Fault::Tail => "innfos.frame.tail",
                Fault::Crc => "innfos.crc.verify",
                _ => "innfos.frame.length",
            };
            (requirement, Demand::Reject(fault))
        }
    };
    let op = Question::Decode { wire: WIRE, bytes: frame.into(), context };
    Some((requirement.to_owned(), op, demand))
}

/// Datagrams of one valid frame each. What a receiver makes of others is unspecified.
fn stream(author: &Author<'_>, parts: &[Part]) -> Option<Asked> {
    let direction = parts.first()?.packet.direction();
    let packets: Vec<_> = parts.iter().map(|part| part.packet.clone()).collect();
    if !packets.iter().all(|packet| own(packet).is_some_and(|own| exists(author.spec, own))) {
        return None;
    }
    let frames = packets.iter().map(|packet| WIRE.encode(packet).map(Into::into));
    let chunks = frames.collect::<Option<Vec<_>>>()?;
    let op = Question::Stream { wire: WIRE, chunks, direction: Some(direction) };
    Some(("innfos.frame.layout".to_owned(), op, Demand::Yield(Output::Packets(packets))))
}
