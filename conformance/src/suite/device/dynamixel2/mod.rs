//! Checks of devices on DYNAMIXEL Protocol 2.0 and its JA dialect.
//!
//! - identity: what Ping tells, and that Read tells the same;
//! - table: that every register can be read, and what some must hold;
//! - refused: addresses and instructions that there are not;
//! - addressee: other IDs, and the broadcast ID;
//! - damaged: packets with a wrong byte, and packets in noise or in parts;
//! - sentence: what sentences say of packets in general, of instructions that change something, and of modes;
//! - level: which instructions are answered;
//! - several: instructions that read from several devices;
//! - written, registered, stuffed: what is written is held, whoever else is meant or written to, and whatever its
//!   bytes are;
//! - range, limit, access, length: what can't be written, and what is recorded of how much can;
//! - restart: what a restart or a reset leaves, and what torque locks;
//! - alarm: what a hardware error shows in a register and in every answer;
//! - backup: what Control Table Backup stores and restores;
//! - motion: a shaft on its way to a goal, and at the end of it.

mod access;
mod addressee;
mod alarm;
mod backup;
mod changes;
mod damaged;
mod effects;
mod factory;
mod identity;
mod level;
mod limits;
mod modes;
mod motion;
mod pair;
mod refused;
mod requests;
mod restart;
mod sentences;
mod several;
mod still;
mod stuffed;
mod table;
mod writable;
mod written;

use actucheck_spec::model::{Citation, Device, HexBytes, Role};
use actucheck_spec::wire;
use actucheck_spec::wire::dynamixel2::reference::{BROADCAST, frame};
use actucheck_spec::wire::dynamixel2::{Packet, WIRE};

use super::steps::{asked, bytes_of, packet_then, then};
use super::{Identity, Instructions, Neighbour, Target, basic};
use crate::adapter::{Asked, Permissions, Question, Reported};
use crate::suite::Author;
use crate::suite::check::{Check, Demand};
use crate::suite::plan::Family;
use crate::suite::wanted::{Like, Part, Wanted};

/// Codes of instructions (DYNAMIXEL Protocol 2.0, Instruction; JA40 document, §1.3).
mod code {
    pub(super) const PING: u8 = 0x01;
    pub(super) const READ: u8 = 0x02;
    pub(super) const WRITE: u8 = 0x03;
    pub(super) const REG_WRITE: u8 = 0x04;
    pub(super) const ACTION: u8 = 0x05;
    pub(super) const FACTORY_RESET: u8 = 0x06;
    pub(super) const REBOOT: u8 = 0x08;
    pub(super) const CLEAR: u8 = 0x10;
    pub(super) const BACKUP: u8 = 0x20;
    pub(super) const SYNC_READ: u8 = 0x82;
    pub(super) const SYNC_WRITE: u8 = 0x83;
    pub(super) const FAST_SYNC_READ: u8 = 0x8A;
    pub(super) const FAST_SYNC_WRITE: u8 = 0x8B;
    pub(super) const BULK_READ: u8 = 0x92;
    pub(super) const BULK_WRITE: u8 = 0x93;
}

/// Error numbers (DYNAMIXEL Protocol 2.0, Error).
mod error {
    pub(super) const NONE: u8 = 0;
    pub(super) const INSTRUCTION: u8 = 2;
    pub(super) const CRC: u8 = 3;
    pub(super) const DATA_RANGE: u8 = 4;
    pub(super) const DATA_LENGTH: u8 = 5;
    pub(super) const DATA_LIMIT: u8 = 6;
    pub(super) const ACCESS: u8 = 7;
}

/// What bit 7 of the error byte is.
const ALERT: u8 = 0x80;

