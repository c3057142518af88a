//! The checks: where they come from, what they demand, and files of them.
//!
//! What a golden check demands is printed in a document; what the others demand comes from
//! [`mod@reference`]. Ids are permanent: they name what is asked, not its place in
//! the list.

pub mod check;
pub(crate) mod codec;
pub mod expect;
pub mod plan;
pub mod saved;
pub mod select;

use actucheck_spec::Spec;
use actucheck_spec::model::{Citation, Level, Packet};
use actucheck_spec::wire::dynamixel2::reference::{self, Call};

use self::check::{Check, Demand};
use self::plan::Plan;
use crate::adapter::{Called, Output, Question, Wire};

/// What decides which checks there are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// The wire.
    pub wire: Wire,
    /// What the generated checks grow from.
    pub seed: u64,
    /// How many packets are generated.
    pub cases: u32,
    /// Bytes of the longest bodies of the pattern's bytes that are all tried inside every kind of
    /// packet, at most [`Options::LONGEST_BODY`]; a byte more means four times as many.
    pub body_length: u32,
    /// The same of bodies without a packet around them.
    pub bare_length: u32,
    /// Bytes of the longest frame that the implementation says it takes.
    pub max_packet: Option<usize>,
}

impl Options {
    /// Bytes of the longest bodies that are tried at all.
    pub const LONGEST_BODY: u32 = 7;

    /// The checks of a wire as they are without further options. Bare bodies are long enough for two
    /// patterns in a row, at which a published library fails.
    #[must_use]
    pub const fn new(wire: Wire) -> Self {
        let (body_length, bare_length) = (4, Self::LONGEST_BODY);
        Self { wire, seed: 1, cases: 1000, body_length, bare_length, max_packet: None }
    }

    /// The same with all bodies of at most so many bytes, inside of packets and without.
    #[must_use]
    pub const fn with_bodies(self, length: u32) -> Self {
        Self { body_length: length, bare_length: length, ..self }
    }
}

/// Every check, in a fixed order.
#[must_use]
pub fn plan<'a>(spec: &'a Spec, options: &Options) -> Plan<'a> {
    let author = Author { spec, wire: options.wire };
    Plan::new(codec::families(author, options))
}

/// Writes checks about one wire.
#[derive(Clone, Copy)]
pub(crate) struct Author<'a> {
    pub(crate) spec: &'a Spec,
    pub(crate) wire: Wire,
}

impl Author<'_> {
    pub(crate) fn check(
        &self,
        id: String,
        requirement: &str,
        question: Question,
        demand: Demand,
    ) -> Check {
        let row = self.spec.requirement(requirement);
        Check {
            id,
            requirement: requirement.to_owned(),
            // A test holds every requirement that is named to be there.
            level: row.map_or(Level::Must, |row| row.level),
            source: row.map_or_else(unknown, |row| row.source.clone()),
            requires: None,
            question,
            demand,
        }
    }

    /// Encode and decode of one packet, as the reference has it.
    fn both_ways(&self, id: &str, requirement: &str, packet: &Packet) -> Vec<Check> {
        let Some(bytes) = reference::encode(packet) else { return Vec::new() };
        let called = Called { call: Call::of(packet), packet: packet.clone() };
        let encode = Question::Encode { wire: self.wire, packet: called };
        let decode = Question::Decode {
            wire: self.wire,
            bytes: bytes.clone().into(),
            fast: None,
            kind: None,
        };
        let (bytes, packet) = (Output::Bytes(bytes.into()), Output::Packet(packet.clone()));
        vec![
            self.check(format!("{id}/encode"), requirement, encode, Demand::Yield(bytes)),
            self.check(
                format!("{id}/decode"),
                of_reading(requirement),
                decode,
                Demand::Yield(packet),
            ),
        ]
    }

    /// A frame that the reference rejects, or the packet that it is.
    fn decoded(&self, id: String, requirement: &str, bytes: Vec<u8>) -> Check {
        let demand = match reference::decode(&bytes) {
            Ok(packet) => Demand::Yield(Output::Packet(packet)),
            Err(fault) => Demand::Reject(fault),
        };
        let op = Question::Decode { wire: self.wire, bytes: bytes.into(), fast: None, kind: None };
        self.check(id, requirement, op, demand)
    }

    /// The packets of a stream as the reference finds them.
    fn streamed(&self, id: String, requirement: &str, chunks: &[Vec<u8>]) -> Check {
        let packets = reference::packets(&chunks.concat());
        let chunks = chunks.iter().map(|chunk| chunk.clone().into()).collect();
        let op = Question::Stream { wire: self.wire, chunks, kind: None };
        self.check(id, requirement, op, Demand::Yield(Output::Packets(packets)))
    }
}

/// The requirement on a reader that answers one on a sender.
fn of_reading(requirement: &str) -> &str {
    match requirement {
        "dynamixel2.stuffing.transmit" => "dynamixel2.stuffing.receive",
        other => other,
    }
}

fn unknown() -> Citation {
    Citation { document: String::new(), section: String::new() }
}

/// Hex digits for an id; `empty` for no bytes.
fn hex(bytes: &[u8]) -> String {
    match bytes {
        [] => "empty".to_owned(),
        bytes => bytes.iter().map(|byte| format!("{byte:02x}")).collect::<Vec<_>>().concat(),
    }
}

/// The requirement on an instruction's parameters: `dynamixel2.sync-read.parameters`.
pub(crate) fn parameters_of(spec: &Spec, name: &str) -> String {
    let name = name.to_lowercase().replace(' ', "-");
    let name = if name == "control-table-backup" { "backup".to_owned() } else { name };
    let ids = ["dynamixel2", "ja40"].map(|document| format!("{document}.{name}.parameters"));
    ids.into_iter()
        .find(|id| spec.requirement(id).is_some())
        .unwrap_or_else(|| "dynamixel2.packet.parameters".to_owned())
}
