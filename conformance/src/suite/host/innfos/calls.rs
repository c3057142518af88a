//! Each command with a right answer, and with one that tells no success.

use actucheck_spec::wire::Direction;
use actucheck_spec::wire::innfos::{Command, Operation, Packet, WIRE};

use super::{
    ALWAYS, ECHO, HANDSHAKE, ID, LAYOUT, OTHER_ID, QUERY, READ_ALARMS, READ_POSITION, READ_SPEED,
    SET_POSITION, SET_TEMPERATURE, SIGN_OF_LIFE, SWITCH, all, answered, bare, data, datagram,
    found, frame, read, recorded, refused, reply, stem, untold,
};
use crate::adapter::Step;
use crate::suite::Author;
use crate::suite::check::Check;
use crate::suite::codec::innfos::tables;
use crate::suite::due::Due;
use crate::suite::host::{BASIC, basic};

/// The commands whose basic checks others rest on; a request without data, and with data of each size.
const FIRST: [u8; 4] = [READ_POSITION, SWITCH, SET_TEMPERATURE, SET_POSITION];

/// A call that is answered right.
struct Right<'a> {
    row: &'a Command,
    request: Packet,
    /// `None` if the command is not answered, or if the answer's frame is unspecified.
    reply: Option<Packet>,
}

impl<'a> Right<'a> {
    /// A call of each command, the most basic first.
    fn every(author: Author<'a>) -> Vec<Self> {
        let innfos = tables::rows(author);
        let of_row = |row: &'a Command| {
            let request = tables::of_command(author, Direction::Request, row.code)?;
            let reply = tables::of_command(author, Direction::Reply, row.code);
            Some(Self { row, request, reply })
        };
        let mut all: Vec<_> = innfos.commands.iter().filter_map(of_row).collect();
        let place = |right: &Self| FIRST.iter().position(|code| *code == right.row.code);
        all.sort_by_key(|right| place(right).unwrap_or(FIRST.len()));
        all
    }

    fn step(&self) -> Step {
        let reply = self.reply.as_ref().map(frame).unwrap_or_default();
        answered(self.request.clone(), datagram(&reply))
    }

    fn stem(&self) -> String {
        stem(self.row.code)
    }

    fn due(&self) -> Due {
        let Some(Packet { address, data: held, .. }) = &self.reply else { return all([]) };
        all([match (self.row.operation, self.row.code) {
            (_, QUERY) => found(*address, held),
            (Operation::Read, _) => data(*address, held),
            (Operation::Write, _) => bare(*address),
        }])
    }

    /// Whether an erratum says which of two texts tells what the command is about.
    fn has_two_texts(&self, author: Author<'_>) -> bool {
        let row = author.spec.requirement(MEANING);
        row.is_some_and(|row| row.errata.iter().any(|id| self.row.errata.contains(id)))
    }

    /// The requirement on what is sent.
    fn to_send(&self, author: Author<'_>) -> &'static str {
        match (self.row.code, self.row.operation) {
            (READ_POSITION, _) => "innfos.frame.no-data",
            (SWITCH, _) => "innfos.crc.request",
            (SET_TEMPERATURE, _) => "innfos.crc.byte-order",
            (SET_POSITION, _) => "innfos.crc.value",
            (HANDSHAKE, _) => "innfos.transport.handshake",
            (QUERY, _) => "innfos.transport.query",
            (SIGN_OF_LIFE, _) => "innfos.handshake.ready",
            _ if self.has_two_texts(author) => MEANING,
            (_, Operation::Read) => SIZES,
            (_, Operation::Write) => "innfos.write.sizes",
        }
    }

    /// The requirement on what is returned.
    fn to_return(&self) -> &'static str {
        match (self.row.code, self.row.operation) {
            _ if self.reply.is_none() => ALWAYS,
            (READ_POSITION, _) => LAYOUT,
            (READ_ALARMS, _) => "innfos.alarms.bits",
            (SWITCH, _) => "innfos.crc.reply",
            (QUERY, _) => "innfos.transport.query",
            (SIGN_OF_LIFE, _) => "innfos.handshake.ready",
            (_, Operation::Read) => SIZES,
            (_, Operation::Write) => RESULT,
        }
    }
}

