//! The checks: their sources, what their answers must be, and files of checks.
//!
//! The right answer of a test vector is printed in a document; the right answers of the other
//! checks come from the wire's reference model. Ids are permanent: an id names the question, not
//! its place in the list.

pub(crate) mod basics;
pub mod check;
pub(crate) mod codec;
pub mod device;
pub mod due;
pub mod expect;
pub(crate) mod host;
pub mod partition;
pub mod plan;
pub(crate) mod random;
pub mod saved;
pub mod select;
pub mod wanted;

use std::borrow::Cow;

use actucheck_spec::Spec;
use actucheck_spec::model::{self, Citation, Level};
use actucheck_spec::wire::{Context, Direction};

use self::check::{Check, Demand};
use self::device::{Neighbour, Target};
use self::plan::Plan;
use crate::adapter::{Limits, Output, Question, Wire};

/// The options that determine the checks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// The seed of the generated checks.
    pub seed: u64,
    /// The number of generated packets.
    pub cases: u32,
    /// The most bytes in the bodies of the pattern's bytes that are all tried, alone and inside every
    /// kind of packet, up to [`Options::LONGEST_BODY`]. Each further byte means four times as many
    /// checks.
    pub body_length: u32,
    /// The limits that the subject states.
    pub limits: Limits,
}

impl Options {
    /// The longest body in bytes that is tried at all.
    pub const LONGEST_BODY: u32 = 7;

    /// The default options.
    #[must_use]
    pub const fn new() -> Self {
        let limits = Limits { max_packet: None, max_send: None, max_receive: None };
        Self { seed: 1, cases: 1000, body_length: 4, limits }
    }

    /// The same with all bodies up to this many bytes, inside packets and alone.
    #[must_use]
    pub const fn with_bodies(self, length: u32) -> Self {
        Self { body_length: length, ..self }
    }

    /// The same with every kind of check that others have.
    #[must_use]
    pub fn widest(self) -> Self {
        let limits = Limits { max_packet: Some(1000), max_send: None, max_receive: None };
        let cases = self.cases.max(100);
        Self { cases, body_length: Self::LONGEST_BODY, limits, ..self }
    }
}

impl Default for Options {
    fn default() -> Self {
        Self::new()
    }
}

/// Every check of these wires, in a fixed order.
#[must_use]
pub fn plan<'a>(spec: &'a Spec, wires: &[Wire], options: &Options) -> Plan<'a> {
    let families = |wire: &Wire| codec::families(Author { spec, wire: *wire }, options);
    Plan::new(wires.iter().flat_map(families).collect())
}

/// Every check of a host on these wires, in a fixed order.
#[must_use]
pub fn host_plan<'a>(spec: &'a Spec, wires: &[Wire]) -> Plan<'a> {
    let families = |wire: &Wire| host::families(Author { spec, wire: *wire });
    Plan::new(wires.iter().flat_map(families).collect())
}

/// Every check of a device on these wires, in a fixed order.
#[must_use]
pub fn device_plan<'a>(spec: &'a Spec, wires: &[Wire], target: &Target<'a>) -> Plan<'a> {
    let families = |wire: &Wire| device::families(Author { spec, wire: *wire }, target);
    Plan::new(wires.iter().flat_map(families).collect())
}

/// Every check of a device of the spec on these wires: those of each device in turn, on a line with a
/// neighbour; and on a wire without control tables those of one device. A check that several devices
/// have comes several times.
#[must_use]
pub fn every_device_plan<'a>(spec: &'a Spec, wires: &[Wire]) -> Plan<'a> {
    let devices = spec.devices.iter().map(|file| &file.content);
    let devices = devices.filter(|device| wires.contains(&device.wire));
    let plan = |device: &'a model::Device| {
        // What nobody else may hear is asked of a device that is alone.
        let neighbour = Some(Neighbour { id: 2, device: Some(device) });
        let target = Target { neighbour, ..Target::alone(Some(device)) };
        device_plan(spec, &[device.wire], &target)
    };
    let others = wires.iter().filter(|wire| !device::has_tables(**wire));
    let others = others
        .map(|wire| device_plan(spec, &[*wire], &Target::alone(None).with_neighbour(2, None)));
    devices.map(plan).chain(others).fold(Plan::new(Vec::new()), Plan::and)
}

/// The ids of the basic checks that the answer to a question rests on, the most basic first.
/// `expected` is the answer that is demanded, if it is not a rejection.
pub(crate) fn rests_on<'a>(
    question: &'a Question,
    expected: Option<&'a Output>,
) -> Box<dyn Iterator<Item = Cow<'static, str>> + 'a> {
    match question {
        Question::Converse { wire, steps } => Box::new(host::rests_on(*wire, steps)),
        Question::Device { wire, steps, .. } => Box::new(device::rests_on(*wire, steps)),
        question => Box::new(codec::rests_on(question, expected)),
    }
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
            // A test checks that every named requirement exists.
            level: row.map_or(Level::Must, |row| row.level),
            source: row.map_or_else(unknown, |row| row.source.clone()),
            requires: None,
            question,
            demand,
        }
    }

    /// Decodes a frame; the reference model says whether it is a packet.
    fn decoded(
        &self,
        id: String,
        requirement: &str,
        context: impl Into<Context>,
        bytes: Vec<u8>,
    ) -> Check {
        let context = context.into();
        let demand = match self.wire.decode(&bytes, &context) {
            Ok(packet) => Demand::Yield(Output::Packet(packet)),
            Err(fault) => Demand::Reject(fault),
        };
        let op = Question::Decode { wire: self.wire, bytes: bytes.into(), context };
        self.check(id, requirement, op, demand)
    }

    /// The packets of a stream that the reference model finds.
    fn streamed(
        &self,
        id: String,
        requirement: &str,
        direction: Direction,
        chunks: &[Vec<u8>],
    ) -> Check {
        let chunks: Vec<_> = chunks.iter().map(|chunk| chunk.clone().into()).collect();
        let packets = self.wire.stream(&chunks, Some(direction));
        let op = Question::Stream { wire: self.wire, chunks, direction: Some(direction) };
        self.check(id, requirement, op, Demand::Yield(Output::Packets(packets)))
    }
}

fn unknown() -> Citation {
    Citation { document: String::new(), section: String::new() }
}

/// The bytes with the one at a place changed.
fn changed(bytes: &[u8], at: usize, change: impl FnOnce(u8) -> u8) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    if let Some(byte) = bytes.get_mut(at) {
        *byte = change(*byte);
    }
    bytes
}

/// Bytes as hex digits for an id; `empty` for no bytes.
fn hex(bytes: &[u8]) -> String {
    if bytes.is_empty() {
        return "empty".to_owned();
    }
    let digit = |value: u8| char::from_digit(value.into(), 16).unwrap_or_default();
    bytes.iter().flat_map(|byte| [digit(byte >> 4), digit(byte & 15)]).collect()
}
