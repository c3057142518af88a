//! Answers to a read that are damaged, late, or of something else; and the next read after each.

use actucheck_spec::wire::innfos::{WIRE, reference};

use super::{
    ALWAYS, ECHO, ID, LAYOUT, NO_ANSWER, OTHER_ID, READ_POSITION, READ_SPEED, SIGN_OF_LIFE, TAIL,
    VERIFY, all, answered, burst, data, datagram, failed, frame, later, read, recorded, reply,
    request, step,
};
use crate::adapter::{Burst, Step};
use crate::suite::check::Check;
use crate::suite::due::Due;
use crate::suite::{Author, changed};

/// What the actuator holds.
const HELD: [u8; 4] = [0x00, 0xA6, 0x01, 0x83];
/// What it holds when it is asked again, so that one can tell which answer was taken.
const LATER: [u8; 4] = [0x00, 0xB7, 0x12, 0x94];
/// What the next read is answered, and what no answer holds.
const NEXT: [u8; 4] = [0x00, 0x17, 0x28, 0x39];
const OTHER: [u8; 4] = [0x00, 0x61, 0x72, 0x03];
/// The pause between two datagrams, which is much shorter than any time-out.
const PAUSE_MS: u32 = 3;

const LENGTH: &str = "innfos.frame.length";
const SIZES: &str = "innfos.read.sizes";

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
    /// What is asked, if the document leaves it unspecified.
    question: Option<&'static str>,
}

impl Case {
    /// Something that is no answer: the call fails, or asks again.
    fn bad(name: impl Into<String>, requirement: &'static str, played: &[u8]) -> Self {
        let due = Due { or: NO_ANSWER.to_vec(), ..all([data(ID, &LATER)]) };
        let good = Self::good(name, requirement, datagram(played));
        Self { again: reply(ID, READ_POSITION, &LATER), due, ..good }
    }

    /// Something in which the answer is found.
    fn good(name: impl Into<String>, requirement: &'static str, played: Vec<Burst>) -> Self {
        let (name, due, question) = (name.into(), all([data(ID, &HELD)]), None);
        Self { name, requirement, played, again: answer(), late: Vec::new(), due, question }
    }

    /// A datagram that must not be taken, before the answer, which need not be found.
    fn foreign(name: &str, bytes: Vec<u8>) -> Self {
        let due = Due { or: NO_ANSWER.to_vec(), ..all([data(ID, &HELD)]) };
        let played = vec![burst(bytes), later(PAUSE_MS, answer())];
        Self { due, ..Self::good(name, ECHO, played) }
    }

    /// Something that the document leaves unspecified.
    fn open(name: &str, question: &'static str, played: Vec<Burst>) -> Self {
        Self { question: Some(question), ..Self::good(name, LAYOUT, played) }
    }

    fn step(&self) -> Step {
        let again = datagram(&self.again);
        let answers = vec![self.played.clone(), again.clone(), again];
        Step { late: self.late.clone().into(), ..step(read(READ_POSITION), answers) }
    }
}

/// The right answer.
fn answer() -> Vec<u8> {
    reply(ID, READ_POSITION, &HELD)
}

fn cases() -> Vec<Case> {
    let mut cases = damaged();
    cases.extend(of_others());
    let answer = answer();
    let twice = vec![burst(answer.clone()), burst(answer.clone())];
    cases.push(Case::good("doubled", ALWAYS, twice));
    let silent = Case::bad("late", ALWAYS, &[]);
    cases.push(Case { late: answer.clone(), ..silent });
    for (name, held) in [("fewer-bytes", &HELD[..2]), ("more-bytes", &[HELD, OTHER].concat())] {
        cases.push(Case::bad(name, SIZES, &reply(ID, READ_POSITION, held)));
    }
    let (before, behind) = answer.split_at(reference::PREFIX);
    let other = reply(OTHER_ID, READ_POSITION, &OTHER);
    let together = |frames: [&[u8]; 2]| vec![burst(frames.concat())];
    cases.extend([
        Case::open(
            "split",
            "What does a read return whose answer comes in two datagrams?",
            vec![burst(before), later(PAUSE_MS, behind)],
        ),
        Case::open(
            "first-of-two",
            "What does a read return if a frame of another actuator follows in the datagram?",
            together([&answer, &other]),
        ),
        Case::open(
            "second-of-two",
            "What does a read return if a frame of another actuator is before it in the datagram?",
            together([&other, &answer]),
        ),
        Case::open(
            "noise-before",
            "What does a read return if other bytes are before it in the datagram?",
            together([&[0x00, 0x55], &answer]),
        ),
        Case::open(
            "noise-behind",
            "What does a read return if other bytes are behind it in the datagram?",
            together([&answer, &[0x00, 0x55]]),
        ),
    ]);
    cases
}

