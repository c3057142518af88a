//! Builds frames from the numbers of the file, to compare them with the vectors.

use crate::wire::Direction;
use crate::wire::innfos::{Innfos, Packet};

/// The frames that the packet may have on the wire: one, or several where its CRC is
/// optional.
pub(in crate::wire::innfos) fn frames(innfos: &Innfos, packet: &Packet) -> Vec<Vec<u8>> {
    let presence = &innfos.crc_presence;
    let Packet { direction, address, command, data } = packet;
    let with_crc_from = match direction {
        Direction::Request => presence.request,
        Direction::Reply => presence.reply,
    };
    let crc = innfos.crc.byte_order.bytes(innfos.crc.compute(data));
    let endings: &[&[u8]] = if data.is_empty() {
        &[&[]]
    } else if data.len() >= usize::from(with_crc_from) {
        &[&crc]
    } else if *direction == Direction::Reply && presence.optional.contains(command) {
        &[&[], &[0, 0], &crc]
    } else {
        &[&[]]
    };
    let Ok(length) = u16::try_from(data.len()) else {
        return Vec::new();
    };
    let framing = &innfos.framing;
    let mut start = vec![framing.header, *address, *command];
    start.extend(framing.length.byte_order.bytes(length));
    start.extend(data.iter());
    endings.iter().map(|ending| [start.as_slice(), ending, &[framing.tail]].concat()).collect()
}
