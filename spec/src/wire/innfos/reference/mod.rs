//! The reference model: CRC and frames as the document describes them, byte by byte. It is slow and
//! obviously right, and shares no code with the codec or the generator.

mod message;
mod tables;

pub use message::{Meaning, meaning, packet};
pub use tables::is_in_tables;

use crate::model::{Fault, HexBytes};
use crate::wire::innfos::Packet;
use crate::wire::{Call, Direction};

/// The first byte of a frame.
const HEADER: u8 = 0xEE;
/// The last byte of a frame.
pub const TAIL: u8 = 0xED;
/// Bytes of header, address, command and length.
pub const PREFIX: usize = 5;
/// The commands whose replies of one byte may or may not have a CRC.
const OPTIONAL_CRC: [u8; 2] = [0x02, 0x44];

/// CRC-16/MODBUS, lowest bit first, bit by bit.
#[must_use]
pub fn crc(bytes: &[u8]) -> u16 {
    let mut crc = 0xFFFF_u16;
    for byte in bytes {
        crc ^= u16::from(*byte);
        for _ in 0..8 {
            crc = if crc & 1 == 0 { crc >> 1 } else { (crc >> 1) ^ 0xA001 };
        }
    }
    crc
}

/// The bytes of a packet; `None` if it has too much data for its length field.
#[must_use]
pub fn encode(packet: &Packet) -> Option<Vec<u8>> {
    let Packet { direction, address, command, data } = packet;
    let length = u16::try_from(data.len()).ok()?;
    let mut frame = vec![HEADER, *address, *command];
    frame.extend(length.to_be_bytes());
    frame.extend(data.iter());
    if has_crc(*direction, data) {
        // The low byte of CRC-16/MODBUS comes first; the document calls it the high byte.
        frame.extend(crc(data).to_le_bytes());
    }
    frame.push(TAIL);
    Some(frame)
}

/// A request with data has a CRC; a reply has one if it has at least two bytes of data.
fn has_crc(direction: Direction, data: &[u8]) -> bool {
    match direction {
        Direction::Request => !data.is_empty(),
        Direction::Reply => data.len() > 1,
    }
}

/// Whether a reply may have no CRC, zeros in its place, or a CRC.
fn has_optional_crc(direction: Direction, command: u8, data: &[u8]) -> bool {
    direction == Direction::Reply && data.len() == 1 && OPTIONAL_CRC.contains(&command)
}

/// Whether this is a reply with one byte of data and its right CRC: the format of a frame has that
/// CRC, the document's examples do not.
#[must_use]
pub fn is_short_reply_with_crc(direction: Direction, bytes: &[u8]) -> bool {
    match *bytes {
        [HEADER, _, _, 0, 1, data, first, second, TAIL] => {
            direction == Direction::Reply && crc(&[data]).to_le_bytes() == [first, second]
        }
        _ => false,
    }
}

/// Whether the documents leave the frame of this packet unspecified.
#[must_use]
pub fn is_unspecified(packet: &Packet) -> bool {
    has_optional_crc(packet.direction, packet.command, &packet.data)
}

/// Whether zeros or the CRC, then the end byte, follow the data. Only this distinguishes a reply
/// with a CRC from one without, as another frame may follow.
fn looks_like_crc(data: &[u8], behind: &[u8]) -> bool {
    let ends = |crc: [u8; 2]| behind.starts_with(&[&crc[..], &[TAIL]].concat());
    ends([0, 0]) || ends(crc(data).to_le_bytes())
}

/// The packet in `bytes`, which must be one whole frame.
///
/// # Errors
/// The first rule that they break: header, length, tail, trailing bytes, CRC.
pub fn decode(direction: Direction, bytes: &[u8]) -> Result<Packet, Fault> {
    let first = first(direction, bytes)?;
    if first.size < bytes.len() {
        return Err(Fault::Trailing);
    }
    if first.crc_matches { Ok(first.packet) } else { Err(Fault::Crc) }
}

