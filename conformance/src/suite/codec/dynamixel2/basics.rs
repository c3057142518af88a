//! The basic checks of DYNAMIXEL Protocol 2.0: the smallest packet for each sentence.
//!
//! Instruction packets and status packets have checks of their own, as a library may do with only
//! one of the two.

mod frames;
mod rows;

use std::sync::LazyLock;

use actucheck_spec::model::Fault;
use actucheck_spec::wire::dynamixel2::reference::{self, HEADER, PATTERN};
use actucheck_spec::wire::dynamixel2::{Packet, WIRE};
use actucheck_spec::wire::{self, Direction};

use self::frames::{May, body, frames};
use self::rows::{Has, Row, blocks, fast, fields, instructions, long, of_word, plain};
use crate::adapter::{Output, Question};
use crate::suite::basics::{About, Basic, Basics, Wrong};
use crate::suite::changed;
use crate::suite::check::Demand;

const TRANSMIT: &str = "dynamixel2.stuffing.transmit";
const RECEIVE: &str = "dynamixel2.stuffing.receive";

/// All of them, the most basic first.
pub(in crate::suite::codec) fn all() -> &'static [Basic] {
    static ALL: LazyLock<Vec<Basic>> = LazyLock::new(write);
    &ALL
}

fn write() -> Vec<Basic> {
    let mut basics = Basics::of(WIRE);
    crc(&mut basics);
    for (row, other) in plain() {
        plainly(&mut basics, &row, &other);
    }
    for row in fields() {
        both_ways(&mut basics, &row);
    }
    stuffing(&mut basics);
    for row in blocks().into_iter().chain(long()).chain(instructions()).chain(fast()) {
        both_ways(&mut basics, &row);
    }
    basics.finish()
}

/// The CRC of one byte, by hand: 0x01 × x^16 leaves the polynomial itself.
fn crc(basics: &mut Basics) {
    let question = Question::Crc { wire: WIRE, bytes: vec![0x01].into() };
    let demand = Demand::Yield(Output::Crc(0x8005));
    basics.add(("one-byte", "crc"), "dynamixel2.crc.value", question, demand, |about| {
        !matches!(about.question, Question::Stuff { .. } | Question::Unstuff { .. })
    });
}

/// Whether a packet is of the row's kind and has what the row is about.
fn has(row: &Row) -> impl Fn(&wire::Packet) -> bool + Send + Sync + use<> {
    let (kind, has) = (std::mem::discriminant(&row.packet), row.has);
    move |packet| {
        let wire::Packet::Dynamixel2(packet) = packet else { return false };
        std::mem::discriminant(packet) == kind
            && match has {
                Has::Packet(has) => has(packet),
                Has::Body(has) => has(&body(packet)),
            }
    }
}

/// What everything rests on: a packet built, read and found, its byte order, and what is no packet.
/// Its CRC is the same in both byte orders, that of the other packet is not.
fn plainly(basics: &mut Basics, row: &Row, other: &Packet) {
    let packet = row.packet.clone().into();
    let direction = WIRE.direction(&packet);
    let built = frames(&row.packet, May::LengthAndCrc);
    basics.built(&row.name, row.sent, &packet, built, has(row));
    basics.read(&row.name, row.read, &packet, has(row));
    streams(basics, row, direction);
    let order = "dynamixel2.packet.length.byte-order";
    let built = frames(&row.packet, May::Crc);
    basics.built(&row.sibling("length-order"), order, &packet, built, has(row));
    let (name, order) = (row.sibling("crc-order"), "dynamixel2.crc.byte-order");
    let packet = other.clone().into();
    basics.built(&name, order, &packet, frames(other, May::Nothing), has(row));
    basics.read(&name, order, &packet, has(row));
    wrong(basics, row, direction);
}

