//! Checks of the INNFOS Ethernet protocol: the test vectors, exhaustive checks of small sets, and
//! frames that break one rule each.

use actucheck_spec::model::{Citation, Fault, Outcome, Vector};
use actucheck_spec::wire::innfos::{self, reference};
use actucheck_spec::wire::{Direction, Packet};

use super::dynamixel2::golden::{demand, way};
use crate::adapter::{Output, Question};
use crate::suite::check::{Check, Demand, Unspecified, Way};
use crate::suite::plan::{Family, Group};
use crate::suite::{Author, Options, hex};

/// Bytes that could be mistaken for the first or last byte of a frame, and two others.
const ALPHABET: [u8; 4] = [0xEE, 0xED, 0x00, 0x01];
/// Sizes of data: those of the commands, and those where the length needs its second byte.
const SIZES: [usize; 10] = [0, 1, 2, 3, 4, 8, 255, 256, 257, 1000];

/// The most data, in bytes, that a length allows, and the bytes of a frame around it.
const LARGEST: usize = 65_535;
const AROUND: usize = 8;

/// What a packet's checks are called.
const NAMES: [&str; 3] = ["/encode", "/decode", "/stream-twice"];

pub(super) fn families<'a>(author: Author<'a>, options: &Options) -> Vec<Family<'a>> {
    let largest = options.max_packet.and_then(|limit| limit.checked_sub(AROUND));
    let largest = largest.map(|size| size.min(LARGEST)).filter(|size| !SIZES.contains(size));
    let sizes: Vec<_> = SIZES.into_iter().chain(largest).collect();
    let mut families = vec![Family::of("", move || golden(&author))];
    for kind in [Direction::Request, Direction::Reply] {
        let sizes = sizes.clone();
        families.extend([
            family(author, kind, "address", || {
                (0..=u8::MAX).map(|byte| (format!("{byte:02x}"), Sent::new(byte, 0x06, &[1, 2])))
            }),
            family(author, kind, "command", || {
                (0..=u8::MAX).map(|byte| (format!("{byte:02x}"), Sent::new(1, byte, &[1, 2])))
            }),
            family(author, kind, "size", move || {
                let sent = |size: usize| (size.to_string(), Sent::new(6, 0x2A, &vec![0x5A; size]));
                sizes.clone().into_iter().map(sent)
            }),
            family(author, kind, "data", || {
                (0..=4).flat_map(words).map(|data| (hex(&data), Sent::new(6, 0x0A, &data)))
            }),
            Family::of(format!("innfos.negative.{kind}."), move || damaged(&author, kind)),
            Family::of("innfos.negative.", move || other_way(&author, kind)),
            Family::of(format!("innfos.open.{kind}."), move || behind_damage(&author, kind)),
        ]);
    }
    families
}

/// The fields of a packet that goes either way.
struct Sent {
    address: u8,
    command: u8,
    data: Vec<u8>,
}

impl Sent {
    fn new(address: u8, command: u8, data: &[u8]) -> Self {
        Self { address, command, data: data.to_vec() }
    }
}

/// Packets that are built, read, and found twice in a datagram, each with its name.
fn family<'a, I>(
    author: Author<'a>,
    kind: Direction,
    what: &'static str,
    packets: impl Fn() -> I + Send + Sync + 'a,
) -> Family<'a>
where
    I: Iterator<Item = (String, Sent)> + Send + 'a,
{
    let prefix = format!("innfos.{kind}.{what}.");
    Family::new(prefix.clone(), move || {
        let prefix = prefix.clone();
        packets().map(move |(name, Sent { address, command, data })| {
            let id = format!("{prefix}{name}");
            Group::new(id, &NAMES, move |id| both_ways(&author, id, kind, address, command, &data))
        })
    })
}

fn words(length: u32) -> impl Iterator<Item = Vec<u8>> {
    (0..4_usize.pow(length)).map(move |number| {
        let letters = (0..length).map(|place| number / 4_usize.pow(place) % 4);
        letters.filter_map(|letter| ALPHABET.get(letter).copied()).collect()
    })
}

