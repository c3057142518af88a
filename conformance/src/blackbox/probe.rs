//! Probes: questions that proptest generates and shrinks.

use actucheck_spec::model::HexBytes;
use actucheck_spec::wire::{Packet, Wire};
use proptest::collection::vec;
use proptest::prelude::{BoxedStrategy, Just, Strategy, any};
use proptest::prop_oneof;
use proptest::strategy::Union;

use super::wire::{self, Probes};
use crate::adapter::Hello;
use crate::suite::Author;
use crate::suite::check::Check;
use crate::suite::random::data;

/// The longest data of a probe, in bytes.
pub(super) const LONGEST: usize = 48;

/// A question before it becomes a check.
#[derive(Clone, Debug)]
pub(super) enum Probe {
    Crc(Vec<u8>),
    Stuff(Vec<u8>),
    /// A body whose stuffing is to be removed.
    Unstuff(Vec<u8>),
    Encode(Named),
    /// A frame, with damage.
    Decode(Named, Vec<Damage>),
    /// Frames with damage and the bytes between them, with the places where the stream is cut, in
    /// units of 1/65,536 of its length.
    Stream(Vec<Part>, Vec<u16>),
}

/// A packet and the name of its instruction.
pub(super) type Named = (&'static str, Packet);

/// A part of a stream: noise, then a frame with damage.
pub(super) type Part = (Vec<u8>, Packet, Vec<Damage>);

/// A damage to a frame. Places are in units of 1/65,536 of its length.
#[derive(Clone, Copy, Debug)]
pub(super) enum Damage {
    Flip(u16, u8),
    Set(u16, u8),
    Cut(u16),
    Insert(u16, u8),
    /// The CRC is recomputed, so that the code after the CRC check is reached.
    Repair,
}

/// Generates probes for all ops that `hello` offers on a wire; `None` if it offers none.
pub(super) fn strategy(wire: Wire, hello: &Hello) -> Option<BoxedStrategy<Probe>> {
    if !hello.wires.iter().any(|offered| offered == wire.id()) {
        return None;
    }
    let probes = wire::of(wire)?;
    let packet = probes.packet;
    let all = [
        ("crc", 1, data(0..LONGEST).prop_map(Probe::Crc).boxed()),
        ("stuff", 2, data(0..LONGEST).prop_map(Probe::Stuff).boxed()),
        ("unstuff", 2, data(0..LONGEST).prop_map(Probe::Unstuff).boxed()),
        ("encode", 4, packet().prop_map(Probe::Encode).boxed()),
        ("decode", 4, (packet(), vec(damage(), 0..3)).prop_map(decode).boxed()),
        ("stream", 3, (vec(part(probes), 1..5), vec(any::<u16>(), 0..6)).prop_map(stream).boxed()),
    ];
    let exists = |op: &str| wire.has_stuffing() || !op.ends_with("stuff");
    let offered = |op: &str| hello.ops.iter().any(|other| other == op);
    let asked: Vec<_> = all
        .into_iter()
        .filter(|(op, _, _)| exists(op) && offered(op))
        .map(|(_, weight, strategy)| (weight, strategy))
        .collect();
    (!asked.is_empty()).then(|| Union::new_weighted(asked).boxed())
}

fn decode((packet, damage): (Named, Vec<Damage>)) -> Probe {
    Probe::Decode(packet, damage)
}

fn stream((parts, cuts): (Vec<Part>, Vec<u16>)) -> Probe {
    Probe::Stream(parts, cuts)
}

fn part(probes: Probes) -> BoxedStrategy<Part> {
    let damage = prop_oneof![3 => Just(Vec::new()), 1 => vec(damage(), 1..3)];
    (data(0..6), (probes.streamed)(), damage).boxed()
}

fn damage() -> impl Strategy<Value = Damage> {
    prop_oneof![
        2 => Just(Damage::Repair),
        2 => (any::<u16>(), 0..8_u8).prop_map(|(at, bit)| Damage::Flip(at, bit)),
        2 => (any::<u16>(), any::<u8>()).prop_map(|(at, byte)| Damage::Set(at, byte)),
        1 => any::<u16>().prop_map(Damage::Cut),
        1 => (any::<u16>(), any::<u8>()).prop_map(|(at, byte)| Damage::Insert(at, byte)),
    ]
}

impl Damage {
    fn happen(self, wire: Wire, frame: &mut Vec<u8>) {
        let place = |at: u16, length: usize| usize::from(at) * length / 65_536;
        match self {
            Self::Flip(at, bit) => {
                let at = place(at, frame.len());
                frame.get_mut(at).into_iter().for_each(|byte| *byte ^= 1 << bit);
            }
            Self::Set(at, value) => {
                let at = place(at, frame.len());
                frame.get_mut(at).into_iter().for_each(|byte| *byte = value);
            }
            Self::Cut(at) => frame.truncate(place(at, frame.len())),
            Self::Insert(at, byte) => frame.insert(place(at, frame.len() + 1), byte),
            Self::Repair => wire.repair(frame),
        }
    }
}

impl Probe {
    /// The check of this probe; `None` if the documents leave the right answer unspecified.
    pub(super) fn check(&self, author: &Author<'_>, id: String) -> Option<Check> {
        let (requirement, op, demand) = (wire::of(author.wire)?.question)(author, self)?;
        Some(author.check(id, &requirement, op, demand))
    }
}

pub(super) fn damaged(wire: Wire, mut frame: Vec<u8>, damage: &[Damage]) -> Vec<u8> {
    for damage in damage {
        damage.happen(wire, &mut frame);
    }
    frame
}

pub(super) fn joined(wire: Wire, parts: &[Part]) -> Option<Vec<u8>> {
    let mut stream = Vec::new();
    for (noise, packet, damage) in parts {
        stream.extend(noise);
        stream.extend(damaged(wire, wire.encode(packet)?, damage));
    }
    Some(stream)
}

/// The stream in chunks.
pub(super) fn cut(stream: &[u8], cuts: &[u16]) -> Vec<HexBytes> {
    let mut places: Vec<_> =
        cuts.iter().map(|cut| usize::from(*cut) * stream.len() / 65_536).collect();
    places.extend([0, stream.len()]);
    places.sort_unstable();
    let pairs = places.iter().zip(places.iter().skip(1));
    pairs.map(|(from, to)| stream.get(*from..*to).unwrap_or_default().to_vec().into()).collect()
}