pub(super) fn families<'a>(author: Author<'a>, target: &Target<'a>) -> Vec<Family<'a>> {
    let family = |prefix: &str, checks: fn(&Talk<'a>) -> Vec<Check>| {
        let talk = Talk { author, target: target.clone() };
        Family::of(format!("dynamixel2.device.{prefix}."), move || checks(&talk))
    };
    vec![
        family("basic", |talk| [identity::basics(talk), written::basics(talk)].concat()),
        family("identity", identity::checks),
        family("table", table::checks),
        family("refused", refused::checks),
        family("addressee", addressee::checks),
        family("damaged", damaged::checks),
        family("stream", damaged::in_streams),
        family("several", several::checks),
        family("sentence", |talk| {
            let own = [sentences::checks, effects::checks, modes::checks];
            own.into_iter().flat_map(|checks| checks(talk)).collect()
        }),
        family("level", level::checks),
        family("written", |talk| {
            [written::kept(talk), written::several(talk), pair::checks(talk)].concat()
        }),
        family("registered", written::registered),
        family("stuffed", stuffed::checks),
        family("range", limits::ranges),
        family("limit", |talk| [limits::limited(talk), modes::limited(talk)].concat()),
        family("access", access::checks),
        family("length", |talk| [access::lengths(talk), access::of_several(talk)].concat()),
        family("restart", restart::reboot),
        family("reset", |talk| [restart::reset(talk), factory::checks(talk)].concat()),
        family("lock", restart::lock),
        family("alarm", alarm::checks),
        family("backup", backup::checks),
        family("motion", motion::checks),
    ]
}

/// What reads registers and sets them back.
pub(super) const INSTRUCTIONS: Instructions = Instructions {
    read: |id, address, length| read(id, address, length).into(),
    write: |id, address, data| write(id, address, data).into(),
    action: Some(|id| instruction(id, code::ACTION, Vec::new()).into()),
    reboot: Some(|id| instruction(id, code::REBOOT, Vec::new()).into()),
    held: |data| data,
};

pub(crate) use changes::{Place, is_measured, places};
pub(super) use pair::written_beside;
pub(crate) use refused::UNDEFINED;
pub(super) use requests::conversation;

/// Ping.
pub(super) fn hello(id: u8) -> wire::Packet {
    ping(id).into()
}

/// Ping to the broadcast ID.
pub(super) fn hello_all() -> wire::Packet {
    ping(BROADCAST).into()
}

/// Model number and firmware version, which answer Ping.
pub(super) fn identity(answer: &Reported) -> Identity {
    match answer.data.as_ref().map(|data| data.0.as_slice()) {
        Some([low, high, firmware]) => Identity {
            model_number: Some(u16::from_le_bytes([*low, *high])),
            firmware_version: Some(*firmware),
        },
        _ => Identity::default(),
    }
}

/// What an answer says of each device that it is from.
pub(super) fn reported(packet: &wire::Packet) -> Vec<Reported> {
    let reported = |id, error: u8, data: &HexBytes| Reported {
        id,
        data: Some(data.clone()),
        error: Some(error & !ALERT),
        alert: Some(error & ALERT != 0),
        ..Reported::default()
    };
    match packet {
        wire::Packet::Dynamixel2(Packet::Status { id, error, params }) => {
            vec![reported(*id, *error, params)]
        }
        wire::Packet::Dynamixel2(Packet::FastStatus { blocks }) => {
            blocks.iter().map(|block| reported(block.id, block.error, &block.data)).collect()
        }
        // An echo, or another host.
        _ => Vec::new(),
    }
}

/// Writes checks of a device.
struct Talk<'a> {
    author: Author<'a>,
    target: Target<'a>,
}