/// A name, the requirement, the chunks, and whether a check of a stream rests on it.
type Scenario = (&'static str, &'static str, Vec<Vec<u8>>, fn(&About<'_>) -> bool);

/// The packet in streams.
fn streams(basics: &mut Basics, row: &Row, direction: Direction) {
    let frame = reference::encode(&row.packet).unwrap_or_default();
    let (head, tail) = frame.split_at(frame.len() / 2);
    // One byte longer: a receiver may read a whole status packet before it looks at the length.
    let mut bad = reference::frame(1, &[body(&row.packet).as_slice(), &[0x00]].concat());
    bad.iter_mut().last().into_iter().for_each(|byte| *byte ^= 1);
    let finds = "dynamixel2.receive.stream";
    let scenarios: [Scenario; 6] = [
        ("stream", finds, vec![frame.clone()], |_| true),
        ("two-chunks", finds, vec![head.to_vec(), tail.to_vec()], |about| about.chunks().len() > 1),
        ("two-packets", finds, vec![frame.repeat(2)], |about| about.packets.len() > 1),
        ("noise-before", finds, vec![[&[0, 0], frame.as_slice()].concat()], has_other_bytes),
        (
            "stuffed-header-before",
            "dynamixel2.receive.header.stuffed",
            vec![[&[0xFF, 0xFF, 0xFD, 0xFD], frame.as_slice()].concat()],
            |about| {
                has_other_bytes(about) && has_pattern(&stream(about), &[0xFF, 0xFF, 0xFD, 0xFD])
            },
        ),
        ("wrong-crc-before", finds, vec![[bad.as_slice(), &frame].concat()], |about| {
            let headers = stream(about).windows(4).filter(|window| *window == HEADER).count();
            headers > about.packets.len()
        }),
    ];
    for (name, requirement, chunks, concerns) in scenarios {
        let is_own = has(row);
        basics.found((&row.name, name), requirement, direction, chunks, move |about| {
            matches!(about.question, Question::Stream { .. })
                && about.packets.iter().any(|packet| is_own(packet))
                && concerns(about)
        });
    }
}

fn stream(about: &About<'_>) -> Vec<u8> {
    about.chunks().iter().flat_map(|chunk| chunk.0.clone()).collect()
}

/// Whether a stream has bytes besides its packets.
fn has_other_bytes(about: &About<'_>) -> bool {
    let sizes = about.packets.iter().filter_map(|packet| WIRE.encode(packet));
    stream(about).len() > sizes.map(|frame| frame.len()).sum()
}

/// What is no packet, by each rule of the receive procedure.
fn wrong(basics: &mut Basics, row: &Row, direction: Direction) {
    let frame = reference::encode(&row.packet).unwrap_or_default();
    let last = frame.len().saturating_sub(1);
    let replaced = |at: usize, value: u8| {
        let mut bytes = changed(&frame, at, |_| value);
        reference::repair(&mut bytes);
        bytes
    };
    let bad = changed(&frame, last, |byte| byte ^ 1);
    let short = frame.get(..last).unwrap_or_default().to_vec();
    // Of a wrong header, whether its first three bytes are right.
    let cases: [Wrong; 4] = [
        (
            "wrong-header",
            "dynamixel2.receive.header",
            replaced(0, 0xFE),
            Fault::Header,
            Some(false),
        ),
        ("wrong-reserved", "dynamixel2.packet.reserved", replaced(3, 1), Fault::Header, Some(true)),
        ("wrong-crc", "dynamixel2.receive.crc", bad, Fault::Crc, None),
        ("cut-short", "dynamixel2.receive.length", short, Fault::Truncated, None),
    ];
    for (what, requirement, bytes, fault, begins) in cases {
        let name = row.sibling(what);
        basics.rejected((&name, fault), requirement, direction, bytes, move |about| {
            let Question::Decode { bytes, context, .. } = about.question else { return false };
            context.direction == Some(direction)
                && about.fault == Some(fault)
                && begins.is_none_or(|begins| begins == bytes.starts_with(&PATTERN))
        });
    }
}

/// A packet built, read alone, and found in a stream.
fn both_ways(basics: &mut Basics, row: &Row) {
    let built = frames(&row.packet, May::Nothing);
    basics.built(&row.name, row.sent, &row.packet.clone().into(), built, has(row));
    read(basics, row);
}

fn read(basics: &mut Basics, row: &Row) {
    let packet = row.packet.clone().into();
    basics.read(&row.name, row.read, &packet, has(row));
    // A stream does not say which request a fast status packet answers.
    if !matches!(row.packet, Packet::FastStatus { .. }) {
        basics.streamed(&row.name, row.found, &packet, has(row));
    }
}

/// A name, a body, and whether another body has the same.
type Word = (&'static str, &'static [u8], fn(&[u8]) -> bool);

/// What a body may have that byte stuffing is about, in its smallest form.
const WORDS: [Word; 5] = [
    ("stuffing", &PATTERN, |body| has_pattern(body, &PATTERN)),
    ("stuffing-twice", &[0xFF, 0xFF, 0xFD, 0xFF, 0xFF, 0xFD], |body| {
        body.windows(3).filter(|window| *window == PATTERN).count() > 1
    }),
    ("stuffing-before-fd", &[0xFF, 0xFF, 0xFD, 0xFD], |body| {
        has_pattern(body, &[0xFF, 0xFF, 0xFD, 0xFD])
    }),
    ("stuffing-behind-ff", &[0xFF, 0xFF, 0xFF, 0xFD], |body| {
        has_pattern(body, &[0xFF, 0xFF, 0xFF, 0xFD])
    }),
    ("nothing-to-stuff", &[0xFF, 0xFD, 0xFD], |body| {
        has_pattern(body, &[0xFF, 0xFD, 0xFD]) && !has_pattern(body, &PATTERN)
    }),
];

fn has_pattern(bytes: &[u8], pattern: &[u8]) -> bool {
    bytes.windows(pattern.len()).any(|window| window == pattern)
}

/// Byte stuffing: alone, in an instruction packet, and in a status packet.
fn stuffing(basics: &mut Basics) {
    for (place, (what, word, has)) in WORDS.into_iter().enumerate() {
        alone(basics, what, word, has);
        for row in of_word(what, word, has) {
            if place == 0 {
                stuffed(basics, &row);
                read(basics, &row);
            } else {
                both_ways(basics, &row);
            }
        }
    }
}

/// The stuffing itself, then the length, then the CRC.
fn stuffed(basics: &mut Basics, row: &Row) {
    let packet = row.packet.clone().into();
    for (name, requirement, may) in [
        (row.name.clone(), row.sent, May::LengthAndCrc),
        (row.sibling("stuffing-length"), "dynamixel2.stuffing.length", May::Crc),
        (row.sibling("stuffing-crc"), "dynamixel2.stuffing.crc", May::Nothing),
    ] {
        basics.built(&name, requirement, &packet, frames(&row.packet, may), has(row));
    }
}

/// A body without a packet around it.
fn alone(basics: &mut Basics, what: &str, word: &[u8], has: fn(&[u8]) -> bool) {
    let name = format!("{what}.body");
    let (plain, stuffed) = (word.to_vec(), reference::stuff(word));
    let bytes = |bytes: &[u8]| bytes.to_vec().into();
    let question = Question::Stuff { wire: WIRE, bytes: bytes(&plain) };
    let demand = Demand::Yield(Output::Bytes(bytes(&stuffed)));
    basics.add((&name, "stuff"), TRANSMIT, question, demand, move |about| match about.question {
        Question::Stuff { bytes, .. } => has(bytes),
        Question::Encode { .. } => bodies(about).any(|body| has(&body)),
        _ => false,
    });
    let question = Question::Unstuff { wire: WIRE, bytes: bytes(&stuffed) };
    let demand = Demand::Yield(Output::Bytes(bytes(&plain)));
    basics.add((&name, "unstuff"), RECEIVE, question, demand, move |about| match about.question {
        Question::Unstuff { bytes, .. } => reference::unstuff(bytes).is_ok_and(|body| has(&body)),
        _ => about.reads() && bodies(about).any(|body| has(&body)),
    });
}

fn bodies(about: &About<'_>) -> impl Iterator<Item = Vec<u8>> {
    about.packets.iter().filter_map(|packet| {
        let wire::Packet::Dynamixel2(packet) = packet else { return None };
        Some(body(packet))
    })
}