fn golden(author: &Author<'_>) -> Vec<Check> {
    let vectors = author.spec.vectors().filter(|(file, _)| file.wire == author.wire);
    let vectors: Vec<_> = vectors.map(|(file, vector)| (&file.source, vector)).collect();
    let mut checks = Vec::new();
    for (source, vector) in &vectors {
        let source = vector.source.as_ref().unwrap_or(source);
        let own = vector.requirement.as_deref().unwrap_or("innfos.packets");
        let mut add = |name: &str, requirement: &str, op, demand| {
            let check = author.check(format!("{}/{name}", vector.id), requirement, op, demand);
            checks.push(Check { source: source.clone(), ..check });
        };
        if let Some(packet) = &vector.packet {
            if let Some((op, demand)) = crc(author, packet) {
                add("crc", "innfos.crc.value", op, demand);
            }
            let others = others(vector, packet, &vectors);
            let built = demand(author.spec, vector, frame(vector), others);
            add("encode", own, encode(author, packet), built);
            let read = demand(author.spec, vector, Output::Packet(packet.clone()), Vec::new());
            add("decode", own, decode(author, packet.direction(), vector.frame()), read);
        } else if let (Some(kind), Some(fault)) = (vector.direction, vector.fault) {
            add("decode", own, decode(author, kind, vector.frame()), Demand::Reject(fault));
        }
        if let (Some(printed), Some(fault), Some(packet)) =
            (vector.defective(), vector.printed_fault, &vector.packet)
        {
            let op = decode(author, packet.direction(), printed);
            add("decode-printed", "innfos.defects", op, Demand::Reject(fault));
        }
    }
    checks
}

/// The other valid frames of a packet, if the document has several readings.
fn others(vector: &Vector, packet: &Packet, all: &[(&Citation, &Vector)]) -> Vec<Way> {
    let others = all.iter().map(|(_, other)| *other).filter(|other| {
        other.id != vector.id
            && other.result == Outcome::Acceptable
            && other.packet.as_ref() == Some(packet)
    });
    others.map(|other| way(other, frame(other))).collect()
}

fn frame(vector: &Vector) -> Output {
    Output::Bytes(vector.frame().to_vec().into())
}

/// The CRC of a packet's data.
fn crc(author: &Author<'_>, packet: &Packet) -> Option<(Question, Demand)> {
    let Packet::Innfos(innfos::Packet { data, .. }) = packet else { return None };
    let op = Question::Crc { wire: author.wire, bytes: data.clone() };
    let numbers = author.wire.checksum(data).into_iter().map(Output::Crc);
    (!data.is_empty()).then(|| (op, Demand::YieldOneOf(numbers.collect())))
}

fn encode(author: &Author<'_>, packet: &Packet) -> Question {
    Question::Encode { wire: author.wire, packet: packet.clone().into() }
}

fn decode(author: &Author<'_>, kind: Direction, bytes: &[u8]) -> Question {
    let bytes = bytes.to_vec().into();
    Question::Decode { wire: author.wire, bytes, context: kind.into() }
}

/// A packet that is built, read, and found twice in a datagram. None if its CRC is unspecified.
fn both_ways(
    author: &Author<'_>,
    id: &str,
    kind: Direction,
    address: u8,
    command: u8,
    data: &[u8],
) -> Vec<Check> {
    let requirement = match data.len() {
        0 => "innfos.frame.no-data",
        _ if id.contains(".size.") => "innfos.crc.byte-order",
        _ => "innfos.frame.layout",
    };
    let data = data.to_vec().into();
    let packet = innfos::Packet { direction: kind, address, command, data };
    let Some(frame) = reference::encode(&packet) else { return Vec::new() };
    let chunk = [frame.as_slice(), &frame].concat();
    let stream =
        Question::Stream { wire: author.wire, direction: Some(kind), chunks: vec![chunk.into()] };
    let packet = Packet::from(packet);
    let (once, twice) = (Output::Packet(packet.clone()), vec![packet.clone(), packet.clone()]);
    let built = Demand::Yield(Output::Bytes(frame.clone().into()));
    let read = Demand::Yield(once);
    let found = Demand::Yield(Output::Packets(twice));
    vec![
        author.check(format!("{id}/encode"), requirement, encode(author, &packet), built),
        author.check(format!("{id}/decode"), requirement, decode(author, kind, &frame), read),
        author.check(format!("{id}/stream-twice"), "innfos.frame.transparent", stream, found),
    ]
}

