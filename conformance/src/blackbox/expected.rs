//! Turns a probe into a check with the answer of the reference model. A probe whose right answer
//! the documents leave unspecified yields no check.

use actucheck_spec::model::{Fault, FrameKind, Packet};
use actucheck_spec::wire::dynamixel2::reference::{self, Call};
use actucheck_spec::wire::innfos::reference as innfos;

use super::probe::{Probe, cut, damaged, joined};
use crate::adapter::{Called, Output, Question, Wire};
use crate::suite::check::{Check, Demand};
use crate::suite::{Author, parameters_of};

impl Probe {
    /// The check of this probe; `None` if the documents leave the right answer unspecified.
    pub(super) fn check(&self, author: &Author<'_>, id: String) -> Option<Check> {
        let (requirement, op, demand) = match author.wire {
            Wire::Dynamixel2 => self.dynamixel2(author)?,
            Wire::Innfos => self.innfos()?,
        };
        Some(author.check(id, &requirement, op, demand))
    }

    fn dynamixel2(&self, author: &Author<'_>) -> Option<(String, Question, Demand)> {
        let wire = Wire::Dynamixel2;
        let bytes = |bytes: &[u8]| bytes.to_vec().into();
        let (requirement, op, demand) = match self {
            Self::Crc(message) => {
                let crc = Output::Crc(reference::crc(message).into());
                let op = Question::Crc { wire, bytes: bytes(message) };
                ("dynamixel2.crc.value".to_owned(), op, Demand::Yield(crc))
            }
            Self::Stuff(body) => {
                let stuffed = Output::Bytes(reference::stuff(body).into());
                let op = Question::Stuff { wire, bytes: bytes(body) };
                ("dynamixel2.stuffing.transmit".to_owned(), op, Demand::Yield(stuffed))
            }
            Self::Unstuff(body) => {
                let op = Question::Unstuff { wire, bytes: reference::stuff(body).into() };
                let body = Output::Bytes(bytes(body));
                ("dynamixel2.stuffing.receive".to_owned(), op, Demand::Yield(body))
            }
            Self::Encode((name, packet)) => {
                let frame = reference::encode(packet)?;
                let requirement = match name {
                    _ if is_stuffed(packet, &frame) => "dynamixel2.stuffing.transmit".to_owned(),
                    &"status" => "dynamixel2.status-packet.layout".to_owned(),
                    name => parameters_of(author.spec, name),
                };
                let packet = Called { call: Call::of(packet), packet: packet.clone() };
                let op = Question::Encode { wire, packet };
                (requirement, op, Demand::Yield(Output::Bytes(frame.into())))
            }
            Self::Decode((_, packet), damage) => {
                let frame = damaged(wire, reference::encode(packet)?, damage);
                let (requirement, demand) = match reference::decode(&frame) {
                    // Unspecified: a bare pattern, an ID that no device may have, and a status
                    // packet from the broadcast ID where no fast status packet is asked for.
                    Ok(Packet::Status { id: reference::BROADCAST, .. })
                    | Err(Fault::Stuffing | Fault::Id) => return None,
                    // A library that only reads streams finds the whole packet inside.
                    Err(_) if !reference::packets(&frame).is_empty() => return None,
                    Ok(packet) => {
                        let stuffed = is_stuffed(&packet, &frame);
                        let id = if stuffed { "stuffing.receive" } else { "packet.layout" };
                        (id, Demand::Yield(Output::Packet(packet)))
                    }
                    Err(Fault::Header) => ("receive.header", Demand::Reject(Fault::Header)),
                    Err(Fault::Crc) => ("receive.crc", Demand::Reject(Fault::Crc)),
                    Err(fault) => ("receive.length", Demand::Reject(fault)),
                };
                let op = Question::Decode { wire, bytes: frame.into(), fast: None, kind: None };
                (format!("dynamixel2.{requirement}"), op, demand)
            }
            Self::Stream(parts, cuts) => {
                let stream = joined(wire, parts)?;
                let packets = reference::packets(&stream);
                // Where a search continues after a bad length is unspecified, and a host need not
                // read instruction packets.
                if !reference::is_certain(&stream)
                    || !packets.iter().all(|packet| matches!(packet, Packet::Status { .. }))
                    || holds_open(&stream)
                {
                    return None;
                }
                let chunks = cut(&stream, cuts);
                let op = Question::Stream { wire, chunks, kind: None };
                let found = Demand::Yield(Output::Packets(packets));
                ("dynamixel2.receive.stream".to_owned(), op, found)
            }
        };
        Some((requirement, op, demand))
    }

