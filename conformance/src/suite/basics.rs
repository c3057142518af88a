//! Basic checks: each tests one sentence of the documents with the smallest packet.
//!
//! A fault of a library shows in many checks. So that one requirement is accused of it, every other
//! check rests on the basic checks that concern what it is about: a check that finds a stuffed
//! packet in chunks rests on those of a plain packet, of byte stuffing and of chunks. If one of
//! them failed, a failure of the check is charged to it.

use actucheck_spec::model::{Fault, HexBytes};
use actucheck_spec::wire::{Context, Direction, Packet};

use super::Author;
use super::check::{Check, Demand};
use super::plan::Family;
use crate::adapter::{Called, Output, Question, Wire};

/// What the ids of basic checks have after the wire's id.
const WORD: &str = ".basic.";

/// A check of one sentence.
pub(crate) struct Basic {
    pub(crate) id: String,
    requirement: &'static str,
    /// An earlier check of the same packet.
    requires: Option<String>,
    pub(super) question: Question,
    pub(super) demand: Demand,
    /// Whether a check of this rests on it.
    pub(crate) concerns: Concerns,
}

/// Whether something concerns what a check is about.
type Concerns = Box<dyn Fn(&About<'_>) -> bool + Send + Sync>;

/// What a check is about.
pub(crate) struct About<'a> {
    pub(crate) question: &'a Question,
    /// The packet to build, or the packets to read.
    pub(crate) packets: Vec<&'a Packet>,
    /// Why the bytes to read must be rejected.
    pub(crate) fault: Option<Fault>,
}

impl<'a> About<'a> {
    /// `expected` is the answer that is demanded, if it is not a rejection.
    pub(crate) fn new(question: &'a Question, expected: Option<&'a Output>) -> Self {
        let packets = match (question, expected) {
            (Question::Encode { packet, .. }, _) => vec![&packet.packet],
            (_, Some(Output::Packet(packet))) => vec![packet],
            (_, Some(Output::Packets(packets))) => packets.iter().collect(),
            _ => Vec::new(),
        };
        let fault = match question {
            Question::Decode { wire, bytes, context } if expected.is_none() => {
                wire.decode(bytes, context).err()
            }
            _ => None,
        };
        Self { question, packets, fault }
    }

    /// Whether a packet is read, alone or in a stream.
    pub(crate) const fn reads(&self) -> bool {
        matches!(self.question, Question::Decode { .. } | Question::Stream { .. })
    }

    /// The chunks of a stream.
    pub(crate) fn chunks(&self) -> &[HexBytes] {
        match self.question {
            Question::Stream { chunks, .. } => chunks,
            _ => &[],
        }
    }
}

/// Whether this is the id of a basic check.
pub(crate) fn is_basic(id: &str) -> bool {
    id.contains(WORD)
}

/// The family of a wire's basic checks.
pub(crate) fn family<'a>(author: Author<'a>, basics: &'static [Basic]) -> Family<'a> {
    let prefix = format!("{}{WORD}", author.wire.id());
    Family::of(prefix, move || basics.iter().map(|basic| basic.check(&author)).collect())
}

impl Basic {
    fn check(&self, author: &Author<'_>) -> Check {
        let (question, demand) = (self.question.clone(), self.demand.clone());
        let check = author.check(self.id.clone(), self.requirement, question, demand);
        Check { requires: self.requires.clone(), ..check }
    }
}

/// Bytes that are rejected: name, requirement, bytes and fault, and what tells this fault from others
/// of its class, if there are any.
pub(crate) type Wrong = (&'static str, &'static str, Vec<u8>, Fault, Option<bool>);

/// Writes the basic checks of a wire, the most basic first.
pub(crate) struct Basics {
    wire: Wire,
    list: Vec<Basic>,
}

impl Basics {
    pub(crate) const fn of(wire: Wire) -> Self {
        Self { wire, list: Vec::new() }
    }

    pub(crate) fn finish(self) -> Vec<Basic> {
        self.list
    }

