//! CRC, stuffing and packets of DYNAMIXEL Protocol 2.0 and its JA dialect.

use super::{BROADCAST, HEADER, PATTERN, PREFIX, STATUS};
use crate::model::{Fault, HexBytes};
use crate::wire::Fast;
use crate::wire::dynamixel2::{Block, Packet};

/// CRC-16/UMTS: the remainder of the message times x^16 by x^16 + x^15 + x^2 + 1, bit by bit.
#[must_use]
pub fn crc(bytes: &[u8]) -> u16 {
    crc_behind(0, bytes)
}

/// The CRC of bytes and those before them, whose CRC is `before`.
#[must_use]
pub fn crc_behind(before: u16, bytes: &[u8]) -> u16 {
    let mut crc = before;
    for byte in bytes {
        crc ^= u16::from(*byte) << 8;
        for _ in 0..8 {
            crc = if crc & 0x8000 == 0 { crc << 1 } else { (crc << 1) ^ 0x8005 };
        }
    }
    crc
}

/// The body with FD after every pattern.
#[must_use]
pub fn stuff(body: &[u8]) -> Vec<u8> {
    let mut out = Vec::new();
    let mut seen = Vec::new();
    for byte in body {
        out.push(*byte);
        seen.push(*byte);
        if seen.ends_with(&PATTERN) {
            out.push(0xFD);
        }
    }
    out
}

/// The body without the FD after every pattern.
///
/// # Errors
/// [`Fault::Stuffing`] if a pattern has no FD after it.
pub fn unstuff(stuffed: &[u8]) -> Result<Vec<u8>, Fault> {
    let mut out: Vec<u8> = Vec::new();
    let mut bytes = stuffed.iter();
    while let Some(byte) = bytes.next() {
        out.push(*byte);
        if out.ends_with(&PATTERN) && bytes.next() != Some(&0xFD) {
            return Err(Fault::Stuffing);
        }
    }
    Ok(out)
}

/// A frame with this body, which is not stuffed.
#[must_use]
pub fn frame(id: u8, body: &[u8]) -> Vec<u8> {
    let length = u16::try_from(body.len() + 2).unwrap_or(u16::MAX);
    let mut frame = HEADER.to_vec();
    frame.push(id);
    frame.extend(length.to_le_bytes());
    frame.extend(body);
    let crc = crc(&frame);
    frame.extend(crc.to_le_bytes());
    frame
}

/// The bytes of a packet; `None` if it is too long for its length field, or no packet may have its ID.
#[must_use]
pub fn encode(packet: &Packet) -> Option<Vec<u8>> {
    let fitting =
        |id, body: &[u8]| (is_id(id) && body.len() + 2 <= 0xFFFF).then(|| frame(id, body));
    match packet {
        Packet::Instruction { id, instruction, params } => {
            fitting(*id, &stuff(&[&[*instruction], params.0.as_slice()].concat()))
        }
        Packet::Status { id, error, params } => {
            fitting(*id, &stuff(&[&[STATUS, *error], params.0.as_slice()].concat()))
        }
        Packet::FastStatus { blocks } => Some(encode_fast(blocks)),
    }
}

fn encode_fast(blocks: &[Block]) -> Vec<u8> {
    let size: usize = blocks.iter().map(|block| block.data.len() + 4).sum();
    let length = u16::try_from(size + 1).unwrap_or(u16::MAX);
    let mut frame = HEADER.to_vec();
    frame.push(BROADCAST);
    frame.extend(length.to_le_bytes());
    frame.push(STATUS);
    for block in blocks {
        frame.extend([block.error, block.id]);
        frame.extend(block.data.iter());
        let crc = crc(&frame);
        frame.extend(crc.to_le_bytes());
    }
    frame
}

