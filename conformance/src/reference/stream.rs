//! Packets in a stream, found the slow way: at each byte, is what begins here a whole packet?

use actucheck_spec::model::{Fault, Packet};

use super::{PREFIX, decode};

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

/// The packet that begins here, and its size.
fn first(bytes: &[u8]) -> Option<(Packet, usize)> {
    let [_, _, _, _, _, low, high, ..] = *bytes else { return None };
    let size = PREFIX + usize::from(u16::from_le_bytes([low, high]));
    let frame = bytes.get(..size)?;
    let packet: Result<Packet, Fault> = decode(frame);
    Some((packet.ok()?, size))
}
