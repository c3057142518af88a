//! Probes: questions in parts, which can be generated, damaged and made smaller.

use std::collections::BTreeSet;

use actucheck_spec::Spec;
use actucheck_spec::model::{Fault, HexBytes};
use actucheck_spec::wire::{Context, Direction, Packet, Wire};
use proptest::collection::vec;
use proptest::prelude::{BoxedStrategy, Just, Strategy, any};
use proptest::prop_oneof;
use proptest::sample::select;
use proptest::strategy::Union;

use super::ask::Request;
use super::payload::payload;
use super::talk::Talk;
use super::topic::Topic;
use super::wire::{self, Probes};
use crate::adapter::{Hello, Limits, Output, Permissions, Question};
use crate::suite::Author;
use crate::suite::check::{Check, Demand};
use crate::suite::device::{Target, conversation};
use crate::suite::random::data;

/// Bytes that headers, ends and byte stuffing are made of, and those at the ends of their range.
const TELLING: [u8; 8] = [0x00, 0x01, 0x55, 0xED, 0xEE, 0xFD, 0xFE, 0xFF];

/// A question before it becomes a check.
#[derive(Clone, Debug)]
pub(super) enum Probe {
    Crc(Vec<u8>),
    Stuff(Vec<u8>),
    /// A body whose stuffing is to be removed.
    Unstuff(Vec<u8>),
    Encode(Packet),
    /// A frame, with damage.
    Decode(Packet, Vec<Damage>),
    /// A stream, with the places where it is cut, in units of 1/65,536 of its length.
    Stream(Vec<Part>, Vec<u16>),
    Converse(Talk),
    /// Requests to a device.
    Ask(Vec<Request>),
}

/// A part of a stream: noise, then a frame with damage.
#[derive(Clone, Debug)]
pub(super) struct Part {
    pub(super) noise: Vec<u8>,
    pub(super) packet: Packet,
    pub(super) damage: Vec<Damage>,
}

/// A damage to a frame at a [`place`].
#[derive(Clone, Copy, Debug)]
pub(super) enum Damage {
    Flip(u16, u8),
    Set(u16, u8),
    Cut(u16),
    Insert(u16, u8),
    /// One or several bytes are missing.
    Remove(u16, u8),
    /// Two bytes in a row are this one.
    Pair(u16, u8),
    /// Two neighbours are the other way round.
    Swap(u16),
    /// The CRC is recomputed, so that the code after the CRC check is reached.
    Repair,
    /// The request that the frame answers names another device at this place.
    Device(u16, u8),
    /// It names one more device at this place.
    More(u16, u8),
    /// It names the device at this place and the next one in the other order.
    Order(u16),
    /// It is read as if it went the other way, where frames do not state their direction.
    Turn,
}