/// Each byte flipped, each end cut off, and each part of the frame wrong.
fn damaged() -> Vec<Case> {
    let answer = answer();
    let last = answer.len().saturating_sub(1);
    let mut cases = Vec::new();
    for place in 0..answer.len() {
        let requirement = match WIRE.part(&answer, place) {
            "header" => "innfos.frame.header",
            "address" | "command" => ECHO,
            "length" => LENGTH,
            "end" => TAIL,
            _ => VERIFY,
        };
        let flipped = changed(&answer, place, |byte| byte ^ 0x10);
        cases.push(Case::bad(format!("flip-{place:02}"), requirement, &flipped));
    }
    for place in 1..answer.len() {
        let requirement = if place == last { TAIL } else { LENGTH };
        let (cut, _) = answer.split_at(place);
        cases.push(Case::bad(format!("cut-{place:02}"), requirement, cut));
    }
    let data_end = reference::PREFIX + HELD.len();
    let with_crc = |crc: &[u8]| {
        let (before, _) = answer.split_at(data_end);
        [before, crc, answer.get(last..).unwrap_or_default()].concat()
    };
    let crc = reference::crc(&HELD);
    let mut turned = answer.clone();
    turned.swap(3, 4);
    cases.extend([
        Case::bad("length-more", LENGTH, &changed(&answer, 4, |length| length + 1)),
        Case::bad("length-less", LENGTH, &changed(&answer, 4, |length| length - 1)),
        Case::bad("length-low-byte-first", LENGTH, &turned),
        Case::bad("without-crc", "innfos.crc.reply", &with_crc(&[])),
        Case::bad("zero-crc", VERIFY, &with_crc(&[0, 0])),
        Case::bad("crc-high-byte-first", VERIFY, &with_crc(&crc.to_be_bytes())),
    ]);
    cases
}

/// Answers to something else.
fn of_others() -> Vec<Case> {
    let other_device = reply(OTHER_ID, READ_POSITION, &OTHER);
    let other_command = reply(ID, READ_SPEED, &OTHER);
    let sign_of_life = reply(ID, SIGN_OF_LIFE, &[0x01]);
    let echo = frame(&read(READ_POSITION));
    vec![
        Case::bad("other-device", ECHO, &other_device),
        Case::bad("other-command", ECHO, &other_command),
        Case::bad("sign-of-life", ECHO, &sign_of_life),
        Case::bad("echo", SIZES, &echo),
        Case::foreign("other-device-before", other_device),
        Case::foreign("other-command-before", other_command),
        Case::foreign("sign-of-life-before", sign_of_life),
    ]
}

/// What is returned of each, and what the next read returns.
pub(super) fn checks(author: Author<'_>) -> Vec<Check> {
    let both = |case: Case| {
        let id = |about: &str| format!("innfos.host.read.{}/{about}", case.name);
        let next = answered(read(READ_POSITION), datagram(&reply(ID, READ_POSITION, &NEXT)));
        let steps = vec![case.step(), next];
        let result =
            author.returned(id("result"), case.requirement, vec![case.step()], case.due.clone());
        let result = match case.question {
            Some(question) => recorded(result, question),
            None => result,
        };
        [result, author.returned(id("next"), ALWAYS, steps, all([data(ID, &NEXT)]))]
    };
    let mut checks: Vec<_> = cases().into_iter().flat_map(both).collect();
    checks.extend(nothing(author));
    checks.push(reordered(author));
    checks.push(of_all(author));
    checks
}

/// No answer, however often it is asked for, after one that was right.
fn nothing(author: Author<'_>) -> Vec<Check> {
    let right = answered(read(READ_POSITION), datagram(&answer()));
    let damaged = datagram(&changed(&answer(), 0, |byte| byte ^ 0x10));
    let cases = [
        ("silence-after-right", ALWAYS, Vec::new()),
        ("damaged-after-right", "innfos.frame.header", damaged),
    ];
    let check = |(name, requirement, played): (&str, &str, Vec<Burst>)| {
        let id = format!("innfos.host.read.{name}/result");
        let steps = vec![right.clone(), answered(read(READ_POSITION), played)];
        author.returned(id, requirement, steps, failed())
    };
    cases.into_iter().map(check).collect()
}

/// The answer to the call before, which had none in time, comes before the right one.
fn reordered(author: Author<'_>) -> Check {
    let silent = answered(read(READ_SPEED), Vec::new());
    let old = reply(ID, READ_SPEED, &OTHER);
    let played = vec![burst(old), later(PAUSE_MS, answer())];
    let due = Due { or: NO_ANSWER.to_vec(), ..all([data(ID, &HELD)]) };
    let steps = vec![silent, answered(read(READ_POSITION), played)];
    author.returned("innfos.host.read.reordered/result".to_owned(), ECHO, steps, due)
}

/// A read that goes to every actuator. Whether they answer is unspecified.
fn of_all(author: Author<'_>) -> Check {
    let held = [(ID, HELD), (OTHER_ID, OTHER)];
    let played = held.iter().map(|(id, held)| burst(reply(*id, READ_POSITION, held))).collect();
    let due = all(held.map(|(id, held)| data(id, &held)));
    let steps = vec![answered(request(0, READ_POSITION, &[]), played)];
    let id = "innfos.host.read.of-all/result".to_owned();
    let check = author.returned(id, "innfos.frame.address", steps, due);
    recorded(check, "What does a read of address 0 return that two actuators answer?")
}