/// The packet in `bytes`, which must be one whole frame.
///
/// # Errors
/// The first rule that they break, from front to back.
pub fn decode(bytes: &[u8]) -> Result<Packet, Fault> {
    let (id, stuffed) = body(bytes)?;
    let body = unstuff(stuffed)?;
    match body.as_slice() {
        [STATUS] | [] => Err(Fault::Length),
        [STATUS, error, params @ ..] => {
            Ok(Packet::Status { id, error: *error, params: HexBytes(params.to_vec()) })
        }
        [instruction, params @ ..] => Ok(Packet::Instruction {
            id,
            instruction: *instruction,
            params: HexBytes(params.to_vec()),
        }),
    }
}

/// The fast status packet in `bytes`, as the answer to the request `fast`.
///
/// # Errors
/// The first rule that they break.
pub fn decode_fast(bytes: &[u8], fast: &Fast) -> Result<Packet, Fault> {
    let (id, body) = body(bytes)?;
    let size = usize::from(fast.length);
    if body.first() != Some(&STATUS) {
        return Err(Fault::Instruction);
    }
    if id != BROADCAST {
        return Err(Fault::Id);
    }
    if fast.ids.is_empty() || body.len() + 2 != 1 + fast.ids.len() * (size + 4) {
        return Err(Fault::Length);
    }
    let mut blocks = Vec::new();
    let mut rest = bytes.get(PREFIX + 1..).unwrap_or_default();
    for id in &fast.ids {
        let [error, found, ..] = *rest else { return Err(Fault::Truncated) };
        let (block, behind) = rest.split_at_checked(size + 4).ok_or(Fault::Truncated)?;
        let end = bytes.len() - behind.len();
        let before = bytes.get(..end - 2).unwrap_or_default();
        if !block.ends_with(&crc(before).to_le_bytes()) {
            return Err(Fault::Crc);
        }
        if found != *id {
            return Err(Fault::Id);
        }
        let data = block.get(2..2 + size).unwrap_or_default();
        blocks.push(Block { error, id: found, data: HexBytes(data.to_vec()) });
        rest = behind;
    }
    Ok(Packet::FastStatus { blocks })
}

/// ID and stuffed body of a frame, after checking header, ID, length, size and CRC.
fn body(bytes: &[u8]) -> Result<(u8, &[u8]), Fault> {
    if bytes.iter().zip(HEADER).any(|(found, expected)| *found != expected) {
        return Err(Fault::Header);
    }
    let [_, _, _, _, id, low, high, ..] = *bytes else { return Err(Fault::Truncated) };
    if !is_id(id) {
        return Err(Fault::Id);
    }
    let length = usize::from(u16::from_le_bytes([low, high]));
    let end = PREFIX + length;
    if length < 3 {
        return Err(Fault::Length);
    }
    if bytes.len() < end {
        return Err(Fault::Truncated);
    }
    if bytes.len() > end {
        return Err(Fault::Trailing);
    }
    let (before, found) = bytes.split_at(end - 2);
    if found != crc(before).to_le_bytes() {
        return Err(Fault::Crc);
    }
    Ok((id, before.get(PREFIX..).unwrap_or_default()))
}

/// Whether a packet may have this ID.
fn is_id(id: u8) -> bool {
    id <= 252 || id == BROADCAST
}

/// Whether the documents leave unspecified if a frame is a packet: a bare pattern, or a status packet
/// from the broadcast ID where no fast status packet is asked for.
#[must_use]
pub fn is_unspecified(bytes: &[u8]) -> bool {
    matches!(decode(bytes), Err(Fault::Stuffing) | Ok(Packet::Status { id: BROADCAST, .. }))
}

/// The part of a whole frame that the byte at `offset` belongs to.
#[must_use]
pub fn part(frame: &[u8], offset: usize) -> &'static str {
    match offset {
        0..4 => "header",
        4 => "ID",
        5..PREFIX => "length",
        PREFIX => "instruction",
        _ if offset + 2 >= frame.len() => "CRC",
        _ => "parameters",
    }
}

/// Makes the CRC of a frame right.
pub fn repair(frame: &mut [u8]) {
    if let Some((before, end)) = frame.split_last_chunk_mut() {
        *end = crc(before).to_le_bytes();
    }
}
