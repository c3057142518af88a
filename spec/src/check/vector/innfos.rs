//! INNFOS frames, put together byte by byte.

use super::ordered;
use crate::model::{Innfos, Packet};

/// The frames that the packet may have on the wire: one, or several where it is open whether a
/// CRC belongs into it; none for a packet of another wire.
pub(super) fn frames(innfos: &Innfos, packet: &Packet) -> Vec<Vec<u8>> {
    let presence = &innfos.crc_presence;
    let (address, command, data, with_crc_from) = match packet {
        Packet::Request { address, command, data } => (*address, *command, data, presence.request),
        Packet::Reply { address, command, data } => (*address, *command, data, presence.reply),
        _ => return Vec::new(),
    };
    let crc = ordered(innfos.crc.byte_order, innfos.crc.compute(data));
    let reply = matches!(packet, Packet::Reply { .. });
    let endings: &[&[u8]] = if data.is_empty() {
        &[&[]]
    } else if data.len() >= usize::from(with_crc_from) {
        &[&crc]
    } else if reply && presence.open.contains(&command) {
        &[&[], &[0, 0], &crc]
    } else {
        &[&[]]
    };
    let Ok(length) = u16::try_from(data.len()) else {
        return Vec::new();
    };
    let framing = &innfos.framing;
    let mut start = vec![framing.header, address, command];
    start.extend(ordered(framing.length.byte_order, length));
    start.extend(data.iter());
    endings.iter().map(|ending| [start.as_slice(), ending, &[framing.tail]].concat()).collect()
}
