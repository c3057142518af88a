//! Sentences about packets in general: each with the smallest conversation that shows whether the device
//! obeys it.

use super::several::{self, Kind};
use super::{BROADCAST, Talk, asked, code, error, frame, named, ping};
use crate::adapter::{Asked, Bits, Permissions};
use crate::suite::check::{Check, Demand};
use crate::suite::wanted::{Like, Part, Wanted};

/// What is sent, and what must come back.
pub(super) type Conversation = (Vec<Asked>, Vec<Vec<Vec<Like>>>);

/// Sentences that the answer to a Ping shows, by the names that documents give them.
const PING: [&str; 13] = [
    "packet.layout",
    "packet.reserved",
    "packet.length|length.value",
    "packet.length.byte-order|length.byte-order",
    "packet.length.status",
    "crc.value",
    "crc.byte-order",
    "status-packet.layout",
    "status-packet.id",
    "status-packet.instruction",
    "status-packet.error.fields|status-packet.error",
    "status-packet.error.none",
    "ping.parameters",
];

/// Sentences that the answer to a Read shows.
const READ: [&str; 5] = [
    "packet.length.instruction",
    "packet.parameters|sync.sections",
    "status-packet.parameters",
    "response.own-id|status-packet.answer",
    "read.parameters",
];

/// Sentences that a Read shows whose parameters have the pattern of byte stuffing.
const STUFFED: [&str; 4] =
    ["stuffing.covers|stuffing", "stuffing.length", "stuffing.crc", "stuffing.receive"];

/// Sentences that a Ping to every device shows.
const EVERYBODY: [&str; 3] =
    ["packet.id.broadcast|id.broadcast", "response.broadcast", "ping.broadcast.order"];

/// Sentences about an instruction that reads from several devices.
const SEVERAL: [&str; 3] = ["parameters", "broadcast-id", "length"];

const ALERT: [&str; 2] = ["status-packet.alert", "status-packet.alert.cause"];

pub(super) fn checks(talk: &Talk<'_>) -> Vec<Check> {
    let mut checks = of(talk, &PING, Some(pinged(talk)));
    checks.extend(of(talk, &READ, read(talk)));
    checks.extend(of(talk, &["receive.id"], Some(unfit(talk))));
    checks.extend(of(talk, &["packet.instruction.codes|instruction.codes"], codes(talk)));
    checks.extend(of(talk, &STUFFED, Some(stuffed(talk))));
    checks.extend(of(talk, &EVERYBODY, Some(everybody(talk))));
    checks.extend(of(talk, &ALERT, alert(talk)));
    checks.extend(of(talk, &["response.status-return-level"], level(talk)));
    checks.extend(of(talk, &["packets.device"], printed(talk)));
    // The packets that the documents print are for ID 1.
    if talk.id() == 1 {
        checks.extend(of(talk, &["packets"], Some(pinged(talk))));
    }
    for kind in several::own(talk) {
        checks.extend(of_kind(talk, kind));
    }
    checks.push(at_once(talk));
    checks
}

/// A check for each sentence that the device's documents have.
fn of(talk: &Talk<'_>, sentences: &[&str], conversation: Option<Conversation>) -> Vec<Check> {
    conversation.map_or_else(Vec::new, |conversation| {
        shown(talk, &Permissions::READ, sentences, &conversation)
    })
}

/// The same for a conversation that needs more than to read.
pub(super) fn shown(
    talk: &Talk<'_>,
    needs: &Permissions,
    sentences: &[&str],
    (steps, wanted): &Conversation,
) -> Vec<Check> {
    let check = |sentence: &&str| {
        let names: Vec<_> = sentence.split('|').collect();
        let row = talk.row(&names)?;
        let (_, name) = row.split_once('.')?;
        let id = named(&format!("sentence.{}/shown", name.replace('.', "-")));
        let demand = Demand::Answer(wanted.iter().cloned().map(Wanted).collect());
        Some(talk.asks_with(needs.clone(), id, &names, steps.clone(), demand))
    };
    sentences.iter().filter_map(check).collect()
}

fn pinged(talk: &Talk<'_>) -> Conversation {
    (vec![asked(talk.ping(), 1)], vec![vec![vec![talk.pong()]]])
}

/// Pings to IDs that no packet may have.
fn unfit(talk: &Talk<'_>) -> Conversation {
    let step = |id| talk.then_ping(frame(id, &[code::PING]));
    (vec![step(253), step(255)], vec![vec![vec![talk.pong()]]; 2])
}

