//! Frames that are right in one respect.
//!
//! A check of one sentence accepts frames that break the sentences of later checks: whether the
//! length's low byte comes first does not depend on the order of the CRC's bytes.

use actucheck_spec::wire::dynamixel2::Packet;
use actucheck_spec::wire::dynamixel2::reference::{self, HEADER, STATUS};

/// What may be wrong in a frame.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum May {
    Nothing,
    Crc,
    LengthAndCrc,
}

/// Everything between the length and the CRC, without stuffing.
pub(super) fn body(packet: &Packet) -> Vec<u8> {
    match packet {
        Packet::Instruction { instruction, params, .. } => {
            [&[*instruction], params.0.as_slice()].concat()
        }
        Packet::Status { error, params, .. } => [&[STATUS, *error], params.0.as_slice()].concat(),
        Packet::FastStatus { .. } => Vec::new(),
    }
}

/// The frames of a packet, the right one first. The length and the CRC may be in the other byte
/// order, or those of the body before stuffing.
pub(super) fn frames(packet: &Packet, may: May) -> Vec<Vec<u8>> {
    let right = reference::encode(packet).unwrap_or_default();
    let (Packet::Instruction { id, .. } | Packet::Status { id, .. }) = packet else {
        return vec![right];
    };
    if may == May::Nothing {
        return vec![right];
    }
    let plain = body(packet);
    let stuffed = reference::stuff(&plain);
    let length = |body: &[u8]| u16::try_from(body.len() + 2).unwrap_or_default().to_le_bytes();
    let before_crc =
        |[low, high]: [u8; 2], body: &[u8]| [&HEADER[..], &[*id, low, high], body].concat();
    let [low, high] = length(&stuffed);
    let lengths = match may {
        May::LengthAndCrc => vec![[low, high], [high, low], length(&plain)],
        _ => vec![[low, high]],
    };
    let mut frames = Vec::new();
    for length_bytes in lengths {
        let before = before_crc(length_bytes, &stuffed);
        let crc = reference::crc(&before);
        let [before_length, behind_length] = [length(&plain), length(&stuffed)]
            .map(|length| reference::crc(&before_crc(length, &plain)));
        for crc in [crc, crc.swap_bytes(), before_length, behind_length] {
            let frame = [before.as_slice(), &crc.to_le_bytes()].concat();
            if !frames.contains(&frame) {
                frames.push(frame);
            }
        }
    }
    frames
}
