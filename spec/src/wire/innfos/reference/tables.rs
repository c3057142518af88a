//! The packets that the document's tables have.

use super::is_unspecified;
use crate::wire::Direction;
use crate::wire::innfos::{Format, Innfos, Packet};

/// The commands for the board, whose address is 0: the greeting, and the question for the actuators
/// (§Handshake with ECB and §Query actuator).
const FOR_BOARD: [u8; 2] = [0x44, 0x02];
/// The board answers the greeting itself; the actuators answer the question.
const FROM_BOARD: [u8; 1] = [0x44];

/// Whether the document's tables have this packet and leave nothing about it unspecified: a command
/// with the size and the form of value that its row has in this direction, and an address that may
/// be there.
#[must_use]
pub fn is_in_tables(innfos: &Innfos, packet: &Packet) -> bool {
    let Packet { direction, address, command, data } = packet;
    let Some(row) = innfos.command(*command) else { return false };
    let size = row.size_in(*direction).map(usize::from);
    let form = row.format_in(*direction).is_none_or(|format| has_form(innfos, format, data));
    size == Some(data.len())
        && form
        && has_address(*direction, *command, *address)
        && !is_unspecified(packet)
}

/// Whether the document has a meaning for these bytes. A number may be any.
fn has_form(innfos: &Innfos, format: Format, data: &[u8]) -> bool {
    match (format, data) {
        (Format::Flag, [flag]) => *flag <= 1,
        (Format::Mode, [code]) => innfos.modes.rows.iter().any(|row| row.code == *code),
        (Format::Flag | Format::Mode, _) => false,
        _ => true,
    }
}

/// A request may go to all actuators, but none of them is called 0 in a reply.
fn has_address(direction: Direction, command: u8, address: u8) -> bool {
    match direction {
        Direction::Request if FOR_BOARD.contains(&command) => address == 0,
        Direction::Request => true,
        Direction::Reply => FROM_BOARD.contains(&command) == (address == 0),
    }
}
