//! Builds packets from the numbers of the file, to compare them with the vectors.

use crate::wire::dynamixel2::{Dynamixel2, Packet};

/// The packet's frame by the numbers of the wire's file.
pub(in crate::wire::dynamixel2) fn frame(wire: &Dynamixel2, packet: &Packet) -> Vec<u8> {
    let status = wire.status.instruction;
    let broadcast = wire.framing.id.broadcast;
    match packet {
        Packet::Instruction { id, instruction, params } => {
            let body = [&[*instruction], params.0.as_slice()].concat();
            let body = stuffed(wire, &body);
            let mut frame = header(wire, *id, body.len() + 2);
            frame.extend(body);
            append_crc(wire, &mut frame);
            frame
        }
        Packet::Status { id, error, params } => {
            let body = [&[status, *error], params.0.as_slice()].concat();
            let body = stuffed(wire, &body);
            let mut frame = header(wire, *id, body.len() + 2);
            frame.extend(body);
            append_crc(wire, &mut frame);
            frame
        }
        Packet::FastStatus { blocks } => {
            let length: usize = blocks.iter().map(|block| 4 + block.data.len()).sum();
            let mut frame = header(wire, broadcast, length + 1);
            frame.push(status);
            for block in blocks {
                frame.extend([block.error, block.id]);
                frame.extend(block.data.iter());
                append_crc(wire, &mut frame);
            }
            frame
        }
    }
}

fn header(wire: &Dynamixel2, id: u8, length: usize) -> Vec<u8> {
    let mut frame = wire.framing.header.clone();
    frame.push(id);
    let order = wire.framing.length.byte_order;
    frame.extend(order.bytes(u16::try_from(length).unwrap_or(u16::MAX)));
    frame
}

fn append_crc(wire: &Dynamixel2, frame: &mut Vec<u8>) {
    let crc = wire.crc.compute(frame);
    frame.extend(wire.crc.byte_order.bytes(crc));
}

fn stuffed(wire: &Dynamixel2, body: &[u8]) -> Vec<u8> {
    let mut out = Vec::new();
    for (index, byte) in body.iter().enumerate() {
        out.push(*byte);
        if body.get(..=index).is_some_and(|head| head.ends_with(&wire.stuffing.pattern)) {
            out.push(wire.stuffing.insert);
        }
    }
    out
}
