//! Probes of DYNAMIXEL Protocol 2.0, with the reference model's answers.

mod exists;
mod host;
mod packets;
mod requests;
mod smaller;
mod writes;

use actucheck_spec::Spec;
use actucheck_spec::model::Fault;
use actucheck_spec::wire::dynamixel2::reference::{self, BROADCAST, PATTERN, PREFIX};
use actucheck_spec::wire::dynamixel2::{Packet, WIRE};
use actucheck_spec::wire::{self, Direction};
use proptest::prelude::Strategy;

use self::exists::{exists, is_device, row};
use super::{Asked, Probes};
use crate::adapter::{Output, Question};
use crate::blackbox::probe::{Damage, Part, Probe, cut, damaged, joined};
use crate::suite::Author;
use crate::suite::check::Demand;
use crate::suite::codec::dynamixel2::parameters_of;

pub(super) const PROBES: Probes = Probes {
    wire: WIRE,
    packet: |_, limits| packets::packet(limits).prop_map_into().boxed(),
    streamed: |_, limits, direction| packets::streamed(limits, direction).prop_map_into().boxed(),
    noise: packets::noise,
    name,
    smaller: |packet| {
        let smaller = own(packet).map(smaller::packets).unwrap_or_default();
        smaller.into_iter().map(Into::into).collect()
    },
    limit: LIMIT,
    question,
    host: Some(host::PROBES),
    requests: Some(requests::requests),
};

/// The requirement on packets that are too long.
const LIMIT: &str = "dynamixel2.packet.length.limit";

fn own(packet: &wire::Packet) -> Option<&Packet> {
    let wire::Packet::Dynamixel2(packet) = packet else { return None };
    Some(packet)
}

fn name(spec: &Spec, packet: &wire::Packet) -> String {
    match own(packet) {
        Some(Packet::Instruction { instruction, .. }) => {
            let row = row(spec, *instruction);
            row.map_or_else(|| format!("instruction {instruction:#04X}"), |row| row.name.clone())
        }
        Some(Packet::FastStatus { .. }) => "fast status".to_owned(),
        _ => "status".to_owned(),
    }
}

fn question(author: &Author<'_>, probe: &Probe) -> Option<Asked> {
    let wire = WIRE;
    match probe {
        Probe::Crc(message) => {
            let crc = Output::Crc(reference::crc(message).into());
            let op = Question::Crc { wire, bytes: message.clone().into() };
            Some(("dynamixel2.crc.value".to_owned(), op, Demand::Yield(crc)))
        }
        Probe::Stuff(body) => {
            let stuffed = Output::Bytes(reference::stuff(body).into());
            let op = Question::Stuff { wire, bytes: body.clone().into() };
            Some(("dynamixel2.stuffing.transmit".to_owned(), op, Demand::Yield(stuffed)))
        }
        Probe::Unstuff(body) => {
            let op = Question::Unstuff { wire, bytes: reference::stuff(body).into() };
            let body = Output::Bytes(body.clone().into());
            Some(("dynamixel2.stuffing.receive".to_owned(), op, Demand::Yield(body)))
        }
        Probe::Encode(packet) => encode(author, packet),
        Probe::Decode(packet, damage) => decode(author, packet, damage),
        Probe::Stream(parts, cuts) => stream(author, parts, cuts),
        Probe::Converse(talk) => host::question(author.spec, talk),
        // What a device must answer is a matter of its checks.
        Probe::Ask(_) => None,
    }
}

fn encode(author: &Author<'_>, packet: &wire::Packet) -> Option<Asked> {
    // Stuffing begins with the instruction, also where no document has the instruction.
    let patterned = |packet: &Packet| match packet {
        Packet::Instruction { id: 1, instruction, params } => {
            [&[*instruction], params.0.as_slice()].concat().starts_with(&PATTERN)
        }
        _ => false,
    };
    let sent = own(packet)?;
    let op = Question::Encode { wire: WIRE, packet: packet.clone().into() };
    if let Packet::Instruction { id, .. } | Packet::Status { id, .. } = sent
        && *id != BROADCAST
        && !is_device(*id)
    {
        let requirement = "dynamixel2.packet.id.range".to_owned();
        return Some((requirement, op, Demand::Reject(Fault::Id)));
    }
    if !exists(author.spec, sent) && !patterned(sent) {
        return None;
    }
    let Some(frame) = WIRE.encode(packet) else {
        return Some((LIMIT.to_owned(), op, Demand::Reject(Fault::Oversize)));
    };
    let requirement = match sent {
        _ if is_stuffed(sent, &frame) => "dynamixel2.stuffing.transmit".to_owned(),
        Packet::Instruction { instruction, .. } => {
            let row = row(author.spec, *instruction);
            parameters_of(author.spec, row.map_or("", |row| &row.name))
        }
        Packet::Status { .. } | Packet::FastStatus { .. } => layout(sent).to_owned(),
    };
    Some((requirement, op, Demand::Yield(Output::Bytes(frame.into()))))
}

