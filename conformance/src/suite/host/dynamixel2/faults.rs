//! Answers to Read that are damaged, late, or of something else; and the next Read after each.

use actucheck_spec::wire::dynamixel2::{Packet, WIRE};

use super::{NO_ANSWER, all, burst, data, failed, frame, later, read, status, step};
use crate::adapter::{Burst, Reported, Step, Trouble};
use crate::suite::check::{Check, Demand};
use crate::suite::due::Due;
use crate::suite::{Author, changed};

const ADDRESS: u16 = 132;
/// What the device holds.
const HELD: [u8; 4] = [0xA6, 0x01, 0x02, 0x83];
/// What it holds when it is asked again, so that one can tell which answer was taken.
const LATER: [u8; 4] = [0xB7, 0x12, 0x13, 0x94];
/// What the next Read is answered, and what no answer holds.
const NEXT: [u8; 4] = [0x17, 0x28, 0x39, 0x4A];
const OTHER: [u8; 4] = [0x61, 0x72, 0x03, 0x14];
/// The pause between two parts of an answer, which is much shorter than any time-out.
const PAUSE_MS: u32 = 3;

/// What is played instead of a right answer, and what must come of it.
struct Case {
    name: String,
    requirement: &'static str,
    played: Vec<Burst>,
    /// The answer to a host that asks again.
    again: Vec<u8>,
    /// What comes only when the call has returned.
    late: Vec<u8>,
    due: Due,
    /// The requirement on the next Read.
    next: &'static str,
}

const STREAM: &str = "dynamixel2.receive.stream";
const RESUME: &str = "dynamixel2.receive.resume";
const LAYOUT: &str = "dynamixel2.status-packet.layout";
const PARAMETERS: &str = "dynamixel2.status-packet.parameters";

impl Case {
    /// Something that is no answer: the call fails, or asks again.
    fn bad(name: impl Into<String>, requirement: &'static str, played: Vec<u8>) -> Self {
        let due = Due { or: NO_ANSWER.to_vec(), ..all([data(1, &LATER)]) };
        let good = Self::good(name, requirement, vec![burst(played)]);
        Self { again: status(1, 0, &LATER), due, next: RESUME, ..good }
    }

    /// Something in which the answer is found.
    fn good(name: impl Into<String>, requirement: &'static str, played: Vec<Burst>) -> Self {
        let (name, due) = (name.into(), all([data(1, &HELD)]));
        let (again, late) = (answer(), Vec::new());
        Self { name, requirement, played, again, late, due, next: STREAM }
    }

    /// Something that must not be taken, before the answer, which need not be found.
    fn foreign(name: &str, requirement: &'static str, bytes: Vec<u8>) -> Self {
        let due = Due { or: NO_ANSWER.to_vec(), ..all([data(1, &HELD)]) };
        let played = vec![burst([bytes, answer()].concat())];
        Self { due, ..Self::good(name, requirement, played) }
    }

    fn step(&self) -> Step {
        let again = vec![burst(self.again.clone())];
        let answers = vec![self.played.clone(), again.clone(), again];
        let late = self.late.clone().into();
        Step { late, ..step(read(1, ADDRESS, 4), answers) }
    }
}

/// The right answer.
fn answer() -> Vec<u8> {
    status(1, 0, &HELD)
}

