//! Follows a stream: its packets, the bytes between them, who asks and who answers.
//!
//! A wire has two parts here. `Split` finds its frames, and `Converse` knows what a frame is in
//! the conversation. [`Follower`] knows where and when each byte was.

mod devices;
pub mod lines;
mod summary;

use std::collections::VecDeque;
use std::time::Duration;

use actucheck_spec::wire::{Context, Direction, Wire};

pub use devices::Devices;
pub use summary::{Answers, Summary};

use super::mistake::{self, Fit};
use super::{Asked, Own, Row, WIRES, Warning, damaged};
use crate::device::Tables;

/// The next bytes of a stream.
pub(super) enum Cut<'a> {
    /// A frame, and its direction if it is known.
    Frame(&'a [u8], Option<Direction>),
    /// Bytes that belong to no frame: how many, the first of them, and why.
    Skipped(u64, &'a [u8], String),
}

/// Finds the frames of a stream. Every byte is in one cut.
pub(super) trait Split {
    /// Takes bytes, and hands on the cuts that they complete.
    fn feed(&mut self, bytes: &[u8], direction: Option<Direction>, take: &mut dyn FnMut(Cut<'_>));

    /// No frame goes on after the bytes that were fed.
    fn pause(&mut self, take: &mut dyn FnMut(Cut<'_>));
}

/// Knows what frames are in a conversation.
pub(super) trait Converse {
    /// Fills in what this frame is after those before it.
    fn hear(&mut self, heard: &Heard<'_>, turn: &mut Turn);

    /// What is wrong with bytes that are no frame, as sentences.
    fn skipped(&mut self, _bytes: &[u8]) -> Vec<String> {
        Vec::new()
    }

    /// The control tables that are known so far.
    fn tables(&self) -> Tables {
        Tables::default()
    }

    /// Who did not answer the last request.
    fn end(&mut self) -> Option<Silent> {
        None
    }
}

/// What a wire has for streams.
pub(super) type Listen = fn(Tables) -> (Box<dyn Split>, Box<dyn Converse>);

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
    parts: Parts,
    split: Box<dyn Split>,
    direction: Option<Direction>,
}

struct Parts {
    converse: Box<dyn Converse>,
    /// Bytes before the next event.
    at: u64,
    fed: u64,
    /// The pieces from the next event on: where each ends, its line and its time.
    pieces: VecDeque<(u64, Option<u64>, Option<Duration>)>,
}

impl Follower {
    /// Follows a wire, with the control tables that are known before. `None` for a wire whose streams
    /// are not followed.
    #[must_use]
    pub fn new(wire: Wire, tables: Tables) -> Option<Self> {
        let (split, converse) = (Own::of(wire)?.listen)(tables);
        let parts = Parts { converse, at: 0, fed: 0, pieces: VecDeque::new() };
        Some(Self { parts, split, direction: None })
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
        let Self { parts, split, .. } = self;
        parts.fed += bytes.len() as u64;
        parts.remember(line, time);
        split.feed(bytes, direction, &mut |cut| parts.next(cut, direction, take));
    }

    /// How many bytes were fed.
    #[must_use]
    pub const fn fed(&self) -> u64 {
        self.parts.fed
    }

    /// No packet goes on after the bytes so far.
    pub fn pause(&mut self, take: &mut dyn FnMut(Event<'_>)) {
        let Self { parts, split, direction } = self;
        split.pause(&mut |cut| parts.next(cut, *direction, take));
    }

    /// Ends the stream.
    pub fn end(&mut self, take: &mut dyn FnMut(Event<'_>)) {
        self.pause(take);
        if let Some(silent) = self.parts.converse.end() {
            take(Event::Silent(silent));
        }
    }
}

/// Longer than any packet: of skipped bytes before it, only the first have a place.
const LONGEST: u64 = 128 << 10;

impl Parts {
    /// Takes the line and the time of the bytes that were fed last.
    fn remember(&mut self, line: Option<u64>, time: Option<Duration>) {
        self.pieces.push_back((self.fed, line, time));
        while self.pieces.get(1).is_some_and(|(end, ..)| end + LONGEST < self.fed) {
            self.pieces.remove(1);
        }
    }

    fn next(
        &mut self,
        cut: Cut<'_>,
        direction: Option<Direction>,
        take: &mut dyn FnMut(Event<'_>),
    ) {
        let place = self.place();
        match cut {
            Cut::Frame(bytes, found) => {
                self.at += bytes.len() as u64;
                let direction = direction.or(found);
                let heard = Heard { bytes, place, end: self.time_of_last(), direction };
                let mut turn = Turn::default();
                self.converse.hear(&heard, &mut turn);
                turn.tables = self.converse.tables();
                if let Some(silent) = turn.silent.take() {
                    take(Event::Silent(silent));
                }
                take(Event::Packet(heard, &turn));
            }
            Cut::Skipped(count, bytes, reason) => {
                self.at += count;
                let notes = self.converse.skipped(bytes);
                take(Event::Skipped(Skipped {
                    place,
                    context: Context { fast: None, direction },
                    address: None,
                    count,
                    bytes,
                    reason,
                    notes,
                    tables: &self.converse.tables(),
                }));
            }
        }
    }

    /// The place of the next byte.
    fn place(&mut self) -> Place {
        while self.pieces.len() > 1 && self.pieces.front().is_some_and(|(end, ..)| *end <= self.at)
        {
            self.pieces.pop_front();
        }
        let (_, line, time) = self.pieces.front().copied().unwrap_or_default();
        Place { at: self.at, line, time }
    }

    /// The time of the byte before the next one.
    fn time_of_last(&self) -> Option<Duration> {
        let piece = self.pieces.iter().find(|(end, ..)| *end >= self.at);
        piece.and_then(|(_, _, time)| *time)
    }
}

/// The wire that a stream seems to be of: the one with most frames in its beginning.
#[must_use]
pub fn wire_of(pieces: &[(Vec<u8>, Option<Direction>)]) -> Wire {
    // Of equals the first is the default.
    let found = WIRES.into_iter().map(|own| (framed(own.listen, pieces), own.wire));
    found.rev().max_by_key(|(bytes, _)| *bytes).map_or_else(Wire::default, |(_, wire)| wire)
}

/// Whether some bytes have a frame of any wire.
pub(crate) fn has_frame(bytes: &[u8]) -> bool {
    WIRES.into_iter().any(|own| framed(own.listen, &[(bytes.to_vec(), None)]) > 0)
}

/// How many bytes are in frames.
fn framed(listen: Listen, pieces: &[(Vec<u8>, Option<Direction>)]) -> u64 {
    let (mut split, _) = listen(Tables::default());
    let mut bytes = 0_u64;
    let mut count = |cut: Cut<'_>| {
        if let Cut::Frame(frame, _) = cut {
            bytes += frame.len() as u64;
        }
    };
    for (piece, direction) in pieces {
        split.feed(piece, *direction, &mut count);
    }
    split.pause(&mut count);
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_noise_in_many_lines_is_not_remembered_line_by_line() {
        let mut follower =
            Follower::new(Wire::default(), Tables::default()).expect("the default is followed");
        for line in 1..=400_000 {
            follower.feed(&[0], None, Some(line), None, &mut |_| {});
        }
        assert!(follower.parts.pieces.len() < 200_000, "{}", follower.parts.pieces.len());
        let mut places = Vec::new();
        follower.feed(
            b"\xFF\xFF\xFD\0\x01\x03\0\x01\x19\x4E",
            None,
            Some(400_001),
            None,
            &mut |event| {
                if let Event::Packet(Heard { place, .. }, _)
                | Event::Skipped(Skipped { place, .. }) = event
                {
                    places.push((place.at, place.line));
                }
            },
        );
        assert_eq!(places, [(0, Some(1)), (400_000, Some(400_001))]);
    }
}