/// The requirement on the layout of a packet that is read, or of a status packet that is sent.
fn layout(packet: &Packet) -> &'static str {
    match packet {
        Packet::Instruction { .. } => "dynamixel2.packet.layout",
        Packet::Status { .. } => "dynamixel2.status-packet.layout",
        Packet::FastStatus { blocks } if blocks.iter().all(|block| block.data.is_empty()) => {
            "ja40.fast-sync-write.length"
        }
        Packet::FastStatus { .. } => "ja40.fast-sync-read.length",
    }
}

fn decode(author: &Author<'_>, packet: &wire::Packet, damage: &[Damage]) -> Option<Asked> {
    let (frame, context) = damaged(packet, damage)?;
    // A library that only reads streams finds a whole packet inside.
    let inside = |frame: &[u8]| !reference::packets(frame).is_empty();
    let (requirement, demand) = match WIRE.decode(&frame, &context) {
        _ if WIRE.is_unspecified(&frame, &context) => return None,
        Ok(found) => {
            let own = own(&found)?;
            if Some(found.direction()) != context.direction || !exists(author.spec, own) {
                return None;
            }
            let stuffed = is_stuffed(own, &frame);
            let requirement = if stuffed { "dynamixel2.stuffing.receive" } else { layout(own) };
            (requirement, Demand::Yield(Output::Packet(found)))
        }
        // Another packet than a fast status packet.
        Err(Fault::Id | Fault::Instruction)
            if context.fast.is_some() && frame.get(4) != Some(&BROADCAST) =>
        {
            return None;
        }
        Err(_) if context.fast.is_none() && inside(&frame) => return None,
        Err(fault) => {
            let requirement = match (fault, &context.fast) {
                (Fault::Id, Some(fast)) if fast.length == 0 => "ja40.fast-sync-write.order",
                (Fault::Id, Some(_)) => "ja40.fast-sync-read.order",
                _ => broken(fault),
            };
            (requirement, Demand::Reject(fault))
        }
    };
    let op = Question::Decode { wire: WIRE, bytes: frame.into(), context };
    Some((requirement.to_owned(), op, demand))
}

/// The requirement on a receiver that a faulty frame breaks.
const fn broken(fault: Fault) -> &'static str {
    match fault {
        Fault::Header => "dynamixel2.receive.header",
        Fault::Crc => "dynamixel2.receive.crc",
        Fault::Id => "dynamixel2.receive.id",
        _ => "dynamixel2.receive.length",
    }
}

fn stream(author: &Author<'_>, parts: &[Part], cuts: &[u16]) -> Option<Asked> {
    let direction = parts.first()?.packet.direction();
    let stream = joined(parts)?;
    let packets = reference::packets(&stream);
    if !packets.iter().all(|packet| exists(author.spec, packet))
        || reference::holds_unspecified(&stream)
    {
        return None;
    }
    // A host need not read instruction packets, such as its own echo, nor a device status packets.
    let is_own = |packet: &Packet| match packet {
        Packet::Instruction { .. } => direction == Direction::Request,
        _ => direction == Direction::Reply,
    };
    let own: Vec<_> = packets.iter().filter(|packet| is_own(packet)).cloned().collect();
    let found = if own.len() == packets.len() {
        Demand::Yield(Output::packets(packets))
    } else {
        Demand::YieldOneOf(vec![Output::packets(own), Output::packets(packets)])
    };
    let requirement = if reference::is_certain(&stream) {
        "dynamixel2.receive.stream"
    } else if reference::lacks_bytes(&stream) {
        // A receiver that trusts a bad length may still wait for the rest.
        return None;
    } else {
        "dynamixel2.receive.resume"
    };
    let op =
        Question::Stream { wire: WIRE, chunks: cut(&stream, cuts), direction: Some(direction) };
    Some((requirement.to_owned(), op, found))
}

/// Whether the frame is longer than its fields require.
fn is_stuffed(packet: &Packet, frame: &[u8]) -> bool {
    let fields = match packet {
        Packet::Instruction { params, .. } => params.len() + 1,
        Packet::Status { params, .. } => params.len() + 2,
        Packet::FastStatus { .. } => return false,
    };
    frame.len() > PREFIX + fields + 2
}
