//! Exhaustive checks: all short bodies of the pattern's bytes, every instruction, every error byte, and
//! the lengths at which counting goes wrong.

use actucheck_spec::wire::dynamixel2::Packet;
use actucheck_spec::wire::dynamixel2::reference::{self, BROADCAST, PATTERN, STATUS};

use super::kind::REGISTER;
use super::{BACKUP, BOTH_WAYS, CLEAR, recorded};
use crate::adapter::{Output, Question};
use crate::suite::check::{Check, Demand};
use crate::suite::plan::{Family, Group};
use crate::suite::{Author, Options, hex};

/// The bytes of the pattern, the byte that makes it a header, and one other byte.
const ALPHABET: [u8; 4] = [0xFF, 0xFD, 0x00, 0x01];

/// Data lengths around 0, around a register's size, and where the length field needs another bit or
/// byte: the length of a Write is 5 bytes more than its data, and passes 128 and 256 here.
const LENGTHS: [usize; 17] =
    [0, 1, 2, 3, 4, 122, 123, 124, 127, 128, 129, 250, 251, 252, 255, 256, 257];

pub(super) fn families<'a>(author: Author<'a>, options: &Options) -> Vec<Family<'a>> {
    let body_length = options.body_length.min(Options::LONGEST_BODY);
    let mut families = vec![alone(author, body_length)];
    families.extend(PLACES.map(|place| inside(author, place, body_length)));
    families.push(Family::new("dynamixel2.instruction.", move || instructions(author)));
    families.push(Family::new("dynamixel2.error.", move || error_bytes(author)));
    families.push(Family::new("dynamixel2.length.", move || lengths(author)));
    families.push(Family::of("dynamixel2.stuffing.from-", move || before_params(&author)));
    families
}

/// Patterns that begin before the parameters: with the instruction or with the error byte.
fn before_params(author: &Author<'_>) -> Vec<Check> {
    let params = || vec![0xFF, 0xFD].into();
    let instruction = Packet::Instruction { id: 1, instruction: 0xFF, params: params() };
    let status = Packet::Status { id: 1, error: 0xFF, params: params() };
    let requirement = "dynamixel2.stuffing.transmit";
    let first = author.both_ways("dynamixel2.stuffing.from-instruction", requirement, &instruction);
    let second = author.both_ways("dynamixel2.stuffing.from-error", requirement, &status);
    first.into_iter().chain(second).collect()
}

/// Every word of at most this length over the alphabet, the shortest first.
fn words(longest: u32) -> impl Iterator<Item = Vec<u8>> + Send {
    (0..=longest).flat_map(|length| {
        (0..4_usize.pow(length)).map(move |number| {
            let letters = (0..length).map(|place| number / 4_usize.pow(place) % 4);
            letters.filter_map(|letter| ALPHABET.get(letter).copied()).collect()
        })
    })
}