    /// A check, and whether another check rests on it. A library that does not read a packet alone
    /// finds it in no stream.
    pub(crate) fn add(
        &mut self,
        (packet, name): (&str, &str),
        requirement: &'static str,
        question: Question,
        demand: Demand,
        concerns: impl Fn(&About<'_>) -> bool + Send + Sync + 'static,
    ) {
        let stem = format!("{}{WORD}{packet}", self.wire.id());
        let alone = format!("{stem}/decode");
        let is_stream = matches!(question, Question::Stream { .. });
        let requires = is_stream && self.list.iter().any(|basic| basic.id == alone);
        self.list.push(Basic {
            id: format!("{stem}/{name}"),
            requirement,
            requires: requires.then_some(alone),
            question,
            demand,
            concerns: Box::new(concerns),
        });
    }

    /// The packet is built, as one of these frames.
    pub(crate) fn built(
        &mut self,
        name: &str,
        requirement: &'static str,
        packet: &Packet,
        frames: Vec<Vec<u8>>,
        has: impl Fn(&Packet) -> bool + Send + Sync + 'static,
    ) {
        let question = Question::Encode { wire: self.wire, packet: Called::from(packet.clone()) };
        let frames = frames.into_iter().map(|frame| Output::Bytes(frame.into())).collect();
        let demand = Demand::YieldOneOf(frames);
        self.add((name, "encode"), requirement, question, demand, move |about| {
            matches!(about.question, Question::Encode { .. })
                && about.packets.iter().any(|packet| has(packet))
        });
    }

    /// The packet is read.
    pub(crate) fn read(
        &mut self,
        name: &str,
        requirement: &'static str,
        packet: &Packet,
        has: impl Fn(&Packet) -> bool + Send + Sync + 'static,
    ) {
        let frame = self.wire.encode(packet).unwrap_or_default();
        let (bytes, context) = (frame.into(), packet.context());
        let question = Question::Decode { wire: self.wire, bytes, context };
        let demand = Demand::Yield(Output::Packet(packet.clone()));
        self.add((name, "decode"), requirement, question, demand, move |about| {
            about.reads() && about.packets.iter().any(|packet| has(packet))
        });
    }

    /// The bytes are rejected for this fault, as the reference model does. A test compares them.
    pub(crate) fn rejected(
        &mut self,
        (name, fault): (&str, Fault),
        requirement: &'static str,
        direction: Direction,
        bytes: Vec<u8>,
        concerns: impl Fn(&About<'_>) -> bool + Send + Sync + 'static,
    ) {
        let context = Context::from(direction);
        let question = Question::Decode { wire: self.wire, bytes: bytes.into(), context };
        self.add((name, "decode"), requirement, question, Demand::Reject(fault), concerns);
    }

    /// The packet is found in a stream.
    pub(crate) fn streamed(
        &mut self,
        name: &str,
        requirement: &'static str,
        packet: &Packet,
        has: impl Fn(&Packet) -> bool + Send + Sync + 'static,
    ) {
        let (direction, chunk) = (packet.direction(), self.wire.encode(packet).unwrap_or_default());
        self.found((name, "stream"), requirement, direction, vec![chunk], move |about| {
            matches!(about.question, Question::Stream { .. })
                && about.packets.iter().any(|packet| has(packet))
        });
    }

    /// The valid packets of the chunks are found.
    pub(crate) fn found(
        &mut self,
        name: (&str, &str),
        requirement: &'static str,
        direction: Direction,
        chunks: Vec<Vec<u8>>,
        concerns: impl Fn(&About<'_>) -> bool + Send + Sync + 'static,
    ) {
        let chunks: Vec<HexBytes> = chunks.into_iter().map(HexBytes::from).collect();
        let packets = self.wire.stream(&chunks, Some(direction));
        let question = Question::Stream { wire: self.wire, chunks, direction: Some(direction) };
        let demand = Demand::Yield(Output::Packets(packets));
        self.add(name, requirement, question, demand, concerns);
    }
}