/// Two registers in one Read, and the second of them alone.
fn read(talk: &Talk<'_>) -> Option<Conversation> {
    let [first, second, ..] = talk.target.device?.registers.as_slice() else { return None };
    let (from, count) = (second.address - first.address, second.kind.size());
    let both = from + count;
    let part = Part::Same { step: 0, from: from.into(), count: count.into() };
    let steps =
        vec![asked(talk.read(first.address, both), 1), asked(talk.read(second.address, count), 1)];
    // Between them there must be no address without a register.
    (first.kind.size() == from).then(|| {
        let wanted = [Part::Any(both.into()), part];
        (steps, wanted.map(|part| vec![vec![talk.done(part)]]).into())
    })
}

/// Each instruction that reads.
fn codes(talk: &Talk<'_>) -> Option<Conversation> {
    let (range, id) = (first_register(talk)?, talk.id());
    let read = || talk.done(Part::Any(range.1.into()));
    let mut steps = vec![asked(talk.ping(), 1), asked(talk.read(range.0, range.1), 1)];
    let mut wanted = vec![vec![vec![talk.pong()]], vec![vec![read()]]];
    for kind in several::own(talk) {
        steps.push(kind.asked(&[id], range, 1));
        wanted.push(vec![vec![read()]]);
    }
    Some((steps, wanted))
}

fn first_register(talk: &Talk<'_>) -> Option<(u16, u16)> {
    let register = talk.target.device?.registers.first()?;
    Some((register.address, register.kind.size()))
}

/// Reads whose parameters begin and end with FF FF FD. No device has so many addresses.
fn stuffed(talk: &Talk<'_>) -> Conversation {
    let packets = [talk.read(u16::MAX, 0x00FD), talk.read(0xFF00, 0xFDFF)];
    let steps = packets.map(|packet| asked(packet, 1)).to_vec();
    let refused = || Like { id: talk.id(), error: Some(error::ACCESS), data: Some(Vec::new()) };
    // A table that is not complete does not tell which error it is.
    let is_known = talk.target.device.is_some_and(|device| device.complete);
    let answer =
        || if is_known { refused() } else { Like { error: None, data: None, ..refused() } };
    let wanted = steps.iter().map(|_| vec![vec![answer()]]).collect();
    (steps, wanted)
}

/// Ping to the broadcast ID, which every device answers by rising ID.
fn everybody(talk: &Talk<'_>) -> Conversation {
    let present = &talk.target.present;
    let pong = |id: &u8| Like { id: *id, error: Some(error::NONE), data: Some(vec![Part::Any(3)]) };
    let answers = present.iter().map(pong).collect();
    (vec![asked(ping(BROADCAST), present.len())], vec![vec![answers]])
}

/// The alert and the register that tells its cause.
fn alert(talk: &Talk<'_>) -> Option<Conversation> {
    let register = talk.target.device?.register("Hardware Error Status")?;
    let size = register.kind.size();
    let answer = talk.done(Part::Alarms(size.into()));
    Some((vec![asked(talk.read(register.address, size), 1)], vec![vec![vec![answer]]]))
}

/// Who answers a Read has level 1 or 2.
fn level(talk: &Talk<'_>) -> Option<Conversation> {
    let register = talk.target.device?.register("Status Return Level")?;
    let level = Part::Bits { size: 1, has: Bits { lowest: 0, width: 8, one_of: vec![1, 2] } };
    let read = talk.read(register.address, register.kind.size());
    Some((vec![asked(read, 1)], vec![vec![vec![talk.done(level)]]]))
}

/// The registers of the document's examples on Read and Sync Read: Present Position, four bytes at 132.
fn printed(talk: &Talk<'_>) -> Option<Conversation> {
    let register = talk.target.device?.register("Present Position")?;
    let is_of_examples = talk.document() == Some(super::WIRE.id()) && register.address == 132;
    let conversation =
        || (vec![asked(talk.read(132, 4), 1)], vec![vec![vec![talk.done(Part::Any(4))]]]);
    is_of_examples.then(conversation)
}

fn of_kind(talk: &Talk<'_>, kind: Kind) -> Vec<Check> {
    let Some(range) = first_register(talk) else { return Vec::new() };
    let names = SEVERAL.map(|about| format!("{}.{about}", kind.word()));
    let answer = talk.done(Part::Any(range.1.into()));
    let conversation = (vec![kind.asked(&[talk.id()], range, 1)], vec![vec![vec![answer]]]);
    of(talk, &names.each_ref().map(String::as_str), Some(conversation))
}

/// Three Pings without a pause. No host may expect an answer to each.
fn at_once(talk: &Talk<'_>) -> Check {
    let pings: Vec<u8> = (0..3).flat_map(|_| super::bytes_of(talk.ping()).0).collect();
    let step = talk.then_ping(pings);
    talk.record(
        named("sentence.three-at-once/answers"),
        &["response.own-id", "status-packet.answer", "ping.status"],
        vec![step],
        "What does it answer three Pings that come without a pause?",
    )
}
