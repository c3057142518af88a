//! Everything where everything is little: short bodies of the pattern's bytes, every instruction,
//! every error byte, every ID; and the lengths at which counting goes wrong.

use actucheck_spec::model::Packet;
use actucheck_spec::wire::dynamixel2::reference::{self, BROADCAST, STATUS};

use crate::adapter::{Op, Output};
use crate::suite::check::{Check, Demand};
use crate::suite::{Author, Options, hex};

/// The bytes of the pattern, the one that makes it a header, and one that is none of them.
const ALPHABET: [u8; 4] = [0xFF, 0xFD, 0x00, 0x01];

/// Data lengths around 0, a register, and where the length needs another bit or byte: with 5
/// bytes of instruction, address and CRC a Write's length passes 128 and 256 here.
const LENGTHS: [usize; 17] =
    [0, 1, 2, 3, 4, 122, 123, 124, 127, 128, 129, 250, 251, 252, 255, 256, 257];

/// The largest packet that a length of two bytes can tell of.
const LARGEST: usize = 65_535 + reference::PREFIX;
/// Bytes of a Write around its data. A status packet has one less.
const WRITE_AROUND: usize = 12;

/// The address that is written, 116: some libraries end at 255.
const REGISTER: [u8; 2] = [0x74, 0x00];

pub(super) fn checks(author: &Author<'_>, options: &Options) -> Vec<Check> {
    let bodies = |longest| (0..=longest).flat_map(words);
    let inside_of = options.body_length.min(Options::LONGEST_BODY);
    let mut checks = Vec::new();
    checks.extend(bodies(Options::LONGEST_BODY).flat_map(|body| alone(author, &body)));
    checks.extend(bodies(inside_of).flat_map(|body| inside(author, &body)));
    checks.extend((0..=u8::MAX).flat_map(|code| instruction(author, code)));
    checks.extend((0..=u8::MAX).flat_map(|error| error_byte(author, error)));
    checks.extend((0..=252).chain([BROADCAST]).flat_map(|id| id_byte(author, id)));
    let around = LENGTHS.into_iter().chain(largest(options.max_packet));
    checks.extend(around.flat_map(|length| lengths(author, length)));
    checks.extend(before_params(author));
    checks
}

/// The pattern begins before the parameters: with the instruction, or with the error byte.
fn before_params(author: &Author<'_>) -> Vec<Check> {
    let params = || vec![0xFF, 0xFD].into();
    let instruction = Packet::Instruction { id: 1, instruction: 0xFF, params: params() };
    let status = Packet::Status { id: 1, error: 0xFF, params: params() };
    let requirement = "dynamixel2.stuffing.transmit";
    let first = author.both_ways("dynamixel2.stuffing.from-instruction", requirement, &instruction);
    let second = author.both_ways("dynamixel2.stuffing.from-error", requirement, &status);
    first.into_iter().chain(second).collect()
}

/// Every word of this length over the alphabet.
fn words(length: u32) -> impl Iterator<Item = Vec<u8>> {
    (0..4_usize.pow(length)).map(move |number| {
        let letters = (0..length).map(|place| number / 4_usize.pow(place) % 4);
        letters.filter_map(|letter| ALPHABET.get(letter).copied()).collect()
    })
}

/// A body without a packet around it.
fn alone(author: &Author<'_>, body: &[u8]) -> [Check; 2] {
    let wire = author.wire;
    let stuffed = reference::stuff(body);
    let id = format!("dynamixel2.stuffing.body.{}", hex(body));
    let (plain, stuffed) = (body.to_vec().into(), stuffed.into());
    [
        author.check(
            format!("{id}/stuff"),
            "dynamixel2.stuffing.transmit",
            Op::Stuff { wire, bytes: body.to_vec().into() },
            Demand::Yield(Output::Bytes(Clone::clone(&stuffed))),
        ),
        author.check(
            format!("{id}/unstuff"),
            "dynamixel2.stuffing.receive",
            Op::Unstuff { wire, bytes: stuffed },
            Demand::Yield(Output::Bytes(plain)),
        ),
    ]
}