/// A frame with a flipped bit, a missing byte or an extra byte.
fn damaged(author: &Author<'_>, kind: Direction) -> Vec<Check> {
    let packet = example(kind);
    let frame = reference::encode(&packet).unwrap_or_default();
    let mut damaged = Vec::new();
    for at in 0..frame.len() {
        for bit in 0..8 {
            let mut bytes = frame.clone();
            if let Some(byte) = bytes.get_mut(at) {
                *byte ^= 1 << bit;
            }
            damaged.push((format!("flip-{at}-{bit}"), bytes));
        }
        damaged.push((format!("cut-at-{at}"), frame.get(..at).unwrap_or_default().to_vec()));
    }
    damaged.push(("byte-more".to_owned(), [frame.as_slice(), &[0xED]].concat()));
    damaged.push(("byte-before".to_owned(), [&[0x00], frame.as_slice()].concat()));
    let mut checks = Vec::new();
    for (name, bytes) in damaged {
        let id = format!("innfos.negative.{kind}.{name}/decode");
        let (requirement, demand) = match reference::decode(kind, &bytes) {
            // The CRC covers the data alone: a changed address or command is not noticed.
            Ok(packet) => ("innfos.frame.layout", Demand::Yield(Output::Packet(packet.into()))),
            Err(fault) => (requirement_of(fault), Demand::Reject(fault)),
        };
        checks.push(author.check(id, requirement, decode(author, kind, &bytes), demand));
    }
    checks
}

/// A frame read in the other direction: with one byte of data it has an extra CRC or lacks one;
/// with any other number of bytes it is the same in both directions.
fn other_way(author: &Author<'_>, kind: Direction) -> Vec<Check> {
    let (address, command) = (6, 0x0A);
    let check = |size: usize| {
        let data = vec![0x5A; size].into();
        let (word, requirement, direction) = match kind {
            Direction::Request => ("reply-as-request", "innfos.crc.request", Direction::Reply),
            Direction::Reply => ("request-as-reply", "innfos.crc.reply", Direction::Request),
        };
        let packet = innfos::Packet { direction, address, command, data };
        let frame = reference::encode(&packet).unwrap_or_default();
        let demand = match reference::decode(kind, &frame) {
            Ok(packet) => Demand::Yield(Output::Packet(packet.into())),
            Err(fault) => Demand::Reject(fault),
        };
        let id = format!("innfos.negative.{word}.size-{size}/decode");
        author.check(id, requirement, decode(author, kind, &frame), demand)
    };
    (0..=4).map(check).collect()
}

/// A valid frame after other bytes in one datagram, which the document leaves unspecified.
fn behind_damage(author: &Author<'_>, kind: Direction) -> Vec<Check> {
    let packet = example(kind);
    let good = reference::encode(&packet).unwrap_or_default();
    let flipped = |at: usize| {
        let mut frame = good.clone();
        if let Some(byte) = frame.get_mut(at) {
            *byte ^= 1;
        }
        frame
    };
    let cut = good.get(..good.len() - 1).unwrap_or_default().to_vec();
    let scenarios = [
        ("garbage", vec![0x00, 0x01]),
        ("wrong-header", flipped(0)),
        ("wrong-length", flipped(4)),
        ("wrong-crc", flipped(good.len() - 2)),
        ("wrong-tail", flipped(good.len() - 1)),
        ("cut", cut),
    ];
    let check = |(name, damage): (&str, Vec<u8>)| {
        let datagram = [damage, good.clone()].concat();
        let ways = [
            ("it is found", reference::packets_anywhere(kind, &datagram)),
            ("the datagram is dropped from the damage on", reference::packets(kind, &datagram)),
        ];
        let ways = ways
            .map(|(name, packets)| Way { name: name.to_owned(), output: Output::packets(packets) });
        let question = format!(
            "What becomes of a good frame in a datagram behind {}?",
            name.replace('-', " ")
        );
        let open = Unspecified { question, ways: ways.into() };
        let id = format!("innfos.open.{kind}.behind-{name}/stream");
        let chunks = vec![datagram.into()];
        let op = Question::Stream { wire: author.wire, chunks, direction: Some(kind) };
        author.check(id, "innfos.frame.layout", op, Demand::Record(open))
    };
    scenarios.map(check).into()
}

/// A packet with data, to be damaged.
fn example(direction: Direction) -> innfos::Packet {
    let data = vec![0x01, 0x02, 0x03, 0x04].into();
    let command = match direction {
        Direction::Request => 0x0A,
        Direction::Reply => 0x06,
    };
    innfos::Packet { direction, address: 6, command, data }
}

fn requirement_of(fault: Fault) -> &'static str {
    match fault {
        Fault::Header => "innfos.frame.header",
        Fault::Tail => "innfos.frame.tail",
        Fault::Crc => "innfos.crc.verify",
        _ => "innfos.frame.length",
    }
}