    fn innfos(&self) -> Option<(String, Question, Demand)> {
        let wire = Wire::Innfos;
        let (requirement, op, demand) = match self {
            Self::Crc(message) if !message.is_empty() => {
                let crc = innfos::crc(message);
                let numbers = [crc, crc.swap_bytes()].map(|number| Output::Crc(number.into()));
                let op = Question::Crc { wire, bytes: message.clone().into() };
                ("innfos.crc.value", op, Demand::YieldOneOf(numbers.into()))
            }
            Self::Encode((_, packet)) if !is_open(packet) => {
                let frame = innfos::encode(packet)?;
                let op = Question::Encode {
                    wire,
                    packet: Called { packet: packet.clone(), call: None },
                };
                ("innfos.frame.layout", op, Demand::Yield(Output::Bytes(frame.into())))
            }
            Self::Decode((_, packet), damage) => {
                let kind = kind_of(packet);
                let frame = damaged(wire, innfos::encode(packet)?, damage);
                let (requirement, demand) = match innfos::decode(kind, &frame) {
                    Ok(packet) if is_open(&packet) => return None,
                    Ok(packet) => ("innfos.frame.layout", Demand::Yield(Output::Packet(packet))),
                    Err(Fault::Header) => ("innfos.frame.header", Demand::Reject(Fault::Header)),
                    Err(Fault::Tail) => ("innfos.frame.tail", Demand::Reject(Fault::Tail)),
                    Err(Fault::Crc) => ("innfos.crc.verify", Demand::Reject(Fault::Crc)),
                    Err(fault) => ("innfos.frame.length", Demand::Reject(fault)),
                };
                let op =
                    Question::Decode { wire, bytes: frame.into(), fast: None, kind: Some(kind) };
                (requirement, op, demand)
            }
            // One datagram of valid frames in one direction. What a receiver does after a damaged
            // frame is unspecified.
            Self::Stream(parts, _) => {
                let kind = kind_of(&parts.first()?.1);
                let same = parts.iter().map(|(_, packet, _)| packet);
                let packets: Vec<_> = same
                    .filter(|packet| kind_of(packet) == kind && !is_open(packet))
                    .cloned()
                    .collect();
                let frames: Option<Vec<_>> = packets.iter().map(innfos::encode).collect();
                let chunks = vec![frames?.concat().into()];
                let op = Question::Stream { wire, chunks, kind: Some(kind) };
                ("innfos.frame.transparent", op, Demand::Yield(Output::Packets(packets)))
            }
            _ => return None,
        };
        Some((requirement.to_owned(), op, demand))
    }
}

/// Whether the frame is longer than its fields require.
fn is_stuffed(packet: &Packet, frame: &[u8]) -> bool {
    let fields = match packet {
        Packet::Instruction { params, .. } => params.len() + 1,
        Packet::Status { params, .. } => params.len() + 2,
        _ => return false,
    };
    frame.len() > reference::PREFIX + fields + 2
}

/// Whether the stream has something that is a packet or not depending on an unspecified rule: an ID
/// that no device may have, a bare pattern, or a status packet from the broadcast ID.
fn holds_open(stream: &[u8]) -> bool {
    (0..stream.len()).any(|from| {
        let rest = stream.get(from..).unwrap_or_default();
        let [0xFF, 0xFF, 0xFD, 0x00, _, low, high, ..] = *rest else { return false };
        let size = reference::PREFIX + usize::from(u16::from_le_bytes([low, high]));
        let frame = rest.get(..size).unwrap_or_default();
        matches!(
            reference::decode(frame),
            Err(Fault::Stuffing | Fault::Id) | Ok(Packet::Status { id: reference::BROADCAST, .. })
        )
    })
}

/// The commands whose replies of one byte may or may not have a CRC.
fn is_open(packet: &Packet) -> bool {
    matches!(packet, Packet::Reply { command: 0x02 | 0x44, data, .. } if data.len() == 1)
}

fn kind_of(packet: &Packet) -> FrameKind {
    match packet {
        Packet::Reply { .. } => FrameKind::Reply,
        _ => FrameKind::Request,
    }
}
