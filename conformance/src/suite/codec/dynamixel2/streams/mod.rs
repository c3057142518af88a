//! Streams: packets one after the other, with and without other bytes between them, cut into chunks
//! in several ways.
//!
//! - known: the first scenarios, each cut at every place;
//! - many: many packets, packets of many sizes, and long packets;
//! - patterns: packets with byte stuffing, whole and cut at their front;
//! - echo: what a host has sent, before the answer;
//! - noise: bytes of headers and damaged packets between good ones;
//! - resume: bytes that claim a length, where the search has to go on inside that length.

mod echo;
mod known;
mod many;
mod noise;
mod patterns;
mod resume;

use actucheck_spec::wire::Direction;
use actucheck_spec::wire::dynamixel2::{Packet, reference};

pub(super) use self::resume::resumed;
use super::kind::Kind;
use crate::adapter::{Output, Question};
use crate::suite::check::{Check, Demand};
use crate::suite::plan::{Family, Group};
use crate::suite::{Author, Options};

/// The requirement that packets are found.
const FOUND: &str = "dynamixel2.receive.stream";

pub(super) fn families<'a>(author: Author<'a>, options: &Options) -> Vec<Family<'a>> {
    let longest = options.limits.receive();
    let of = |part: &str, scenarios: fn() -> Vec<Scenario>| {
        Family::new(format!("dynamixel2.stream.{part}."), move || {
            scenarios().into_iter().map(move |scenario| scenario.group(author))
        })
    };
    vec![
        known::family(author),
        of("many", many::many),
        of("mixed", many::mixed),
        Family::new("dynamixel2.stream.long.", move || {
            many::long(longest).into_iter().map(move |scenario| scenario.group(author))
        }),
        of("pattern", patterns::whole),
        of("stuffed-header", patterns::stuffed_headers),
        of("stuffed-cut", patterns::cut_at_front),
        echo::family(author),
        of("noise", noise::between),
        of("damaged", noise::damaged),
        of("resume", resume::claims),
        resume::family(author),
    ]
}

/// What a host receives, and what a device receives.
const KINDS: [Kind; 2] = [Kind::Status, Kind::Write];

/// A part of a stream.
enum Part {
    /// A packet, which must be found.
    Packet(Packet),
    /// Bytes that are no packet.
    Other(Vec<u8>),
}

impl Part {
    fn bytes(&self) -> Vec<u8> {
        match self {
            Self::Packet(packet) => frame(packet),
            Self::Other(bytes) => bytes.clone(),
        }
    }
}

/// The bytes of a packet.
fn frame(packet: &Packet) -> Vec<u8> {
    reference::encode(packet).unwrap_or_default()
}

/// How a stream is cut into chunks.
#[derive(Clone, Copy)]
enum Cut {
    /// Not at all.
    Whole,
    /// Between its parts.
    ByPart,
    /// Every so many bytes.
    Every(usize),
    /// In two at this byte.
    At(usize),
}

impl Cut {
    fn name(self) -> String {
        match self {
            Self::Whole => "whole".to_owned(),
            Self::ByPart => "by-part".to_owned(),
            Self::Every(1) => "bytewise".to_owned(),
            Self::Every(size) => format!("chunks-of-{size}"),
            Self::At(place) => format!("split-at-{place}"),
        }
    }

    fn chunks(self, parts: &[Vec<u8>]) -> Vec<Vec<u8>> {
        let whole = parts.concat();
        match self {
            Self::Whole => vec![whole],
            Self::ByPart => parts.to_vec(),
            Self::Every(size) => whole.chunks(size).map(<[u8]>::to_vec).collect(),
            Self::At(place) => {
                let (head, tail) = whole.split_at_checked(place).unwrap_or_default();
                vec![head.to_vec(), tail.to_vec()]
            }
        }
    }
}

/// A stream that is asked in several ways.
struct Scenario {
    /// The rest of its checks' ids, after `dynamixel2.stream.`.
    name: String,
    requirement: &'static str,
    parts: Box<dyn Fn() -> Vec<Part> + Send>,
    /// How it is cut, beside [`Cut::Whole`].
    cuts: &'static [Cut],
    /// Whether it is cut at each place too.
    everywhere: bool,
}