const MEANING: &str = "innfos.tables.meaning";
const SIZES: &str = "innfos.read.sizes";
const RESULT: &str = "innfos.write.result";

/// What each call sends, and what it returns.
pub(super) fn basics(author: Author<'_>) -> Vec<Check> {
    let [sent, result] = BASIC;
    let both = |right: Right<'_>| {
        let id = |about| basic(WIRE, &right.stem(), about);
        let sent = author.sent(id(sent), right.to_send(author), vec![right.step()]);
        let returned =
            author.returned(id(result), right.to_return(), vec![right.step()], right.due());
        // The frame that answers the handshake is unspecified.
        [Some(sent), Some(returned).filter(|_| right.row.code != HANDSHAKE)]
    };
    Right::every(author).into_iter().flat_map(both).flatten().collect()
}

/// The answer to the handshake, as it is printed and as boards send it.
pub(super) fn handshake(author: Author<'_>) -> Vec<Check> {
    let printed = reply(0, HANDSHAKE, &[0x01]);
    let (before, tail) = printed.split_at(printed.len().saturating_sub(1));
    let with = |crc: &[u8]| [before, crc, tail].concat();
    let check = |(name, what, answer): (&str, &str, Vec<u8>)| {
        let steps = vec![answered(super::request(0, HANDSHAKE, &[]), datagram(&answer))];
        let id = format!("innfos.host.handshake.{name}/result");
        let check = author.returned(id, "innfos.crc.reply", steps, all([data(0, &[0x01])]));
        recorded(check, &format!("What does the handshake return whose answer has {what}?"))
    };
    [
        ("printed", "no CRC", printed.clone()),
        ("zeros", "zeros for the CRC", with(&[0, 0])),
        ("crc", "a CRC", with(&[0x7E, 0x80])),
    ]
    .map(check)
    .into()
}

/// A read right after each call: the answer to the call is not taken for the one to the read. Answers
/// take their time, so that a host that does not await one is met by it in the read.
pub(super) fn after(author: Author<'_>) -> Vec<Check> {
    const TIME_MS: u32 = 4;
    const HELD: [u8; 4] = [0x00, 0x39, 0x4A, 0x5B];
    let slow = |mut step: Step| {
        step.answers.iter_mut().flatten().for_each(|burst| burst.after_ms = TIME_MS);
        Step { hurries: true, ..step }
    };
    let check = |right: Right<'_>| {
        let answer = datagram(&reply(ID, READ_SPEED, &HELD));
        let next = answered(read(READ_SPEED), answer);
        let id = format!("innfos.host.after.{}/read", right.stem());
        author.returned(id, ECHO, vec![slow(right.step()), slow(next)], all([data(ID, &HELD)]))
    };
    Right::every(author).into_iter().map(check).collect()
}

/// Each write that the actuator refuses, and that another actuator answers.
pub(super) fn unsuccessful(author: Author<'_>) -> Vec<Check> {
    let is_write =
        |right: &Right<'_>| right.row.operation == Operation::Write && right.reply.is_some();
    let both = |right: Right<'_>| {
        let id = |what: &str| format!("innfos.host.no-success.{}/{what}", right.stem());
        let steps = |answer: Vec<u8>| vec![answered(right.request.clone(), datagram(&answer))];
        let code = right.row.code;
        let no = steps(reply(ID, code, &[0x00]));
        let other = steps(reply(OTHER_ID, code, &[0x01]));
        [
            author.returned(id("refused"), RESULT, no, refused()),
            author.returned(id("other-device"), ECHO, other, untold()),
        ]
    };
    Right::every(author).into_iter().filter(is_write).flat_map(both).collect()
}