/// Bodies without a packet around them: every short one, and longer ones that have the pattern. A
/// published library fails at what looks like a second one after it.
fn alone(author: Author<'_>, longest: u32) -> Family<'_> {
    const PREFIX: &str = "dynamixel2.stuffing.body.";
    let group = move |body: Vec<u8>| {
        let id = format!("{PREFIX}{}", hex(&body));
        Group::new(id, &["/stuff", "/unstuff"], move |id| {
            let checks = stuffing(&author, id, &body);
            // A body has an instruction.
            if body.is_empty() {
                checks.map(|it| recorded(it, "a body of 0 bytes"))
            } else {
                checks
            }
            .into()
        })
    };
    let is_tried = move |word: &Vec<u8>| {
        let is_short = u32::try_from(word.len()).is_ok_and(|length| length <= longest);
        is_short || word.windows(PATTERN.len()).any(|window| window == PATTERN)
    };
    Family::new(PREFIX, move || words(Options::LONGEST_BODY).filter(is_tried).map(group))
}

fn stuffing(author: &Author<'_>, id: &str, body: &[u8]) -> [Check; 2] {
    let wire = author.wire;
    let stuffed = reference::stuff(body);
    let (plain, stuffed) = (body.to_vec().into(), stuffed.into());
    [
        author.check(
            format!("{id}/stuff"),
            "dynamixel2.stuffing.transmit",
            Question::Stuff { wire, bytes: body.to_vec().into() },
            Demand::Yield(Output::Bytes(Clone::clone(&stuffed))),
        ),
        author.check(
            format!("{id}/unstuff"),
            "dynamixel2.stuffing.receive",
            Question::Unstuff { wire, bytes: stuffed },
            Demand::Yield(Output::Bytes(plain)),
        ),
    ]
}

/// What no document has: each Write writes something.
const NO_DATA: &str = "a Write of 0 bytes";

/// A place in a packet: after the header, in the middle, or before the CRC.
#[derive(Clone, Copy)]
struct Place {
    name: &'static str,
    /// The instruction; `None` for a status packet.
    instruction: Option<u8>,
    /// Bytes before the word, as many as the word has.
    before: fn(u16) -> Vec<u8>,
    after: &'static [u8],
}

const PLACES: [Place; 8] = [
    place("write", Some(0x03), |_| REGISTER.to_vec(), &[]),
    place("write-middle", Some(0x03), |_| REGISTER.to_vec(), &[0x05, 0x06]),
    place("reg-write", Some(0x04), |_| REGISTER.to_vec(), &[]),
    place("status", None, |_| Vec::new(), &[]),
    place("status-middle", None, |_| vec![0x05], &[0x06]),
    place("sync-write", Some(0x83), sync, &[]),
    place("bulk-write", Some(0x93), bulk, &[]),
    place("fast-sync-write", Some(0x8B), sync, &[]),
];

const fn place(
    name: &'static str,
    instruction: Option<u8>,
    before: fn(u16) -> Vec<u8>,
    after: &'static [u8],
) -> Place {
    Place { name, instruction, before, after }
}

/// What a sync instruction has before the data of device 1.
fn sync(size: u16) -> Vec<u8> {
    [REGISTER.as_slice(), &size.to_le_bytes(), &[1]].concat()
}

/// What a bulk instruction has before the data of device 1.
fn bulk(size: u16) -> Vec<u8> {
    [&[1], REGISTER.as_slice(), &size.to_le_bytes()].concat()
}

impl Place {
    fn packet(self, word: &[u8]) -> Packet {
        let before = (self.before)(u16::try_from(word.len()).unwrap_or_default());
        let params = [before.as_slice(), word, self.after].concat().into();
        match self.instruction {
            Some(instruction) => {
                let id = if self.is_to_all() { BROADCAST } else { 1 };
                Packet::Instruction { id, instruction, params }
            }
            None => Packet::Status { id: 1, error: 0, params },
        }
    }

    /// Whether the instruction is for several devices. It has no data of 0 bytes then.
    fn is_to_all(self) -> bool {
        self.instruction.is_some_and(|code| code >= 0x80)
    }

    /// Whether a packet without a word is a Write of nothing.
    fn is_only_data(self) -> bool {
        self.instruction.is_some() && self.after.is_empty()
    }
}

/// The same bytes in one place of a packet.
fn inside(author: Author<'_>, place: Place, longest: u32) -> Family<'_> {
    let prefix = format!("dynamixel2.stuffing.in-{}.", place.name);
    Family::new(prefix.clone(), move || {
        let prefix = prefix.clone();
        words(longest).filter(move |word| !(word.is_empty() && place.is_to_all())).map(
            move |word| {
                let id = format!("{prefix}{}", hex(&word));
                Group::new(id, &["/encode", "/decode", "/stream"], move |id| {
                    let checks = found_in(&author, id, &place.packet(&word));
                    if word.is_empty() && place.is_only_data() {
                        return checks.into_iter().map(|it| recorded(it, NO_DATA)).collect();
                    }
                    checks
                })
            },
        )
    })
}

/// A packet built, read alone, and found in a stream.
fn found_in(author: &Author<'_>, id: &str, packet: &Packet) -> Vec<Check> {
    let mut checks = author.both_ways(id, "dynamixel2.stuffing.transmit", packet);
    let frame = reference::encode(packet).unwrap_or_default();
    checks.push(Check {
        requires: Some(format!("{id}/decode")),
        ..author.streamed(
            format!("{id}/stream"),
            "dynamixel2.receive.stream",
            author.wire.direction(&packet.clone().into()),
            &[frame],
        )
    });
    checks
}

fn instructions(author: Author<'_>) -> impl Iterator<Item = Group<'_>> {
    const NAMES: [&str; 4] = ["/encode", "/decode", "-with-params/encode", "-with-params/decode"];
    let codes = (0..=u8::MAX).filter(|code| *code != STATUS);
    let codes = codes.map(move |code| {
        let id = format!("dynamixel2.instruction.{code:02x}");
        Group::new(id, &NAMES, move |id| instruction(&author, id, code))
    });
    let fitting = FITTING.into_iter().map(move |(code, params)| {
        let id = format!("dynamixel2.instruction.{code:02x}-with-own-params");
        Group::new(id, &BOTH_WAYS, move |id| {
            let to = if code >= 0x80 { BROADCAST } else { 1 };
            let params = params.to_vec().into();
            let packet = Packet::Instruction { id: to, instruction: code, params };
            author.both_ways(id, codes_of(code), &packet)
        })
    });
    codes.chain(fitting)
}

/// Parameters of the instructions that neither 0 nor 3 parameters fit.
const FITTING: [(u8, &[u8]); 10] = [
    (0x02, &[132, 0, 4, 0]),
    (0x06, &[0x01]),
    (0x10, &CLEAR),
    (0x20, &BACKUP),
    (0x82, &[132, 0, 4, 0, 1]),
    (0x83, &[65, 0, 1, 0, 1, 1]),
    (0x8A, &[132, 0, 4, 0, 1]),
    (0x8B, &[65, 0, 1, 0, 1, 1]),
    (0x92, &[1, 132, 0, 4, 0]),
    (0x93, &[1, 65, 0, 1, 0, 1]),
];

/// The requirement that gives an instruction its code.
fn codes_of(code: u8) -> &'static str {
    match code {
        0x20 | 0x8A | 0x8B => "ja40.instruction.codes", // in no table of the DYNAMIXEL document
        _ => "dynamixel2.packet.instruction.codes",
    }
}

/// What no sentence demands to build or to read; `None` if a document has such a packet.
fn unasked(code: u8, params: usize) -> Option<&'static str> {
    match (code, params) {
        (0x01 | 0x05 | 0x08, 0) | (0x03 | 0x04, 3) => None,
        (0x01..=0x06 | 0x08, _) => Some(MISFIT),
        _ if FITTING.iter().any(|(fitting, _)| *fitting == code) => Some(MISFIT),
        _ => Some("an instruction that no document names"),
    }
}

const MISFIT: &str = "an instruction with parameters that do not fit it";

fn instruction(author: &Author<'_>, id: &str, code: u8) -> Vec<Check> {
    let packet = |params: &[u8]| {
        let params = params.to_vec().into();
        Packet::Instruction { id: 1, instruction: code, params }
    };
    let requirement = "dynamixel2.packet.layout";
    let judged = |params: &[u8], check| match unasked(code, params.len()) {
        Some(what) => recorded(check, what),
        None => check,
    };
    let without = author.both_ways(id, codes_of(code), &packet(&[]));
    let without = without.into_iter().map(|check| judged(&[], check));
    let params = [1, 2, 3];
    let with = author.both_ways(&format!("{id}-with-params"), requirement, &packet(&params));
    without.chain(with.into_iter().map(|check| judged(&params, check))).collect()
}

fn error_bytes(author: Author<'_>) -> impl Iterator<Item = Group<'_>> {
    (0..=u8::MAX).map(move |error| {
        let id = format!("dynamixel2.error.{error:02x}");
        Group::new(id, &BOTH_WAYS, move |id| {
            let packet = Packet::Status { id: 1, error, params: vec![0x2A].into() };
            author.both_ways(id, "dynamixel2.status-packet.error.fields", &packet)
        })
    })
}

fn lengths(author: Author<'_>) -> impl Iterator<Item = Group<'_>> {
    const NAMES: [&str; 8] = [
        ".plain.write/encode",
        ".plain.write/decode",
        ".plain.status/encode",
        ".plain.status/decode",
        ".tricky.write/encode",
        ".tricky.write/decode",
        ".tricky.status/encode",
        ".tricky.status/decode",
    ];
    LENGTHS.into_iter().map(move |length| {
        let id = format!("dynamixel2.length.{length}");
        Group::new(id, &NAMES, move |id| of_length(&author, id, length))
    })
}

/// Data of this length: without any pattern, and with nothing but patterns.
fn of_length(author: &Author<'_>, id: &str, length: usize) -> Vec<Check> {
    let plain = vec![0x11; length];
    let tricky: Vec<u8> = [0xFF, 0xFF, 0xFD].into_iter().cycle().take(length).collect();
    let mut checks = Vec::new();
    for (name, data, requirement) in [
        ("plain", plain, "dynamixel2.packet.length"),
        ("tricky", tricky, "dynamixel2.stuffing.length"),
    ] {
        let of_status =
            if name == "plain" { "dynamixel2.packet.length.status" } else { requirement };
        let params = [&REGISTER, data.as_slice()].concat();
        let write = Packet::Instruction { id: 1, instruction: 0x03, params: params.into() };
        let status = Packet::Status { id: 1, error: 0, params: data.into() };
        let writes = author.both_ways(&format!("{id}.{name}.write"), requirement, &write);
        checks.extend(writes.into_iter().map(|check| match length {
            0 => recorded(check, NO_DATA),
            _ => check,
        }));
        checks.extend(author.both_ways(&format!("{id}.{name}.status"), of_status, &status));
    }
    checks
}
