//! What frames hold, by single sentences, and the frames that the document prints.

use actucheck_spec::model::{Outcome, Vector};
use actucheck_spec::wire::innfos::{Operation, Packet};
use actucheck_spec::wire::{self, Direction};

use super::{
    ID, LAYOUT, QUERY, READ_ALARMS, READ_POSITION, SET_POSITION, all, answered, bare, data,
    datagram, found, frame, read, reply, request,
};
use crate::suite::Author;
use crate::suite::check::Check;
use crate::suite::codec::innfos::tables;

/// A name, the requirement, the command and its data.
type Row = (&'static str, &'static str, u8, &'static [u8]);

const TRANSPARENT: &str = "innfos.frame.transparent";

/// What is written.
const SENT: &[Row] = &[
    ("header-in-data", TRANSPARENT, SET_POSITION, &[0xEE, 0x06, 0xEE, 0x01]),
    ("end-in-data", TRANSPARENT, SET_POSITION, &[0x01, 0xED, 0xED, 0xED]),
];

/// What is read.
const READ: &[Row] = &[
    ("header-in-answer", TRANSPARENT, READ_POSITION, &[0xEE, 0x06, 0x06, 0x00]),
    ("end-in-answer", TRANSPARENT, READ_POSITION, &[0x01, 0xED, 0xED, 0xED]),
    ("zeros", LAYOUT, READ_POSITION, &[0, 0, 0, 0]),
    ("crc-of-answer", "innfos.crc.value", READ_POSITION, &[0x12, 0x34, 0x56, 0x78]),
    ("crc-of-two-bytes", "innfos.crc.reply", READ_ALARMS, &[0x01, 0x05]),
    ("crc-order", "innfos.crc.byte-order", READ_ALARMS, &[0x00, 0x05]),
];

pub(super) fn frames(author: Author<'_>) -> Vec<Check> {
    let mut checks = rows(author, "innfos.host.frame", SENT, READ);
    let held = [0x00, 0x12, 0x34, 0x56];
    for address in [0x01, 0xFF] {
        let asked = request(address, READ_POSITION, &[]);
        let step = answered(asked, datagram(&reply(address, READ_POSITION, &held)));
        let id = |about| format!("innfos.host.frame.address-{address:02x}/{about}");
        let (requirement, due) = ("innfos.frame.address", all([data(address, &held)]));
        checks.push(author.sent(id("sent"), requirement, vec![step.clone()]));
        checks.push(author.returned(id("result"), requirement, vec![step], due));
    }
    checks
}

const FLAG: &str = "innfos.flag.values";
const MODE: &str = "innfos.mode.values";
const IQ8: &str = "innfos.value.iq8";
const IQ24: &str = "innfos.value.iq24";
const ENERGY: &str = "innfos.value.stall-energy";
const RELATIVE: &str = "innfos.value.relative";
const POSITION: &str = "innfos.value.position";
const LIMIT: &str = "innfos.value.output-limit";
const GAIN: &str = "innfos.value.gain";
const BITS: &str = "innfos.alarms.bits";
const OTHER: &str = "innfos.alarms.other";

/// Values that are set.
const SET: &[Row] = &[
    ("power-on", FLAG, 0x2A, &[0x01]),
    ("power-off", FLAG, 0x2A, &[0x00]),
    ("filter-on", FLAG, 0x70, &[0x01]),
    ("mode-1", MODE, 0x07, &[0x01]),
    ("mode-8", MODE, 0x07, &[0x08]),
    // 80 °C, and -10.25 °C.
    ("hot", IQ8, 0x61, &[0x50, 0x00]),
    ("below-zero", IQ8, 0x63, &[0xF5, 0xC0]),
    ("high-byte-first", "innfos.value.byte-order", 0x0A, &[0x01, 0x02, 0x03, 0x04]),
    // -2.0.
    ("minus-two", IQ24, 0x87, &[0xFE, 0, 0, 0]),
    // 40 J.
    ("energy", ENERGY, 0x7E, &[0, 0, 0x0B, 0xC1]),
    ("half-current", RELATIVE, 0x08, &[0x00, 0x80, 0, 0]),
    ("full-current-back", RELATIVE, 0x08, &[0xFF, 0, 0, 0]),
    // 60 revolutions, and the ends of the range.
    ("sixty-revolutions", POSITION, 0x0A, &[0x3C, 0, 0, 0]),
    ("first-position", POSITION, 0x0A, &[0x80, 0, 0, 0]),
    ("last-position", POSITION, 0x0A, &[0x7F, 0xFF, 0xFF, 0xFF]),
    ("lowest-limit", LIMIT, 0x2E, &[0xFF, 0, 0, 0]),
    ("highest-limit", LIMIT, 0x2F, &[0x01, 0, 0, 0]),
    ("lowest-gain", GAIN, 0x0E, &[0x80, 0, 0, 0]),
    ("highest-gain", GAIN, 0x0E, &[0x7F, 0xFF, 0xFF, 0xFF]),
];

/// Values that are read.
const GOT: &[Row] = &[
    ("is-off", FLAG, 0x2B, &[0x00]),
    ("is-on", FLAG, 0x2B, &[0x01]),
    ("is-mode-1", MODE, 0x55, &[0x01]),
    ("is-mode-8", MODE, 0x55, &[0x08]),
    ("no-alarm", BITS, 0xFF, &[0x00, 0x00]),
    ("two-alarms", BITS, 0xFF, &[0x00, 0x05]),
    ("every-alarm", BITS, 0xFF, &[0x07, 0xFF]),
    ("other-alarm", OTHER, 0xFF, &[0x08, 0x00]),
    ("last-alarm", OTHER, 0xFF, &[0x80, 0x00]),
    ("is-below-zero", IQ8, 0x5F, &[0xF5, 0xC0]),
    ("is-high-byte-first", "innfos.value.byte-order", 0x06, &[0x01, 0x02, 0x03, 0x04]),
    ("is-minus-two", IQ24, 0x8A, &[0xFE, 0, 0, 0]),
    ("has-energy", ENERGY, 0x7F, &[0, 0, 0x0B, 0xC1]),
    ("has-half-current", RELATIVE, 0x04, &[0x00, 0x80, 0, 0]),
    ("is-at-first-position", POSITION, 0x06, &[0x80, 0, 0, 0]),
    ("is-at-last-position", POSITION, 0x06, &[0x7F, 0xFF, 0xFF, 0xFF]),
    ("has-lowest-limit", LIMIT, 0x34, &[0xFF, 0, 0, 0]),
    ("has-lowest-gain", GAIN, 0x15, &[0x80, 0, 0, 0]),
];

/// Values as bytes, as the call has them: a host that has them as numbers turns them into these.
pub(super) fn values(author: Author<'_>) -> Vec<Check> {
    rows(author, "innfos.host.value", SET, GOT)
}

fn rows(author: Author<'_>, family: &str, sent: &[Row], got: &[Row]) -> Vec<Check> {
    let is_answered =
        |command| tables::rows(author).command(command).is_some_and(|row| !row.reply.is_empty());
    let sent = sent.iter().map(|(name, requirement, command, held)| {
        let answer = if is_answered(*command) { reply(ID, *command, &[1]) } else { Vec::new() };
        let step = answered(request(ID, *command, held), datagram(&answer));
        author.sent(format!("{family}.{name}/sent"), requirement, vec![step])
    });
    let got = got.iter().map(|(name, requirement, command, held)| {
        let step = answered(read(*command), datagram(&reply(ID, *command, held)));
        let due = all([data(ID, held)]);
        author.returned(format!("{family}.{name}/result"), requirement, vec![step], due)
    });
    sent.chain(got).collect()
}

/// Each frame of the test vectors: a request that is sent, or a reply that answers one.
pub(super) fn printed(author: Author<'_>) -> Vec<Check> {
    let vectors = author.spec.vectors().filter(|(file, _)| file.wire == author.wire);
    let is_demanded = |vector: &&Vector| vector.result != Outcome::Acceptable;
    vectors
        .filter_map(|(_, vector)| Some(vector).filter(is_demanded))
        .filter_map(|vector| of_vector(author, vector))
        .collect()
}

fn of_vector(author: Author<'_>, vector: &Vector) -> Option<Check> {
    let Some(wire::Packet::Innfos(packet)) = &vector.packet else { return None };
    let name = vector.id.strip_prefix("innfos.").unwrap_or(&vector.id);
    let id = |about| format!("innfos.host.printed.{name}/{about}");
    let Packet { direction, address, command, data: held } = packet;
    let row = tables::rows(author).command(*command)?;
    if *direction == Direction::Request {
        let answer = tables::of_command(author, Direction::Reply, *command);
        let answer = answer.map(|answer| match row.code {
            QUERY => answer,
            _ => Packet { address: *address, ..answer },
        });
        let answer = answer.as_ref().map(frame).unwrap_or_default();
        let step = answered(packet.clone(), datagram(&answer));
        return Some(author.sent(id("sent"), PACKETS, vec![step]));
    }
    let asked = tables::of_command(author, Direction::Request, *command)?;
    let asked = if row.code == QUERY { asked } else { Packet { address: *address, ..asked } };
    let due = match (row.operation, &*held.0) {
        _ if row.code == QUERY => all([found(*address, held)]),
        (Operation::Read, held) => all([data(*address, held)]),
        (Operation::Write, [0]) => super::refused(),
        (Operation::Write, _) => all([bare(*address)]),
    };
    let step = answered(asked, datagram(&frame(packet)));
    Some(author.returned(id("result"), PACKETS, vec![step], due))
}

const PACKETS: &str = "innfos.packets";
