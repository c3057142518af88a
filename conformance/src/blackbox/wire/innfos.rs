//! Probes of the INNFOS Ethernet protocol, with the reference model's answers.

use actucheck_spec::model::Fault;
use actucheck_spec::wire::innfos::{self, WIRE, reference};
use actucheck_spec::wire::{Direction, Packet};
use proptest::prelude::{BoxedStrategy, Strategy, any};

use super::{Asked, Probes};
use crate::adapter::{Output, Question};
use crate::blackbox::probe::{LONGEST, Named, Probe, damaged};
use crate::suite::Author;
use crate::suite::check::Demand;
use crate::suite::random::data;

pub(super) const PROBES: Probes = Probes { wire: WIRE, packet, streamed, question };

fn packet() -> BoxedStrategy<Named> {
    (any::<bool>(), any::<u8>(), any::<u8>(), data(0..LONGEST))
        .prop_map(|(request, address, command, data)| {
            let (name, direction) =
                if request { ("request", Direction::Request) } else { ("reply", Direction::Reply) };
            let data = data.into();
            (name, innfos::Packet { direction, address, command, data }.into())
        })
        .boxed()
}

fn streamed() -> BoxedStrategy<Packet> {
    packet().prop_map(|(_, packet)| packet).boxed()
}

fn question(_author: &Author<'_>, probe: &Probe) -> Option<Asked> {
    let wire = WIRE;
    let (requirement, op, demand) = match probe {
        Probe::Crc(message) if !message.is_empty() => {
            let numbers = wire.checksum(message).into_iter().map(Output::Crc).collect();
            let op = Question::Crc { wire, bytes: message.clone().into() };
            ("innfos.crc.value", op, Demand::YieldOneOf(numbers))
        }
        Probe::Encode((_, packet)) if !is_unspecified(packet) => {
            let frame = wire.encode(packet)?;
            let op = Question::Encode { wire, packet: packet.clone().into() };
            ("innfos.frame.layout", op, Demand::Yield(Output::Bytes(frame.into())))
        }
        Probe::Decode((_, packet), damage) => {
            let context = packet.context();
            let frame = damaged(wire, wire.encode(packet)?, damage);
            let (requirement, demand) = match wire.decode(&frame, &context) {
                _ if wire.is_unspecified(&frame, &context) => return None,
                Ok(packet) => ("innfos.frame.layout", Demand::Yield(Output::Packet(packet))),
                Err(Fault::Header) => ("innfos.frame.header", Demand::Reject(Fault::Header)),
                Err(Fault::Tail) => ("innfos.frame.tail", Demand::Reject(Fault::Tail)),
                Err(Fault::Crc) => ("innfos.crc.verify", Demand::Reject(Fault::Crc)),
                Err(fault) => ("innfos.frame.length", Demand::Reject(fault)),
            };
            (requirement, Question::Decode { wire, bytes: frame.into(), context }, demand)
        }
        // One datagram of valid frames in one direction. What a receiver does after a damaged frame
        // is unspecified.
        Probe::Stream(parts, _) => {
            let direction = parts.first()?.1.direction();
            let packets = parts.iter().map(|(_, packet, _)| packet);
            let packets: Vec<_> = packets
                .filter(|packet| packet.direction() == direction && !is_unspecified(packet))
                .cloned()
                .collect();
            let frames: Option<Vec<_>> = packets.iter().map(|packet| wire.encode(packet)).collect();
            let chunks = vec![frames?.concat().into()];
            let op = Question::Stream { wire, chunks, direction: Some(direction) };
            ("innfos.frame.transparent", op, Demand::Yield(Output::Packets(packets)))
        }
        _ => return None,
    };
    Some((requirement.to_owned(), op, demand))
}

fn is_unspecified(packet: &Packet) -> bool {
    matches!(packet, Packet::Innfos(packet) if reference::is_unspecified(packet))
}
