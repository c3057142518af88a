//! What the board and its actuators answer a host that looks for them before it makes calls.

use actucheck_spec::wire::Direction;
use actucheck_spec::wire::innfos::{Packet, reference};

use super::super::script::Greeted;

/// The actuators that a host finds: those that the checks of hosts call.
const PRESENT: [u8; 4] = [0x01, 0x06, 0x07, 0xFF];
const HANDSHAKE: u8 = 0x44;
const QUERY: u8 = 0x02;

/// The handshake with the board, and the query for the actuators (§Handshake with ECB and §Query actuator).
pub(in crate::bus) fn greeted() -> Vec<Greeted> {
    let asked = |command| frame(Direction::Request, 0, command, &[]);
    let board = frame(Direction::Reply, 0, HANDSHAKE, &[0x01]);
    let actuator = |id| frame(Direction::Reply, id, QUERY, &[0x01, 0x64, 0x5A, id]);
    vec![
        (asked(HANDSHAKE), vec![board]),
        (asked(QUERY), PRESENT.into_iter().map(actuator).collect()),
    ]
}

fn frame(direction: Direction, address: u8, command: u8, data: &[u8]) -> Vec<u8> {
    let packet = Packet { direction, address, command, data: data.to_vec().into() };
    reference::encode(&packet).unwrap_or_default()
}
