//! Checks of INNFOS actuators behind their board.
//!
//! - board: the handshake with the board, and the query for its actuators;
//! - read: each command that reads, and what its answer may hold;
//! - addressee: other addresses, and the broadcast address;
//! - damaged: frames that are none, and what is in one datagram or in two;
//! - sentence: what sentences say of every frame;
//! - written, command: what is written is told again, and which commands are answered;
//! - unknown: commands and data that the document does not have.

mod board;
mod changes;
mod frames;
mod reads;
mod requests;
mod writes;

use std::time::Duration;

use actucheck_spec::wire::innfos::{Packet, WIRE, reference};
use actucheck_spec::wire::{self, Direction};

use super::steps::{asked, packet_then, then};
use super::{Identity, Instructions, Target};
use crate::adapter::{Asked, Permissions, Question, Reported};
use crate::suite::Author;
use crate::suite::check::{Check, Demand};
use crate::suite::plan::Family;
use crate::suite::wanted::{Like, Part, Wanted};

/// The address of requests for the board, and for all actuators.
const ALL: u8 = 0;

/// Codes of commands (INNFOS document, Handshake with ECB, Query actuator and Appendix A).
mod code {
    pub(super) const SIGN_OF_LIFE: u8 = 0x00;
    pub(super) const QUERY: u8 = 0x02;
    pub(super) const SPEED: u8 = 0x05;
    pub(super) const POSITION: u8 = 0x06;
    pub(super) const HANDSHAKE: u8 = 0x44;
    pub(super) const MODE: u8 = 0x55;
    pub(super) const SAVE: u8 = 0x0D;
    pub(super) const PROTECTION: u8 = 0x61;
    pub(super) const CLEAR_ALARMS: u8 = 0xFE;
    /// What sets current, speed and position.
    pub(super) const GOALS: [u8; 3] = [0x08, 0x09, 0x0A];
    pub(super) const ALARMS: u8 = 0xFF;
}

/// The answer to the query takes about half a second (INNFOS document, Query actuator), and may take a
/// little longer.
const QUERY_TAKES: Duration = Duration::from_secs(1);

/// What a flag may be: no or yes.
const FLAGS: [u64; 2] = [0, 1];
const YES: u8 = 1;

pub(super) fn families<'a>(author: Author<'a>, target: &Target<'a>) -> Vec<Family<'a>> {
    let family = |prefix: &str, checks: fn(&Talk<'a>) -> Vec<Check>| {
        let talk = Talk { author, target: target.clone() };
        Family::of(format!("innfos.device.{prefix}."), move || checks(&talk))
    };
    vec![
        family("basic", board::basics),
        family("board", board::checks),
        family("read", reads::checks),
        family("addressee", board::addressees),
        family("damaged", frames::damaged),
        family("datagram", frames::datagrams),
        family("unknown", reads::unknown),
        family("sentence", reads::sentences),
        family("written", writes::checks),
        family("command", writes::commands),
    ]
}

/// What reads values and sets them back. The number of a value is the code of the command that writes it, and
/// after that the code of the one that reads it.
pub(super) const INSTRUCTIONS: Instructions = Instructions {
    read: |id, number, _| request(id, number.to_be_bytes()[1]).into(),
    write: |id, number, data| with_data(id, number.to_be_bytes()[0], data).into(),
    action: None,
    reboot: None,
    // The command that is answered comes before the data.
    held: |data| data.get(1..).unwrap_or_default(),
};

pub(crate) use self::changes::{Place, places};
pub(super) use self::requests::conversation;
pub(super) use self::writes::kept;

/// The handshake with the board, which comes before everything else.
pub(super) fn greeting() -> wire::Packet {
    request(ALL, code::HANDSHAKE).into()
}

/// Asks an actuator for a sign of life.
pub(super) fn hello(address: u8) -> wire::Packet {
    request(address, code::SIGN_OF_LIFE).into()
}

/// The query for all actuators.
pub(super) fn hello_all() -> wire::Packet {
    request(ALL, code::QUERY).into()
}

/// How much longer the answer to these bytes may take than another.
pub(super) fn takes(bytes: &[u8]) -> Duration {
    match reference::decode(Direction::Request, bytes) {
        Ok(Packet { command: code::QUERY, .. }) => QUERY_TAKES,
        _ => Duration::ZERO,
    }
}

