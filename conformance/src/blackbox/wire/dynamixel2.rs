//! Probes of DYNAMIXEL Protocol 2.0, with the reference model's answers.

use actucheck_spec::model::Fault;
use actucheck_spec::wire::dynamixel2::reference::{self, HEADER, PREFIX};
use actucheck_spec::wire::dynamixel2::{Packet, WIRE};
use actucheck_spec::wire::{self, Context, Direction};
use proptest::prelude::{BoxedStrategy, Just, Strategy, any};
use proptest::prop_oneof;

use super::{Asked, Probes};
use crate::adapter::{Output, Question};
use crate::blackbox::probe::{LONGEST, Named, Probe, cut, damaged, joined};
use crate::suite::Author;
use crate::suite::check::Demand;
use crate::suite::codec::dynamixel2::generated::{instruction, status};
use crate::suite::codec::dynamixel2::parameters_of;
use crate::suite::random::data;

pub(super) const PROBES: Probes = Probes { wire: WIRE, packet, streamed, question };

fn packet() -> BoxedStrategy<Named> {
    prop_oneof![
        8 => status().prop_map(|packet| ("status", packet.into())),
        8 => instruction().prop_map(|(name, packet)| (name, packet.into())),
        1 => any_instruction(),
        1 => long_status(),
    ]
    .boxed()
}

/// Any code, with parameters that may not fit it.
fn any_instruction() -> impl Strategy<Value = Named> {
    let code = prop_oneof![Just(0xFF_u8), any::<u8>()]
        .prop_map(|code| if code == reference::STATUS { 0 } else { code });
    (code, data(0..LONGEST)).prop_map(|(instruction, params)| {
        let params = params.into();
        ("", Packet::Instruction { id: 1, instruction, params }.into())
    })
}

/// A packet whose length needs both bytes.
fn long_status() -> impl Strategy<Value = Named> {
    data(240..600).prop_map(|params| {
        let params = params.into();
        ("status", Packet::Status { id: 1, error: 0, params }.into())
    })
}

fn streamed() -> BoxedStrategy<wire::Packet> {
    status().prop_map(Into::into).boxed()
}

fn question(author: &Author<'_>, probe: &Probe) -> Option<Asked> {
    let wire = WIRE;
    let bytes = |bytes: &[u8]| bytes.to_vec().into();
    let (requirement, op, demand) = match probe {
        Probe::Crc(message) => {
            let crc = Output::Crc(reference::crc(message).into());
            let op = Question::Crc { wire, bytes: bytes(message) };
            ("dynamixel2.crc.value".to_owned(), op, Demand::Yield(crc))
        }
        Probe::Stuff(body) => {
            let stuffed = Output::Bytes(reference::stuff(body).into());
            let op = Question::Stuff { wire, bytes: bytes(body) };
            ("dynamixel2.stuffing.transmit".to_owned(), op, Demand::Yield(stuffed))
        }
        Probe::Unstuff(body) => {
            let op = Question::Unstuff { wire, bytes: reference::stuff(body).into() };
            let body = Output::Bytes(bytes(body));
            ("dynamixel2.stuffing.receive".to_owned(), op, Demand::Yield(body))
        }
        Probe::Encode((name, packet)) => {
            let frame = wire.encode(packet)?;
            let requirement = match name {
                _ if is_stuffed(packet, &frame) => "dynamixel2.stuffing.transmit".to_owned(),
                &"status" => "dynamixel2.status-packet.layout".to_owned(),
                name => parameters_of(author.spec, name),
            };
            let op = Question::Encode { wire, packet: packet.clone().into() };
            (requirement, op, Demand::Yield(Output::Bytes(frame.into())))
        }
        Probe::Decode((_, packet), damage) => {
            let frame = damaged(wire, wire.encode(packet)?, damage);
            let (requirement, demand) = match wire.decode(&frame, &Context::default()) {
                _ if reference::is_unspecified(&frame) => return None,
                // A library that only reads streams finds the whole packet inside.
                Err(_) if !reference::packets(&frame).is_empty() => return None,
                Ok(packet) => {
                    let stuffed = is_stuffed(&packet, &frame);
                    let id = if stuffed { "stuffing.receive" } else { "packet.layout" };
                    (id, Demand::Yield(Output::Packet(packet)))
                }
                Err(Fault::Header) => ("receive.header", Demand::Reject(Fault::Header)),
                Err(Fault::Id) => ("receive.id", Demand::Reject(Fault::Id)),
                Err(Fault::Crc) => ("receive.crc", Demand::Reject(Fault::Crc)),
                Err(fault) => ("receive.length", Demand::Reject(fault)),
            };
            let context = Context::from(packet.direction());
            let op = Question::Decode { wire, bytes: frame.into(), context };
            (format!("dynamixel2.{requirement}"), op, demand)
        }
        Probe::Stream(parts, cuts) => {
            let stream = joined(wire, parts)?;
            let packets = reference::packets(&stream);
            // Where a search continues after a bad length is unspecified, and a host need not read
            // instruction packets.
            if !reference::is_certain(&stream)
                || !packets.iter().all(|packet| matches!(packet, Packet::Status { .. }))
                || holds_unspecified(&stream)
            {
                return None;
            }
            let chunks = cut(&stream, cuts);
            let op = Question::Stream { wire, chunks, direction: Some(Direction::Reply) };
            let found = Demand::Yield(Output::packets(packets));
            ("dynamixel2.receive.stream".to_owned(), op, found)
        }
    };
    Some((requirement, op, demand))
}

/// Whether the frame is longer than its fields require.
fn is_stuffed(packet: &wire::Packet, frame: &[u8]) -> bool {
    let fields = match packet {
        wire::Packet::Dynamixel2(Packet::Instruction { params, .. }) => params.len() + 1,
        wire::Packet::Dynamixel2(Packet::Status { params, .. }) => params.len() + 2,
        _ => return false,
    };
    frame.len() > PREFIX + fields + 2
}

/// Whether the stream has something that is a packet or not depending on an unspecified rule.
fn holds_unspecified(stream: &[u8]) -> bool {
    (0..stream.len()).any(|from| {
        let rest = stream.get(from..).unwrap_or_default();
        let [_, _, _, _, _, low, high, ..] = *rest else { return false };
        let size = PREFIX + usize::from(u16::from_le_bytes([low, high]));
        let frame = rest.get(..size).unwrap_or_default();
        rest.starts_with(&HEADER) && reference::is_unspecified(frame)
    })
}
