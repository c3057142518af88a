//! Packets in a stream, found the slow way: at each byte, is what begins here a whole packet?

use actucheck_spec::model::{Fault, Packet};

use super::{HEADER, PREFIX, decode};

/// The shortest status packet. A receiver may take so many bytes before it looks at their length.
const SHORTEST: usize = 11;

/// The packets of a stream, however it was cut into chunks. Where no packet begins, the search
/// goes on one byte further; behind a packet, it goes on at its end. What is incomplete at the end
/// of the stream is none, and what begins within it is searched for too.
#[must_use]
pub fn packets(stream: &[u8]) -> Vec<Packet> {
    let mut packets = Vec::new();
    let mut rest = stream;
    while !rest.is_empty() {
        match first(rest) {
            Some((packet, size)) => {
                packets.push(packet);
                rest = rest.get(size..).unwrap_or_default();
            }
            None => rest = rest.get(1..).unwrap_or_default(),
        }
    }
    packets
}

/// The packets that a receiver finds which believes every length: where a header is, it goes on
/// behind the bytes that the length covers, whether they were a packet or not, and waits for them.
#[must_use]
pub fn packets_behind_lengths(stream: &[u8]) -> Vec<Packet> {
    let mut packets = Vec::new();
    let mut rest = stream;
    while !rest.is_empty() {
        let covered = rest.starts_with(&HEADER).then(|| size(rest)).flatten();
        if let Some((packet, _)) = first(rest) {
            packets.push(packet);
        }
        rest = rest.get(covered.unwrap_or(1)..).unwrap_or_default();
    }
    packets
}

/// Whether every receiver finds the packets of a stream, wherever it goes on behind what is none:
/// no false header claims a byte of them.
#[must_use]
pub fn is_certain(stream: &[u8]) -> bool {
    let (mut at, mut claimed) = (0, 0);
    while let Some(rest) = stream.get(at..).filter(|rest| !rest.is_empty()) {
        if let Some((_, size)) = first(rest) {
            if claimed > at {
                return false;
            }
            at += size;
            continue;
        }
        if rest.starts_with(&HEADER) {
            claimed = claimed.max(at + size(rest).unwrap_or_default().max(SHORTEST));
        }
        at += 1;
    }
    true
}

/// The packet that begins here, and its size.
fn first(bytes: &[u8]) -> Option<(Packet, usize)> {
    let size = size(bytes)?;
    let frame = bytes.get(..size)?;
    let packet: Result<Packet, Fault> = decode(frame);
    Some((packet.ok()?, size))
}

/// The size that the length claims.
fn size(bytes: &[u8]) -> Option<usize> {
    let [_, _, _, _, _, low, high, ..] = *bytes else { return None };
    Some(PREFIX + usize::from(u16::from_le_bytes([low, high])))
}
