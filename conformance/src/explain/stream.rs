//! Follows a stream: its packets, the bytes between them, who asks and who answers.
//!
//! A wire has two parts here. `Split` finds its frames, and `Converse` knows what a frame is in
//! the conversation. [`Follower`] knows where and when each byte was.

mod devices;
pub mod lines;
mod listen;
mod places;
mod summary;

use std::time::Duration;

use actucheck_spec::wire::{Context, Direction, Wire};

use self::places::Places;

pub use self::devices::Devices;
pub(super) use self::listen::{Converse, Cut, Listener, Split};
pub use self::summary::{Answers, Summary};

use super::mistake::{self, Fit};
use super::{Asked, Own, Row, WIRES, Warning, damaged};
use crate::device::Tables;

/// What a wire has for streams.
pub(super) type Listen = fn(Tables) -> Box<dyn Listener>;

/// Where bytes of a stream are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Place {
    /// How many bytes are before them.
    pub at: u64,
    /// The line of the input, from 1.
    pub line: Option<u64>,
    /// When their first byte was there.
    pub time: Option<Duration>,
}

/// A frame in a stream.
#[derive(Clone, Copy, Debug)]
pub struct Heard<'a> {
    /// Its bytes.
    pub bytes: &'a [u8],
    /// Where it begins.
    pub place: Place,
    /// When its last byte was there.
    pub end: Option<Duration>,
    /// Which way it went, if that is known.
    pub direction: Option<Direction>,
}

/// What a frame is in the conversation.
#[derive(Clone, Debug, Default)]
pub struct Turn {
    /// The word that packets of its kind are counted by.
    pub kind: &'static str,
    /// What it has to do with the other frames.
    pub role: Role,
    /// The device that it is for or from; `None` if that is no single one.
    pub device: Option<u8>,
    /// The control tables of all devices, where they are known.
    pub tables: Tables,
    /// The device's model number, if this frame tells it.
    pub model: Option<u16>,
    /// What reading it takes beside its bytes.
    pub context: Context,
    /// The address at which its data was read.
    pub address: Option<u16>,
    /// What else is known about it, as sentences.
    pub notes: Vec<String>,
    /// What is wrong in its meaning.
    pub warnings: Vec<Warning>,
    /// Whether it is no valid packet after all, as its request tells.
    pub wrong: bool,
    /// Who did not answer the request before this one.
    pub silent: Option<Silent>,
}

/// What a frame has to do with those before it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Role {
    /// It asks.
    Request,
    /// The same bytes as the request before it: a bus with one line for both directions, or the
    /// same request again.
    Echo,
    /// It answers.
    Answer {
        /// Where the request begins.
        to: u64,
        /// The request's name.
        name: &'static str,
        /// The time from the end of the request to the beginning of the answer.
        after: Option<Duration>,
    },
    /// It answers a request that is not in the stream.
    Unasked,
    /// The bytes do not tell whether it asks or answers.
    #[default]
    Unknown,
}

/// Devices that were asked and did not answer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Silent {
    /// Where the request begins.
    pub to: u64,
    /// The request's name.
    pub name: &'static str,
    /// The devices.
    pub devices: Vec<u8>,
}

/// What happens next in a stream.
#[derive(Clone, Debug)]
pub enum Event<'a> {
    /// A packet.
    Packet(Heard<'a>, &'a Turn),
    /// Bytes that are no packet.
    Skipped(Skipped<'a>),
    /// Devices that did not answer.
    Silent(Silent),
}

/// Bytes that are no packet.
#[derive(Clone, Debug)]
pub struct Skipped<'a> {
    /// Where they begin.
    pub place: Place,
    /// What reading them takes beside the bytes, as far as it is known.
    pub context: Context,
    /// The address at which the data of an answer was read, if known.
    pub address: Option<u16>,
    /// How many there are.
    pub count: u64,
    /// The first of them: all, unless there are very many.
    pub bytes: &'a [u8],
    /// Why no packet begins there.
    pub reason: String,
    /// What else is known about them, as sentences.
    pub notes: Vec<String>,
    /// The control tables of all devices, where they are known.
    pub tables: &'a Tables,
}

impl Skipped<'_> {
    /// Their fields as far as they can be read, if they begin like a packet.
    #[must_use]
    pub fn fields(&self, wire: Wire) -> Vec<Row> {
        let Self { bytes, tables, address, .. } = *self;
        damaged(wire, &Asked { bytes, context: self.context.clone(), tables, address })
    }

    /// The mistakes that may explain them, the likeliest first.
    #[must_use]
    pub fn fits(&self, wire: Wire) -> Vec<Fit> {
        let all = self.count == self.bytes.len() as u64;
        if all { mistake::fits(wire, self.bytes, &self.context) } else { Vec::new() }
    }
}

/// Follows a stream of one wire.
pub struct Follower {
    listener: Box<dyn Listener>,
    places: Places,
    direction: Option<Direction>,
}

impl Follower {
    /// Follows a wire, with the control tables that are known before. `None` for a wire whose streams
    /// are not followed.
    #[must_use]
    pub fn new(wire: Wire, tables: Tables) -> Option<Self> {
        let listener = (Own::of(wire)?.listen)(tables);
        Some(Self { listener, places: Places::default(), direction: None })
    }

    /// Takes bytes with their direction, line and time, and hands on what they complete.
    pub fn feed(
        &mut self,
        bytes: &[u8],
        direction: Option<Direction>,
        line: Option<u64>,
        time: Option<Duration>,
        take: &mut dyn FnMut(Event<'_>),
    ) {
        // What went the other way is no part of a packet.
        if direction != self.direction {
            self.pause(take);
            self.direction = direction;
        }
        self.places.feed(bytes.len() as u64, line, time);
        self.listener.feed(bytes, direction, &mut self.places, take);
    }

    /// How many bytes were fed.
    #[must_use]
    pub const fn fed(&self) -> u64 {
        self.places.fed()
    }

    /// No packet goes on after the bytes so far.
    pub fn pause(&mut self, take: &mut dyn FnMut(Event<'_>)) {
        self.listener.pause(self.direction, &mut self.places, take);
    }

    /// Ends the stream.
    pub fn end(&mut self, take: &mut dyn FnMut(Event<'_>)) {
        self.pause(take);
        if let Some(silent) = self.listener.end() {
            take(Event::Silent(silent));
        }
    }
}

/// The wire that a stream seems to be of: the one with most frames in its beginning.
#[must_use]
pub fn wire_of(pieces: &[(Vec<u8>, Option<Direction>)]) -> Wire {
    // Of equals the first is the default.
    let found =
        WIRES.into_iter().map(|own| ((own.listen)(Tables::default()).framed(pieces), own.wire));
    found.rev().max_by_key(|(bytes, _)| *bytes).map_or_else(Wire::default, |(_, wire)| wire)
}

/// Whether some bytes have a frame of any wire.
pub(crate) fn has_frame(bytes: &[u8]) -> bool {
    let pieces = [(bytes.to_vec(), None)];
    WIRES.into_iter().any(|own| (own.listen)(Tables::default()).framed(&pieces) > 0)
}