impl Scenario {
    fn new(
        name: String,
        requirement: &'static str,
        cuts: &'static [Cut],
        parts: impl Fn() -> Vec<Part> + Send + 'static,
    ) -> Self {
        Self { name, requirement, parts: Box::new(parts), cuts, everywhere: false }
    }

    /// The same, cut at each place too if `everywhere`.
    fn cut_everywhere(self, everywhere: bool) -> Self {
        Self { everywhere, ..self }
    }

    /// How the stream is cut, the simplest way first.
    fn all_cuts(&self) -> Vec<Cut> {
        let places = if self.everywhere {
            1..(self.parts)().iter().map(|part| part.bytes().len()).sum()
        } else {
            0..0
        };
        let cuts = self.cuts.iter().copied();
        [Cut::Whole].into_iter().chain(cuts).chain(places.map(Cut::At)).collect()
    }

    /// Its longest packet read alone, then the stream in each way. Who can't read the packet is not
    /// asked to find it, and who does not find it in one chunk is not asked about many.
    fn group(self, author: Author<'_>) -> Group<'_> {
        let cuts = self.all_cuts();
        let names = cuts.iter().map(|cut| cut.name());
        let names = ["decode".to_owned()].into_iter().chain(names).collect();
        let stem = format!("dynamixel2.stream.{}/", self.name);
        Group::named(stem, names, move |stem| self.checks(&author, stem, &cuts))
    }

    fn checks(&self, author: &Author<'_>, stem: &str, cuts: &[Cut]) -> Vec<Check> {
        let parts = (self.parts)();
        let frames: Vec<_> = parts.iter().map(Part::bytes).collect();
        let packets = parts.iter().zip(&frames).filter_map(|(part, frame)| match part {
            Part::Packet(packet) => Some((packet, frame)),
            Part::Other(_) => None,
        });
        let longest = packets.clone().max_by_key(|(_, frame)| frame.len());
        let Some((packet, frame)) = longest else { return Vec::new() };
        let direction = author.wire.direction(&packet.clone().into());
        let packets: Vec<_> = packets.map(|(packet, _)| packet.clone().into()).collect();
        let demand = Demand::Yield(Output::Packets(packets));
        let mut checks = vec![decoded(author, format!("{stem}decode"), packet, frame)];
        for cut in cuts {
            let id = format!("{stem}{}", cut.name());
            let required = if matches!(cut, Cut::Whole) { "decode" } else { "whole" };
            let question = question(author, direction, &cut.chunks(&frames));
            let check = author.check(id, self.requirement, question, demand.clone());
            checks.push(Check { requires: Some(format!("{stem}{required}")), ..check });
        }
        checks
    }
}

/// Reads one packet.
fn decoded(author: &Author<'_>, id: String, packet: &Packet, frame: &[u8]) -> Check {
    let context = author.wire.context(&packet.clone().into());
    let body = frame.get(reference::PREFIX..frame.len().saturating_sub(2)).unwrap_or_default();
    let is_stuffed = reference::unstuff(body).is_ok_and(|plain| plain.len() < body.len());
    let requirement = match packet {
        // The high byte of its length is not 0.
        _ if frame.len() > reference::PREFIX + 0xFF => "dynamixel2.packet.length",
        _ if is_stuffed => "dynamixel2.stuffing.receive",
        Packet::Instruction { .. } => "dynamixel2.packet.layout",
        _ => "dynamixel2.status-packet.layout",
    };
    let question = Question::Decode { wire: author.wire, bytes: frame.to_vec().into(), context };
    let packet = Output::Packet(packet.clone().into());
    author.check(id, requirement, question, Demand::Yield(packet))
}

fn question(author: &Author<'_>, direction: Direction, chunks: &[Vec<u8>]) -> Question {
    let chunks = chunks.iter().map(|chunk| chunk.clone().into()).collect();
    Question::Stream { wire: author.wire, chunks, direction: Some(direction) }
}