/// Generates probes, mostly one and sometimes several that are best asked in a row, for all ops
/// that `hello` offers on a wire; `None` if it offers none.
pub(super) fn strategy(
    spec: &Spec,
    wire: Wire,
    hello: &Hello,
) -> Option<BoxedStrategy<Vec<Probe>>> {
    if !hello.wires.iter().any(|offered| offered == wire.id()) {
        return None;
    }
    let probes = wire::of(wire)?;
    let limits = &hello.limits;
    let packet = || (probes.packet)(spec, limits);
    let bytes = || payload(0, limits);
    let damage = || prop_oneof![1 => Just(Vec::new()), 2 => damages()];
    let stream = |direction| {
        let part = || part(probes, spec, limits, direction);
        let parts = prop_oneof![
            8 => vec(part(), 1..6),
            1 => vec(part(), 6..45),
            1 => (part(), vec(any::<bool>(), 2..9)).prop_map(repeated),
        ];
        let cuts = prop_oneof![1 => Just(Vec::new()), 3 => vec(any::<u16>(), 1..8)];
        (parts, cuts).prop_map(|(parts, cuts)| Probe::Stream(parts, cuts)).prop_map(alone).boxed()
    };
    let decoded = (packet(), damage()).prop_map(|(packet, damage)| Probe::Decode(packet, damage));
    let all = [
        ("crc", 1, bytes().prop_map(Probe::Crc).prop_map(alone).boxed()),
        ("stuff", 2, bytes().prop_map(Probe::Stuff).prop_map(alone).boxed()),
        ("unstuff", 2, bytes().prop_map(Probe::Unstuff).prop_map(alone).boxed()),
        ("encode", 5, packet().prop_map(Probe::Encode).prop_map(alone).boxed()),
        ("decode", 5, decoded.prop_map(alone).boxed()),
        ("decode", 1, (packet(), damage()).prop_map(behind_damage).boxed()),
        ("encode", 1, (packet(), packet()).prop_map(long_and_short).boxed()),
        ("stream", 4, stream(Direction::Reply)),
        ("stream", 2, stream(Direction::Request)),
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

/// Generates requests to a device.
pub(super) fn requests(
    author: Author<'_>,
    target: &Target<'_>,
    allowed: &Permissions,
) -> Option<BoxedStrategy<Vec<Probe>>> {
    let requests = (wire::of(author.wire)?.requests?)(author, target, allowed);
    Some(requests.prop_map(Probe::Ask).prop_map(alone).boxed())
}

/// Generates conversations for a host with these calls; `None` if it offers no such wire.
pub(super) fn conversations(
    spec: &Spec,
    wire: Wire,
    hello: &Hello,
) -> Option<BoxedStrategy<Vec<Probe>>> {
    if !hello.wires.iter().any(|offered| offered == wire.id()) {
        return None;
    }
    let talk = (wire::of(wire)?.host?.talk)(spec, hello)?;
    Some(talk.prop_map(Probe::Converse).prop_map(alone).boxed())
}

fn alone(probe: Probe) -> Vec<Probe> {
    vec![probe]
}

/// The same packet again and again, sometimes with a wrong CRC.
fn repeated((part, is_wrong): (Part, Vec<bool>)) -> Vec<Part> {
    let wrong = vec![Damage::Flip(u16::MAX, 0)];
    let part = |is_wrong| Part {
        damage: if is_wrong { wrong.clone() } else { Vec::new() },
        ..part.clone()
    };
    is_wrong.into_iter().map(part).collect()
}

/// What a damaged frame leaves behind must not affect the next one.
fn behind_damage((packet, damage): (Packet, Vec<Damage>)) -> Vec<Probe> {
    vec![Probe::Decode(packet.clone(), damage), Probe::Decode(packet, Vec::new())]
}

/// Nor what the longer of two packets leaves behind in a buffer.
fn long_and_short((one, other): (Packet, Packet)) -> Vec<Probe> {
    let size = |packet: &Packet| -> usize {
        packet.wire().payload(packet).iter().map(|bytes| bytes.len()).sum()
    };
    let (long, short) = if size(&one) < size(&other) { (other, one) } else { (one, other) };
    vec![Probe::Encode(long), Probe::Encode(short)]
}

fn part(probes: Probes, spec: &Spec, limits: &Limits, direction: Direction) -> BoxedStrategy<Part> {
    let damage = prop_oneof![4 => Just(Vec::new()), 1 => damages()];
    (noise(probes), (probes.streamed)(spec, limits, direction), damage)
        .prop_map(|(noise, packet, damage)| Part { noise, packet, damage })
        .boxed()
}

fn noise(probes: Probes) -> BoxedStrategy<Vec<u8>> {
    prop_oneof![4 => Just(Vec::new()), 2 => data(0..6), 2 => (probes.noise)()].boxed()
}

/// Several damages, one that the CRC does not show, or a byte after the frame.
pub(super) fn damages() -> impl Strategy<Value = Vec<Damage>> {
    let hidden = damage().prop_map(|damage| vec![damage, Damage::Repair]);
    let front = (FROM_FRONT..FROM_FRONT + 8, select(&TELLING[..]))
        .prop_map(|(at, byte)| vec![Damage::Set(at, byte), Damage::Repair]);
    let behind = any::<u8>().prop_map(|byte| vec![Damage::Insert(u16::MAX, byte)]);
    prop_oneof![6 => vec(damage(), 1..4), 6 => hidden, 3 => front, 1 => behind]
}

fn damage() -> impl Strategy<Value = Damage> {
    let byte = || prop_oneof![1 => select(&TELLING[..]), 1 => any::<u8>()];
    prop_oneof![
        4 => Just(Damage::Repair),
        4 => (any_place(), 0..8_u8).prop_map(|(at, bit)| Damage::Flip(at, bit)),
        4 => (any_place(), byte()).prop_map(|(at, byte)| Damage::Set(at, byte)),
        2 => any_place().prop_map(Damage::Cut),
        2 => (any_place(), byte()).prop_map(|(at, byte)| Damage::Insert(at, byte)),
        3 => (any_place(), 1..=3_u8).prop_map(|(at, count)| Damage::Remove(at, count)),
        3 => (any_place(), prop_oneof![Just(0), byte()]).prop_map(|(at, byte)| Damage::Pair(at, byte)),
        2 => any_place().prop_map(Damage::Swap),
        1 => (any_place(), 0..=252_u8).prop_map(|(at, id)| Damage::Device(at, id)),
        1 => (any_place(), 0..=252_u8).prop_map(|(at, id)| Damage::More(at, id)),
        1 => any_place().prop_map(Damage::Order),
        1 => Just(Damage::Turn),
    ]
}

/// From here on, places count from the front, where wires have their header.
const FROM_FRONT: u16 = 0xFFE0;
/// From here on, places count from the end.
const FROM_END: u16 = 0xFFF0;

/// A place among so many: a fraction of them, or counted from the front or from the end.
fn place(at: u16, length: usize) -> usize {
    match at {
        ..FROM_FRONT => usize::from(at) * length / usize::from(FROM_FRONT),
        FROM_FRONT..FROM_END => usize::from(at - FROM_FRONT),
        FROM_END.. => length.saturating_sub(1 + usize::from(u16::MAX - at)),
    }
}

/// Any place; those at the end, where most wires have their CRC, more often.
fn any_place() -> impl Strategy<Value = u16> {
    prop_oneof![2 => any::<u16>(), 1 => u16::MAX - 4..=u16::MAX]
}

const fn turn(direction: Direction) -> Direction {
    match direction {
        Direction::Request => Direction::Reply,
        Direction::Reply => Direction::Request,
    }
}

impl Damage {
    fn happen(self, wire: Wire, frame: &mut Vec<u8>, context: &mut Context) {
        let ids = context.fast.as_mut().map(|fast| &mut fast.ids);
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
            Self::Insert(at, byte) => {
                frame.insert(place(at, frame.len() + 1).min(frame.len()), byte);
            }
            Self::Remove(at, count) => {
                let at = place(at, frame.len()).min(frame.len());
                frame.drain(at..(at + usize::from(count)).min(frame.len()));
            }
            Self::Pair(at, value) => {
                let at = place(at, frame.len());
                frame.iter_mut().skip(at).take(2).for_each(|byte| *byte = value);
            }
            Self::Swap(at) => {
                let at = place(at, frame.len());
                if at + 1 < frame.len() {
                    frame.swap(at, at + 1);
                }
            }
            Self::Repair => wire.repair(frame),
            Self::Device(at, id) => {
                if let Some(ids) = ids.filter(|ids| !ids.contains(&id)) {
                    let at = place(at, ids.len());
                    ids.get_mut(at).into_iter().for_each(|slot| *slot = id);
                }
            }
            Self::More(at, id) => {
                if let Some(ids) = ids.filter(|ids| !ids.contains(&id)) {
                    ids.insert(place(at, ids.len() + 1).min(ids.len()), id);
                }
            }
            Self::Turn => {
                let turned = context.direction.filter(|_| !wire.tells_direction()).map(turn);
                context.direction = turned.or(context.direction);
            }
            Self::Order(at) => {
                if let Some(ids) = ids.filter(|ids| ids.len() > 1) {
                    let at = place(at, ids.len() - 1).min(ids.len() - 2);
                    ids.swap(at, at + 1);
                }
            }
        }
    }
}

impl Probe {
    /// The check of this probe, of this device if it asks one; `None` if the documents leave the right
    /// answer unspecified.
    pub(super) fn check(
        &self,
        author: &Author<'_>,
        (hello, device): (&Hello, Option<(&Target<'_>, &Permissions)>),
        id: String,
    ) -> Option<Check> {
        if let Self::Ask(requests) = self {
            let pieces: Vec<_> = requests.iter().map(Request::pieces).collect::<Option<_>>()?;
            let (requirement, question, demand) = conversation(*author, device?, &pieces)?;
            return Some(author.check(id, &requirement, question, demand));
        }
        let probes = wire::of(author.wire)?;
        let (requirement, question, demand) = (probes.question)(author, self)?;
        let (requirement, demand) = match within(hello, &question, &demand) {
            Within::Limit => (requirement, demand),
            Within::Refused(demand) => (probes.limit.to_owned(), demand),
            Within::Unspecified => return None,
        };
        Some(author.check(id, &requirement, question, demand))
    }

    /// Each beginning of a conversation, and the whole as the last one; any other probe as it is.
    pub(super) fn beginnings(self) -> Vec<Self> {
        match self {
            Self::Converse(talk) => talk.beginnings().map(Self::Converse).collect(),
            Self::Ask(requests) => {
                let first = |count| requests.iter().take(count).cloned().collect();
                (1..=requests.len()).map(first).map(Self::Ask).collect()
            }
            probe => vec![probe],
        }
    }

    /// What the probe is about; several topics if it makes several calls.
    pub(super) fn topics(&self, spec: &Spec, wire: Wire) -> Vec<Topic> {
        let name = |packet: &Packet| wire::of(wire).map(|probes| (probes.name)(spec, packet));
        let (op, packet) = match self {
            Self::Crc(_) => ("crc", None),
            Self::Stuff(_) => ("stuff", None),
            Self::Unstuff(_) => ("unstuff", None),
            Self::Encode(packet) => ("encode", name(packet)),
            Self::Decode(packet, damage) => {
                let turns = damage.iter().filter(|damage| matches!(damage, Damage::Turn)).count();
                let turned = !wire.tells_direction() && turns % 2 == 1;
                let how = if turned { " that is read the other way" } else { "" };
                ("decode", name(packet).map(|name| name + how))
            }
            Self::Stream(parts, _) => {
                let direction = parts.first().map(|part| part.packet.direction());
                ("stream", direction.map(|direction| direction.to_string()))
            }
            Self::Ask(requests) => {
                let parts = requests.iter().flat_map(|request| &request.parts);
                let names = parts.filter_map(|part| name(&part.packet));
                let topics: BTreeSet<_> =
                    names.map(|packet| Topic { op: "device", packet }).collect();
                return topics.into_iter().collect();
            }
            Self::Converse(talk) => {
                let names = talk.exchanges.iter().filter_map(|exchange| name(&exchange.packet));
                let topics: BTreeSet<_> =
                    names.map(|packet| Topic { op: "call", packet }).collect();
                return topics.into_iter().collect();
            }
        };
        vec![Topic { op, packet: packet.unwrap_or_default() }]
    }
}

/// What the limits of an adapter make of a question.
enum Within {
    /// The packets are no longer than the limit.
    Limit,
    /// A longer packet is refused.
    Refused(Demand),
    /// Nothing is said of it.
    Unspecified,
}

/// A packet that is longer than the adapter's limit must be refused, and not be found in a stream
/// that has nothing else. Version 1 of the adapter protocol does not say so.
fn within(hello: &Hello, question: &Question, demand: &Demand) -> Within {
    let (receive, send) = (hello.limits.receive(), hello.limits.send());
    let longer = |size: usize, limit: Option<usize>| limit.is_some_and(|limit| size > limit);
    let (is_longer, refused) = match (question, demand) {
        (Question::Decode { bytes, .. }, Demand::Yield(_)) => {
            (longer(bytes.len(), receive), Some(Demand::Reject(Fault::Oversize)))
        }
        (Question::Encode { .. }, Demand::Yield(Output::Bytes(bytes))) => {
            (longer(bytes.len(), send), Some(Demand::Reject(Fault::Oversize)))
        }
        (Question::Stream { wire, chunks, direction }, Demand::Yield(Output::Packets(packets))) => {
            let sizes = packets.iter().filter_map(|packet| Some(wire.encode(packet)?.len()));
            let longest = sizes.max().unwrap_or_default();
            let stream: Vec<u8> = chunks.iter().flat_map(|chunk| chunk.0.clone()).collect();
            let behind = stream.get(1..).unwrap_or_default().to_vec().into();
            let is_alone = stream.len() == longest && wire.stream(&[behind], *direction).is_empty();
            let nothing = Demand::Yield(Output::Packets(Vec::new()));
            (longer(longest, receive), is_alone.then_some(nothing))
        }
        _ => (false, None),
    };
    match refused {
        _ if !is_longer => Within::Limit,
        Some(demand) if hello.protocol > 1 => Within::Refused(demand),
        _ => Within::Unspecified,
    }
}

/// The frame of a packet after the damage, and the facts that a reader of it is told.
pub(super) fn damaged(packet: &Packet, damage: &[Damage]) -> Option<(Vec<u8>, Context)> {
    let wire = packet.wire();
    let (mut frame, mut context) = (wire.encode(packet)?, packet.context());
    for damage in damage {
        damage.happen(wire, &mut frame, &mut context);
    }
    Some((frame, context))
}

pub(super) fn joined(parts: &[Part]) -> Option<Vec<u8>> {
    let mut stream = Vec::new();
    for Part { noise, packet, damage } in parts {
        stream.extend(noise);
        stream.extend(damaged(packet, damage)?.0);
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
