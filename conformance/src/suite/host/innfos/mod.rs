//! Checks of hosts on the INNFOS Ethernet protocol.
//!
//! - calls: each command with a right answer, what comes after it, and answers that are none or a refusal;
//! - frames: what frames hold, by single sentences, and the frames that the document prints;
//! - faults: answers to a read that are damaged, late, or of something else;
//! - writes: answers to a write that are damaged or of something else;
//! - query: the actuators that answer the query, among other answers.

mod calls;
mod faults;
pub(crate) mod found;
mod frames;
mod query;
mod writes;

use actucheck_spec::wire::innfos::{Packet, reference};
use actucheck_spec::wire::{Call, Direction};

use super::{NO_ANSWER, all, burst, data, failed, later, step, untold};
use crate::adapter::{Burst, Reported, Step, Trouble};
use crate::suite::Author;
use crate::suite::check::{Check, Demand};
use crate::suite::due::Due;
use crate::suite::plan::Family;

/// The actuator that most calls go to, and another one.
const ID: u8 = 0x06;
const OTHER_ID: u8 = 0x07;

/// The commands that are for the board: the handshake, and the query for its actuators.
const HANDSHAKE: u8 = 0x44;
const QUERY: u8 = 0x02;
/// Other commands: two reads of four bytes, one of the alarms, a write of each size, and a sign of life.
const READ_SPEED: u8 = 0x05;
const READ_POSITION: u8 = 0x06;
const READ_ALARMS: u8 = 0xFF;
const SWITCH: u8 = 0x2A;
const SET_TEMPERATURE: u8 = 0x61;
const SET_POSITION: u8 = 0x0A;
const SIGN_OF_LIFE: u8 = 0x00;

const LAYOUT: &str = "innfos.frame.layout";
const ALWAYS: &str = "innfos.reply.always";
const ECHO: &str = "innfos.reply.echo";
const VERIFY: &str = "innfos.crc.verify";
const TAIL: &str = "innfos.frame.tail";

pub(super) fn families(author: Author<'_>) -> Vec<Family<'_>> {
    vec![
        Family::of("innfos.host.basic.", move || calls::basics(author)),
        Family::of("innfos.host.frame.", move || frames::frames(author)),
        Family::of("innfos.host.value.", move || frames::values(author)),
        Family::of("innfos.host.printed.", move || frames::printed(author)),
        Family::of("innfos.host.after.", move || calls::after(author)),
        Family::of("innfos.host.no-success.", move || calls::unsuccessful(author)),
        Family::of("innfos.host.handshake.", move || calls::handshake(author)),
        Family::of("innfos.host.read.", move || faults::checks(author)),
        Family::of("innfos.host.write.", move || writes::checks(author)),
        Family::of("innfos.host.query.", move || query::checks(author)),
    ]
}

/// The commands with the same or fewer bytes of data, one of each size, and the call's own.
pub(super) fn rests_on(call: &Call) -> Vec<String> {
    let of_sizes: &[u8] = match call.data.as_ref().map_or(0, |data| data.len()) {
        0 => &[READ_POSITION],
        1 => &[SWITCH],
        2 => &[SWITCH, SET_TEMPERATURE],
        _ => &[SWITCH, SET_TEMPERATURE, SET_POSITION],
    };
    of_sizes.iter().copied().chain(call.command).map(stem).collect()
}

/// Whether this asks whether the board or an actuator is there, as a host may at any time.
pub(super) fn is_aside(datagram: &[u8]) -> bool {
    match reference::decode(Direction::Request, datagram) {
        Ok(Packet { command, data, .. }) => {
            data.is_empty() && [HANDSHAKE, QUERY, SIGN_OF_LIFE].contains(&command)
        }
        Err(_) => false,
    }
}

/// A command in an id.
fn stem(command: u8) -> String {
    format!("{command:02x}")
}

fn request(address: u8, command: u8, data: &[u8]) -> Packet {
    Packet { direction: Direction::Request, address, command, data: data.to_vec().into() }
}

/// A read of an actuator.
fn read(command: u8) -> Packet {
    request(ID, command, &[])
}

/// The bytes of a reply.
fn reply(address: u8, command: u8, data: &[u8]) -> Vec<u8> {
    let data = data.to_vec().into();
    frame(&Packet { direction: Direction::Reply, address, command, data })
}

fn frame(packet: &Packet) -> Vec<u8> {
    reference::encode(packet).unwrap_or_default()
}

/// A call that gets this answer, however often it asks.
fn answered(request: Packet, answer: Vec<Burst>) -> Step {
    step(request, vec![answer.clone(), answer.clone(), answer])
}

/// A datagram at once, if there is one.
fn datagram(bytes: &[u8]) -> Vec<Burst> {
    if bytes.is_empty() { Vec::new() } else { vec![burst(bytes)] }
}

/// An actuator that answered, and nothing more.
fn bare(id: u8) -> Reported {
    Reported { id, ..Reported::default() }
}

/// An actuator that answered the query.
fn found(id: u8, mac: &[u8]) -> Reported {
    Reported { mac: Some(mac.to_vec().into()), ..bare(id) }
}

/// The call tells that the actuator refused it, or does not tell anything.
fn refused() -> Due {
    Due { or: vec![Trouble::Status], ..all([]) }
}

/// The same check, whose answer the document leaves unspecified.
fn recorded(check: Check, question: &str) -> Check {
    Check { demand: Demand::record(question, []), ..check }
}
