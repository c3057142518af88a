//! A vector's bytes and fields say the same, and its kind of result has what it needs.

use crate::load::File;
use crate::model::{ByteOrder, HexBytes, Outcome, Packet, Protocol, Vector, VectorsFile};
use crate::{Diagnostic, Spec};

pub(super) fn check(spec: &Spec) -> Vec<Diagnostic> {
    let mut defects = Vec::new();
    for file in &spec.vectors {
        let Some(protocol) = spec.protocol(&file.content.wire) else {
            continue;
        };
        for (index, vector) in file.content.vectors.iter().enumerate() {
            let node = format!("vectors[{index}]");
            if let Some(message) = shape(vector).or_else(|| contents(protocol, vector)) {
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
        _ => return None,
    };
    Some(message.to_owned())
}

/// Whether the packet's fields, put together by the protocol's rules, yield the frame.
fn contents(protocol: &Protocol, vector: &Vector) -> Option<String> {
    let built = frame(protocol, vector.packet.as_ref()?);
    let given = vector.frame();
    (built != given).then(|| {
        let at = built.iter().zip(given).take_while(|(built, given)| built == given).count();
        format!(
            "the fields yield {}, the bytes are {}; they part at byte {at}",
            HexBytes(built),
            HexBytes(given.to_vec())
        )
    })
}

fn frame(protocol: &Protocol, packet: &Packet) -> Vec<u8> {
    let status = protocol.status.instruction;
    let broadcast = protocol.framing.id.broadcast;
    match packet {
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
    }
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