impl Talk<'_> {
    /// Demands what comes back, step by step.
    fn check(
        &self,
        id: String,
        requirements: &[impl AsRef<str>],
        steps: Vec<Asked>,
        wanted: Vec<Vec<Vec<Like>>>,
    ) -> Check {
        let wanted = wanted.into_iter().map(Wanted).collect();
        self.asks(id, requirements, steps, Demand::Answer(wanted))
    }

    /// Records what comes back in the first step.
    fn record(
        &self,
        id: String,
        requirements: &[impl AsRef<str>],
        steps: Vec<Asked>,
        question: &str,
    ) -> Check {
        self.asks(id, requirements, steps, Demand::record(question, []))
    }

    fn asks(
        &self,
        id: String,
        requirements: &[impl AsRef<str>],
        steps: Vec<Asked>,
        demand: Demand,
    ) -> Check {
        self.asks_with(Permissions::READ, id, requirements, steps, demand)
    }

    /// What needs more than to read.
    fn asks_with(
        &self,
        needs: Permissions,
        id: String,
        requirements: &[impl AsRef<str>],
        steps: Vec<Asked>,
        demand: Demand,
    ) -> Check {
        let question = Question::Device { wire: WIRE, needs, neighbour: None, steps };
        // A test checks that there is one for every check.
        let requirement = self.row(requirements).unwrap_or_default();
        self.author.check(id, &requirement, question, demand)
    }

    /// The first of these requirements that there is: of the device's own document, or else of the
    /// DYNAMIXEL document.
    fn row(&self, names: &[impl AsRef<str>]) -> Option<String> {
        let documents = || self.document().into_iter().chain([WIRE.id()]);
        let mut ids = documents().flat_map(|document| {
            names.iter().map(move |name| format!("{document}.{}", name.as_ref()))
        });
        let binds = |id: &String| {
            let row = self.author.spec.requirement(id);
            row.is_some_and(|row| row.binds.contains(&Role::Device))
        };
        ids.find(binds)
    }

    /// The document that has the device's control table.
    fn document(&self) -> Option<&str> {
        let Citation { document, .. } = self.target.device?.source.first()?;
        Some(document)
    }

    /// Whether its document has this instruction. Of a device without one nothing more than Ping and
    /// Read is known.
    fn knows(&self, instruction: &str) -> bool {
        let device = self.target.device;
        device.is_some_and(|device| device.instructions.iter().any(|name| name == instruction))
    }

    /// The neighbour, unless it is known that it has not this instruction.
    fn neighbour_with(&self, instruction: &str) -> Option<u8> {
        let Neighbour { id, device } = self.target.neighbour?;
        let has = |device: &Device| device.instructions.iter().any(|name| name == instruction);
        device.is_none_or(has).then_some(id)
    }

    /// The ID of the device.
    const fn id(&self) -> u8 {
        self.target.id
    }

    /// An ID that no device on the line has.
    fn absent(&self) -> u8 {
        self.target.absent(WIRE)
    }

    fn ping(&self) -> Packet {
        ping(self.id())
    }

    fn read(&self, address: u16, length: u16) -> Packet {
        read(self.id(), address, length)
    }

    /// What answers Ping.
    fn pong(&self) -> Like {
        self.done(Part::Any(3))
    }

    /// An answer without error, with this data.
    fn done(&self, data: Part) -> Like {
        self.says(error::NONE, vec![data])
    }

    /// An answer with an error number and without data.
    fn refusal(&self, error: u8) -> Like {
        self.says(error, Vec::new())
    }

    fn says(&self, error: u8, data: Vec<Part>) -> Like {
        Like { id: self.id(), error: Some(error), data: Some(data) }
    }

    /// Something that must not be answered, and a Ping after it.
    fn then_ping(&self, bytes: Vec<u8>) -> Asked {
        then(bytes, self.ping())
    }

    /// The same for a packet.
    fn packet_then_ping(&self, packet: Packet) -> Asked {
        packet_then(packet, self.ping())
    }
}

fn ping(id: u8) -> Packet {
    instruction(id, code::PING, Vec::new())
}

fn read(id: u8, address: u16, length: u16) -> Packet {
    instruction(id, code::READ, [address, length].map(u16::to_le_bytes).concat())
}

fn write(id: u8, address: u16, data: &[u8]) -> Packet {
    instruction(id, code::WRITE, [&address.to_le_bytes()[..], data].concat())
}

fn instruction(id: u8, instruction: u8, params: Vec<u8>) -> Packet {
    Packet::Instruction { id, instruction, params: params.into() }
}

/// The id of a check.
fn named(name: &str) -> String {
    format!("dynamixel2.device.{name}")
}

/// A register's name in an id.
fn word(name: &str) -> String {
    crate::names::as_word(name)
}