/// The same bytes in every place of a packet: behind the header, in the middle, before the CRC.
fn inside(author: &Author<'_>, word: &[u8]) -> Vec<Check> {
    let with = |before: &[u8], after: &[u8]| [before, word, after].concat();
    let instruction = |instruction: u8, params: Vec<u8>| {
        let id = if instruction >= 0x80 { BROADCAST } else { 1 };
        Packet::Instruction { id, instruction, params: params.into() }
    };
    let status = |params: Vec<u8>| Packet::Status { id: 1, error: 0, params: params.into() };
    let size = u16::try_from(word.len()).unwrap_or_default().to_le_bytes();
    let sync = [REGISTER.as_slice(), &size, &[1]].concat();
    let bulk = [&[1], REGISTER.as_slice(), &size].concat();
    let mut packets = vec![
        ("write", instruction(0x03, with(&REGISTER, &[]))),
        ("write-middle", instruction(0x03, with(&REGISTER, &[0x05, 0x06]))),
        ("reg-write", instruction(0x04, with(&REGISTER, &[]))),
        ("status", status(with(&[], &[]))),
        ("status-middle", status(with(&[0x05], &[0x06]))),
    ];
    if !word.is_empty() {
        packets.extend([
            ("sync-write", instruction(0x83, with(&sync, &[]))),
            ("bulk-write", instruction(0x93, with(&bulk, &[]))),
            ("fast-sync-write", instruction(0x8B, with(&sync, &[]))),
        ]);
    }
    let mut checks = Vec::new();
    for (place, packet) in packets {
        let id = format!("dynamixel2.stuffing.in-{place}.{}", hex(word));
        let requirement = match &packet {
            Packet::Status { .. } => "dynamixel2.stuffing.receive",
            _ => "dynamixel2.stuffing.transmit",
        };
        checks.extend(author.both_ways(&id, requirement, &packet));
        let frame = reference::encode(&packet).unwrap_or_default();
        let stream = format!("{id}/stream");
        checks.push(Check {
            requires: Some(format!("{id}/decode")),
            ..author.streamed(stream, "dynamixel2.receive.stream", &[frame])
        });
    }
    checks
}

fn instruction(author: &Author<'_>, code: u8) -> Vec<Check> {
    if code == STATUS {
        return Vec::new();
    }
    let packet = |params: &[u8]| {
        let params = params.to_vec().into();
        Packet::Instruction { id: 1, instruction: code, params }
    };
    let requirement = "dynamixel2.packet.layout";
    let id = format!("dynamixel2.instruction.{code:02x}");
    // No parameters of an instruction fit these two, so they go out as they are.
    let codes = match code {
        0x20 | 0x8A | 0x8B => "ja40.instruction.codes", // in no table of the DYNAMIXEL document
        _ => "dynamixel2.packet.instruction.codes",
    };
    let without = author.both_ways(&id, codes, &packet(&[]));
    let with = author.both_ways(&format!("{id}-with-params"), requirement, &packet(&[1, 2, 3]));
    without.into_iter().chain(with).map(without_call).collect()
}

/// The packet alone: what is sent is bytes, not a request that a library may know.
fn without_call(mut check: Check) -> Check {
    if let Op::Encode { packet, .. } = &mut check.op {
        packet.call = None;
    }
    check
}

fn error_byte(author: &Author<'_>, error: u8) -> Vec<Check> {
    let packet = Packet::Status { id: 1, error, params: vec![0x2A].into() };
    let id = format!("dynamixel2.error.{error:02x}");
    author.both_ways(&id, "dynamixel2.status-packet.error.fields", &packet)
}

fn id_byte(author: &Author<'_>, id: u8) -> Vec<Check> {
    let requirement = "dynamixel2.packet.id.range";
    let ping = Packet::Instruction { id, instruction: 0x01, params: Vec::new().into() };
    let mut checks = author.both_ways(&format!("dynamixel2.id.{id}.ping"), requirement, &ping);
    if id != BROADCAST {
        let status = Packet::Status { id, error: 0, params: vec![0x2A].into() };
        let name = format!("dynamixel2.id.{id}.status");
        checks.extend(author.both_ways(&name, "dynamixel2.status-packet.layout", &status));
    }
    checks
}

/// Data lengths, beyond [`LENGTHS`], of the largest packets that an implementation takes: a Write
/// with a byte less, a Write, a status packet, and a Write that stuffing makes so large.
fn largest(max_packet: Option<usize>) -> Vec<usize> {
    let Some(limit) = max_packet.map(|limit| limit.min(LARGEST)) else { return Vec::new() };
    let Some(write) = limit.checked_sub(WRITE_AROUND) else { return Vec::new() };
    let lengths = [write.saturating_sub(1), write, write + 1, write * 3 / 4];
    lengths.into_iter().filter(|length| !LENGTHS.contains(length)).collect()
}

/// Plain data, and data that is all patterns, of this length.
fn lengths(author: &Author<'_>, length: usize) -> Vec<Check> {
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
        let id = format!("dynamixel2.length.{length}.{name}");
        checks.extend(author.both_ways(&format!("{id}.write"), requirement, &write));
        checks.extend(author.both_ways(&format!("{id}.status"), of_status, &status));
    }
    checks
}
