//! A vector's bytes and fields say the same, and its kind of result has what it needs.

mod innfos;

use crate::load::File;
use crate::model::{ByteOrder, HexBytes, Innfos, Outcome, Packet, Protocol, Vector, VectorsFile};
use crate::{Diagnostic, Spec};

pub(super) fn check(spec: &Spec) -> Vec<Diagnostic> {
    let mut defects = Vec::new();
    for file in &spec.vectors {
        let Some(wire) = Wire::of(spec, &file.content.wire) else {
            continue;
        };
        for (index, vector) in file.content.vectors.iter().enumerate() {
            let node = format!("vectors[{index}]");
            let message =
                shape(vector).or_else(|| wire.shape(vector)).or_else(|| wire.contents(vector));
            if let Some(message) = message {
                defects.push(defect(file, &node, vector, &message));
            }
        }
    }
    defects
}

fn defect(file: &File<VectorsFile>, node: &str, vector: &Vector, message: &str) -> Diagnostic {
    file.diagnostic(node, format!("{}: {message}", vector.id))
}

/// Whether the fields that its result needs are there, and no others.
fn shape(vector: &Vector) -> Option<String> {
    let invalid = vector.result == Outcome::Invalid;
    let message = match (&vector.printed, &vector.bytes) {
        (None, None) => "neither `printed` nor `bytes`",
        (Some(printed), Some(bytes)) if printed == bytes => {
            "`bytes` repeats `printed`; leave it out"
        }
        (Some(_), Some(_)) if vector.errata.is_empty() => {
            "`bytes` corrects `printed`, so an erratum must say why"
        }
        (Some(_), Some(_)) if vector.printed_fault.is_none() => {
            "`bytes` corrects `printed`, so `printed_fault` must say what is wrong with it"
        }
        _ if invalid && vector.packet.is_some() => "an invalid frame means no packet",
        _ if invalid && vector.fault.is_none() => "an invalid frame needs its `fault`",
        _ if !invalid && vector.packet.is_none() => "the frame's `packet` is missing",
        _ if !invalid && vector.fault.is_some() => "a frame with a `fault` must be `invalid`",
        (_, Some(_)) if vector.note.is_none() => {
            "`bytes` are not the printed ones, so a `note` must say why the vector exists"
        }
        _ => return None,
    };
    Some(message.to_owned())
}

/// The rules by which packets become frames.
enum Wire<'a> {
    Dynamixel(&'a Protocol),
    Innfos(&'a Innfos),
}

impl<'a> Wire<'a> {
    fn of(spec: &'a Spec, id: &str) -> Option<Self> {
        let innfos = &spec.innfos.content;
        if innfos.protocol == id {
            Some(Self::Innfos(innfos))
        } else {
            spec.protocol(id).map(Self::Dynamixel)
        }
    }

    /// Whether a damaged frame says which way it goes, where no frame tells so itself.
    fn shape(&self, vector: &Vector) -> Option<String> {
        let needed = matches!(self, Self::Innfos(_)) && vector.result == Outcome::Invalid;
        let message = match (needed, vector.kind.is_some()) {
            (true, false) => "an invalid frame of this wire needs its `kind`, request or reply",
            (false, true) => "`kind` is for the invalid frames of a wire that does not tell it",
            _ => return None,
        };
        Some(message.to_owned())
    }

    /// Whether the packet's fields, put together by the wire's rules, yield the frame.
    fn contents(&self, vector: &Vector) -> Option<String> {
        let packet = vector.packet.as_ref()?;
        let frames = match self {
            Self::Dynamixel(protocol) => frame(protocol, packet).into_iter().collect(),
            Self::Innfos(innfos) => innfos::frames(innfos, packet),
        };
        let given = vector.frame();
        let Some(built) = frames.first() else {
            return Some("the wire has no packets of this kind".to_owned());
        };
        if frames.iter().any(|frame| frame == given) {
            return (frames.len() > 1 && vector.result == Outcome::Valid).then(|| {
                "this frame has other readings, so it can only be `acceptable`".to_owned()
            });
        }
        let at = built.iter().zip(given).take_while(|(built, given)| built == given).count();
        Some(format!(
            "the fields yield {}, the bytes are {}; they part at byte {at}",
            HexBytes(built.clone()),
            HexBytes(given.to_vec())
        ))
    }
}

/// The packet's frame; `None` for a packet of another wire.
fn frame(protocol: &Protocol, packet: &Packet) -> Option<Vec<u8>> {
    let status = protocol.status.instruction;
    let broadcast = protocol.framing.id.broadcast;
    let frame = match packet {
        Packet::Instruction { id, instruction, params } => {
            let body = [&[*instruction], params.0.as_slice()].concat();
            let body = stuffed(protocol, &body);
            let mut frame = header(protocol, *id, body.len() + 2);
            frame.extend(body);
            append_crc(protocol, &mut frame);
            frame
        }
        Packet::Status { id, error, params } => {
            let body = [&[status, *error], params.0.as_slice()].concat();
            let body = stuffed(protocol, &body);
            let mut frame = header(protocol, *id, body.len() + 2);
            frame.extend(body);
            append_crc(protocol, &mut frame);
            frame
        }
        Packet::FastStatus { blocks } => {
            let length: usize = blocks.iter().map(|block| 4 + block.data.len()).sum();
            let mut frame = header(protocol, broadcast, length + 1);
            frame.push(status);
            for block in blocks {
                frame.extend([block.error, block.id]);
                frame.extend(block.data.iter());
                append_crc(protocol, &mut frame);
            }
            frame
        }
        Packet::Request { .. } | Packet::Reply { .. } => return None,
    };
    Some(frame)
}

fn header(protocol: &Protocol, id: u8, length: usize) -> Vec<u8> {
    let mut frame = protocol.framing.header.clone();
    frame.push(id);
    let order = protocol.framing.length.byte_order;
    frame.extend(ordered(order, u16::try_from(length).unwrap_or(u16::MAX)));
    frame
}

fn append_crc(protocol: &Protocol, frame: &mut Vec<u8>) {
    let crc = protocol.crc.compute(frame);
    frame.extend(ordered(protocol.crc.byte_order, crc));
}

fn ordered(order: ByteOrder, value: u16) -> [u8; 2] {
    match order {
        ByteOrder::Little => value.to_le_bytes(),
        ByteOrder::Big => value.to_be_bytes(),
    }
}

fn stuffed(protocol: &Protocol, body: &[u8]) -> Vec<u8> {
    let mut out = Vec::new();
    for (index, byte) in body.iter().enumerate() {
        out.push(*byte);
        if body.get(..=index).is_some_and(|head| head.ends_with(&protocol.stuffing.pattern)) {
            out.push(protocol.stuffing.insert);
        }
    }
    out
}