/// The packets of a datagram, one frame after the other, up to the first byte that begins no frame.
#[must_use]
pub fn packets(direction: Direction, datagram: &[u8]) -> Vec<Packet> {
    let mut packets = Vec::new();
    let mut rest = datagram;
    while let Some((packet, size)) = whole(direction, rest) {
        packets.push(packet);
        rest = rest.get(size..).unwrap_or_default();
    }
    packets
}

/// The packets of a datagram at any place: if none begins at a byte, the search continues at the
/// next byte.
#[must_use]
pub fn packets_anywhere(direction: Direction, datagram: &[u8]) -> Vec<Packet> {
    let mut packets = Vec::new();
    let mut rest = datagram;
    while !rest.is_empty() {
        let size = match whole(direction, rest) {
            Some((packet, size)) => {
                packets.push(packet);
                size
            }
            None => 1,
        };
        rest = rest.get(size..).unwrap_or_default();
    }
    packets
}

/// The valid packet that begins here, and its size.
fn whole(direction: Direction, bytes: &[u8]) -> Option<(Packet, usize)> {
    let first = first(direction, bytes).ok().filter(|first| first.crc_matches)?;
    Some((first.packet, first.size))
}

/// The packet that begins at a place, and its size.
struct First {
    packet: Packet,
    size: usize,
    /// The CRC is right, or the frame has none.
    crc_matches: bool,
}

/// The packet that begins here.
fn first(direction: Direction, bytes: &[u8]) -> Result<First, Fault> {
    if bytes.first().is_some_and(|byte| *byte != HEADER) {
        return Err(Fault::Header);
    }
    let [_, address, command, high, low, ..] = *bytes else { return Err(Fault::Truncated) };
    let length = usize::from(u16::from_be_bytes([high, low]));
    let rest = bytes.get(PREFIX..).unwrap_or_default();
    let (data, behind) = rest.split_at_checked(length).ok_or(Fault::Truncated)?;
    let packet = || Packet { direction, address, command, data: HexBytes(data.to_vec()) };
    let without_crc = PREFIX + length + 1;
    let optional = has_optional_crc(direction, command, data);
    let with_crc = if optional { looks_like_crc(data, behind) } else { has_crc(direction, data) };
    if !with_crc {
        return match behind.first() {
            Some(&TAIL) => Ok(First { packet: packet(), size: without_crc, crc_matches: true }),
            Some(_) => Err(Fault::Tail),
            None => Err(Fault::Truncated),
        };
    }
    let [first, second, tail, ..] = *behind else { return Err(Fault::Truncated) };
    let found = u16::from_le_bytes([first, second]);
    if tail != TAIL {
        return Err(Fault::Tail);
    }
    Ok(First {
        packet: packet(),
        size: without_crc + 2,
        crc_matches: optional || found == crc(data),
    })
}

/// What a packet says in words: its command with the data.
#[must_use]
pub fn call(packet: &Packet) -> Call {
    let name = match packet.direction {
        Direction::Request => "request",
        Direction::Reply => "reply",
    };
    let (command, data) = (Some(packet.command), Some(packet.data.clone()));
    Call { command, data, ..Call::general(name) }
}

/// The part of a whole frame that the byte at `offset` belongs to.
#[must_use]
pub fn part(frame: &[u8], offset: usize) -> &'static str {
    let length = frame
        .get(3..PREFIX)
        .map_or(0, |length| length.iter().fold(0, |length, byte| length << 8 | usize::from(*byte)));
    match offset {
        0 => "header",
        1 => "address",
        2 => "command",
        3 | 4 => "length",
        _ if offset < PREFIX + length => "data",
        _ if offset + 1 >= frame.len() => "end",
        _ => "CRC",
    }
}

/// Mends the CRC before the end of a frame.
pub fn repair(frame: &mut [u8]) {
    if let Some((_, before)) = frame.split_last()
        && let Some((start, _)) = before.split_last_chunk::<2>()
    {
        let found = crc(start.get(PREFIX..).unwrap_or_default()).to_le_bytes();
        let at = start.len();
        frame.iter_mut().skip(at).zip(found).for_each(|(slot, byte)| *slot = byte);
    }
}