/// An actuator tells neither a model nor a version.
pub(super) fn identity(_: &Reported) -> Identity {
    Identity::default()
}

/// What an answer says of the actuator that it is from. The command that is answered comes before
/// the data.
pub(super) fn reported(packet: &wire::Packet) -> Vec<Reported> {
    match packet {
        wire::Packet::Innfos(Packet { direction: Direction::Reply, address, command, data }) => {
            let data = [&[*command][..], &data.0].concat().into();
            vec![Reported { id: *address, data: Some(data), ..Reported::default() }]
        }
        // An echo, or another host.
        _ => Vec::new(),
    }
}

/// Writes checks of an actuator and its board.
struct Talk<'a> {
    author: Author<'a>,
    target: Target<'a>,
}

impl Talk<'_> {
    /// Demands what comes back, step by step.
    fn check(
        &self,
        name: &str,
        requirement: &str,
        steps: Vec<Asked>,
        wanted: Vec<Vec<Vec<Like>>>,
    ) -> Check {
        let wanted = wanted.into_iter().map(Wanted).collect();
        self.asks(name, requirement, steps, Demand::Answer(wanted))
    }

    /// Records what comes back in the first step.
    fn record(&self, name: &str, requirement: &str, step: Asked, question: &str) -> Check {
        self.asks(name, requirement, vec![step], Demand::record(question, []))
    }

    fn asks(&self, name: &str, requirement: &str, steps: Vec<Asked>, demand: Demand) -> Check {
        self.asks_with(Permissions::READ, name, requirement, steps, demand)
    }

    /// Demands what comes back, step by step, where more than reading is needed.
    fn demands(
        &self,
        needs: Permissions,
        name: &str,
        requirement: &str,
        steps: Vec<(Asked, Vec<Vec<Like>>)>,
    ) -> Check {
        let (steps, wanted) = steps.into_iter().map(|(asked, rows)| (asked, Wanted(rows))).unzip();
        self.asks_with(needs, name, requirement, steps, Demand::Answer(wanted))
    }

    fn asks_with(
        &self,
        needs: Permissions,
        name: &str,
        requirement: &str,
        steps: Vec<Asked>,
        demand: Demand,
    ) -> Check {
        let question = Question::Device { wire: WIRE, needs, neighbour: None, steps };
        self.author.check(format!("innfos.device.{name}"), requirement, question, demand)
    }

    /// Something that must not be answered: only the sign of life after it is.
    fn silence(&self, name: &str, requirement: &str, bytes: Vec<u8>) -> Check {
        self.check(name, requirement, vec![self.then_hello(bytes)], vec![vec![vec![self.alive()]]])
    }

    /// The address of the actuator.
    const fn id(&self) -> u8 {
        self.target.id
    }

    /// An address that no actuator has.
    fn absent(&self) -> u8 {
        self.target.absent(WIRE)
    }

    /// A request of the actuator that has no data.
    fn ask(&self, command: u8) -> Packet {
        request(self.id(), command)
    }

    /// An answer of the actuator.
    fn answer(&self, command: u8, data: Vec<Part>) -> Like {
        answer(self.id(), command, data)
    }

    /// The answer to a sign of life: it is ready.
    fn alive(&self) -> Like {
        self.answer(code::SIGN_OF_LIFE, vec![Part::Bytes(vec![YES].into())])
    }

    /// Bytes, and a request for a sign of life in a datagram of its own.
    fn then_hello(&self, bytes: Vec<u8>) -> Asked {
        then(bytes, self.ask(code::SIGN_OF_LIFE))
    }

    /// The same for a packet.
    fn packet_then_hello(&self, packet: Packet) -> Asked {
        packet_then(packet, self.ask(code::SIGN_OF_LIFE))
    }
}

/// An answer to a command.
fn answer(id: u8, command: u8, data: Vec<Part>) -> Like {
    let command = Part::Bytes(vec![command].into());
    Like { id, error: None, data: Some([command].into_iter().chain(data).collect()) }
}

fn request(address: u8, command: u8) -> Packet {
    with_data(address, command, &[])
}

fn with_data(address: u8, command: u8, data: &[u8]) -> Packet {
    Packet { direction: Direction::Request, address, command, data: data.to_vec().into() }
}

fn bytes_of(packet: &Packet) -> Vec<u8> {
    reference::encode(packet).unwrap_or_default()
}