fn cases() -> Vec<Case> {
    let answer = answer();
    let mut cases = Vec::new();
    for place in 0..answer.len() {
        let requirement =
            if place < 4 { "dynamixel2.receive.header" } else { "dynamixel2.receive.crc" };
        let flipped = changed(&answer, place, |byte| byte ^ 0x10);
        cases.push(Case::bad(format!("flip-{place:02}"), requirement, flipped));
    }
    for place in 0..answer.len() {
        let (before, after) = answer.split_at(place);
        let length = "dynamixel2.receive.length";
        cases.push(Case::bad(format!("cut-{place:02}"), length, before.to_vec()));
        if place > 0 {
            let parts = vec![burst(before), later(PAUSE_MS, after)];
            cases.push(Case::good(format!("split-{place:02}"), STREAM, parts));
        }
    }
    let doubled = [answer.clone(), answer.clone()].concat();
    cases.push(Case { next: PARAMETERS, ..Case::good("doubled", STREAM, vec![burst(doubled)]) });
    for (name, requirement, noise) in [
        ("noise", "dynamixel2.receive.header", &[0x00, 0x55, 0xAA][..]),
        ("noise-like-header", "dynamixel2.receive.header", &[0xFF]),
        ("false-header", RESUME, &[0xFF, 0xFF, 0xFD, 0x00, 0x01]),
    ] {
        let played = vec![burst([noise, &answer].concat())];
        cases.push(Case::good(format!("{name}-before"), requirement, played));
    }
    let request = frame(read(1, ADDRESS, 4));
    cases.push(Case::foreign("echo-before", LAYOUT, request.clone()));
    cases.push(Case::foreign("other-device-before", PARAMETERS, status(2, 0, &OTHER)));
    cases.push(Case::bad("other-device", PARAMETERS, status(2, 0, &OTHER)));
    cases.push(Case::bad("echo", LAYOUT, request));
    let instruction =
        Packet::Instruction { id: 1, instruction: 0x03, params: [&[0], &HELD[..]].concat().into() };
    cases.push(Case::bad("instruction-packet", LAYOUT, frame(instruction)));
    let mut reserved = changed(&answer, 3, |_| 0x01);
    WIRE.repair(&mut reserved);
    cases.push(Case::bad("other-reserved", "dynamixel2.packet.reserved", reserved));
    for length in 0..=3 {
        let mut short = changed(&answer, 5, |_| length);
        // With 2 and 3 there is room for a CRC, which is right.
        if length >= 2 {
            short.truncate(7 + usize::from(length));
        }
        WIRE.repair(&mut short);
        cases.push(Case::bad(format!("length-{length}"), "dynamixel2.packet.length.status", short));
    }
    let silent = Case::bad("late", "dynamixel2.receive.length", Vec::new());
    cases.push(Case { late: answer, next: PARAMETERS, ..silent });
    for number in 1..=7 {
        let told = Reported { id: 1, error: Some(number), ..Reported::default() };
        let due = Due { or: vec![Trouble::Status], ..all([told]) };
        let again = status(1, number, &[]);
        let name = format!("error-{number}");
        let fields = "dynamixel2.status-packet.error.fields";
        let refused = Case::good(name, fields, vec![burst(again.clone())]);
        cases.push(Case { again, due, ..refused });
    }
    for (name, held) in [("fewer-bytes", &HELD[..2]), ("more-bytes", &[HELD, OTHER].concat())] {
        let read = "dynamixel2.read.status";
        cases.push(Case { next: STREAM, ..Case::bad(name, read, status(1, 0, held)) });
    }
    cases
}

/// What is returned of each, and what the next Read returns.
pub(super) fn checks(author: &Author<'_>) -> Vec<Check> {
    let both = |case: Case| {
        let id = |about: &str| format!("dynamixel2.host.read.{}/{about}", case.name);
        let right = vec![burst(status(1, 0, &NEXT))];
        let next = step(read(1, 140, 4), vec![right.clone(), right.clone(), right]);
        let steps = vec![case.step(), next];
        let due = all([data(1, &NEXT)]);
        [
            author.returned(id("result"), case.requirement, vec![case.step()], case.due),
            author.returned(id("next"), case.next, steps, due),
        ]
    };
    let mut checks: Vec<_> = cases().into_iter().flat_map(both).collect();
    checks.extend(alert(author));
    checks.extend(nothing(author));
    checks
}

/// No answer, however often it is asked for, after one that was right.
fn nothing(author: &Author<'_>) -> Vec<Check> {
    let packet = || read(1, ADDRESS, 4);
    let right = step(packet(), vec![vec![burst(answer())]]);
    let damaged = vec![burst(changed(&answer(), 9, |byte| byte ^ 0x10))];
    let damaged = vec![damaged.clone(), damaged.clone(), damaged];
    let cases = [
        ("silence-after-right", PARAMETERS, Vec::new()),
        ("damaged-after-right", "dynamixel2.receive.crc", damaged),
    ];
    let check = |(name, requirement, answers): (&str, &str, _)| {
        let id = format!("dynamixel2.host.read.{name}/result");
        author.returned(id, requirement, vec![right.clone(), step(packet(), answers)], failed())
    };
    cases.into_iter().map(check).collect()
}

/// An answer with data and with the alert. What a call makes of the alert is unspecified.
fn alert(author: &Author<'_>) -> [Check; 2] {
    let id = |about: &str| format!("dynamixel2.host.read.alert/{about}");
    let fields = "dynamixel2.status-packet.error.fields";
    let answer = vec![burst(status(1, 0x80, &HELD))];
    let steps = vec![step(read(1, ADDRESS, 4), vec![answer.clone(), answer.clone(), answer])];
    let told = Reported { alert: Some(true), ..data(1, &HELD) };
    let due = Due { or: vec![Trouble::Status], ..all([told]) };
    let result = author.returned(id("result"), fields, steps, due);
    let recorded = Demand::record("What does a Read return whose answer has the alert?", []);
    let told = Check { id: id("told"), demand: recorded, ..result.clone() };
    [result, told]
}
