//! Answers of one device that are damaged, late, or of something else; and the next Read after each.

use actucheck_spec::wire::dynamixel2::WIRE;

use super::{
    NO_ANSWER, Right, all, burst, data, failed, frame, instruction, later, read, refused, status,
    step,
};
use crate::adapter::{Burst, Reported, Step, Trouble};
use crate::suite::check::{Check, Demand};
use crate::suite::due::Due;
use crate::suite::{Author, changed};

/// What the next Read is answered, and what no answer holds.
const NEXT: [u8; 4] = [0x17, 0x28, 0x39, 0x4A];
const OTHER: [u8; 4] = [0x61, 0x72, 0x03, 0x14];
/// The pause between two parts of an answer, which is much shorter than any time-out.
pub(super) const PAUSE_MS: u32 = 3;
/// A line that does not rest: a byte of noise each few milliseconds, for longer than any call may take.
const DRIP_MS: u32 = 5;
const DRIPS: u32 = 400;

pub(super) const STREAM: &str = "dynamixel2.receive.stream";
const RESUME: &str = "dynamixel2.receive.resume";
pub(super) const HEADER: &str = "dynamixel2.receive.header";
pub(super) const CRC: &str = "dynamixel2.receive.crc";
pub(super) const LENGTH: &str = "dynamixel2.receive.length";
pub(super) const LAYOUT: &str = "dynamixel2.status-packet.layout";
pub(super) const PARAMETERS: &str = "dynamixel2.status-packet.parameters";
pub(super) const FIELDS: &str = "dynamixel2.status-packet.error.fields";

/// What is played instead of a right answer, and what must come of it.
struct Case {
    name: String,
    requirement: &'static str,
    played: Vec<Burst>,
    /// What comes only when the call has returned.
    late: Vec<u8>,
    due: Due,
    /// The requirement on the next Read.
    next: &'static str,
}

/// Writes cases of a call to one device.
struct Cases<'a>(&'a Right);

impl Cases<'_> {
    /// Something that is no answer.
    fn bad(&self, name: impl Into<String>, requirement: &'static str, played: Vec<u8>) -> Case {
        let good = self.good(name, requirement, vec![burst(played)]);
        Case { due: self.0.no_answer(), next: RESUME, ..good }
    }

    /// Something in which the answer is found.
    fn good(&self, name: impl Into<String>, requirement: &'static str, played: Vec<Burst>) -> Case {
        let (name, due) = (name.into(), self.0.due.clone());
        Case { name, requirement, played, late: Vec::new(), due, next: STREAM }
    }

    /// Something that must not be taken, before the answer, which need not be found.
    fn foreign(&self, name: &str, requirement: &'static str, mut bytes: Vec<u8>) -> Case {
        bytes.extend(&self.0.answer);
        let due = Due { or: NO_ANSWER.to_vec(), ..self.0.due.clone() };
        Case { due, ..self.good(name, requirement, vec![burst(bytes)]) }
    }

    /// Answers that are damaged, or come in parts.
    fn damaged(&self) -> Vec<Case> {
        let answer = &self.0.answer;
        let mut cases = Vec::new();
        for place in 0..answer.len() {
            let requirement = if place < 4 { HEADER } else { CRC };
            let flipped = changed(answer, place, |byte| byte ^ 0x10);
            cases.push(self.bad(format!("flip-{place:02}"), requirement, flipped));
        }
        for place in 0..answer.len() {
            let (before, after) = answer.split_at(place);
            cases.push(self.bad(format!("cut-{place:02}"), LENGTH, before.to_vec()));
            if place > 0 {
                let parts = vec![burst(before), later(PAUSE_MS, after)];
                cases.push(self.good(format!("split-{place:02}"), STREAM, parts));
            }
        }
        let mut reserved = changed(answer, 3, |_| 0x01);
        WIRE.repair(&mut reserved);
        cases.push(self.bad("other-reserved", "dynamixel2.packet.reserved", reserved));
        for length in 0..=3 {
            let mut short = changed(answer, 5, |_| length);
            // With 2 and 3 there is room for a CRC, which is right.
            if length >= 2 {
                short.truncate(7 + usize::from(length));
            }
            WIRE.repair(&mut short);
            let requirement = "dynamixel2.packet.length.status";
            cases.push(self.bad(format!("length-{length}"), requirement, short));
        }
        cases
    }

    /// Answers with something before or behind them, and packets that are no answer.
    fn foreigners(&self) -> Vec<Case> {
        let answer = &self.0.answer;
        let mut cases = Vec::new();
        let doubled = vec![burst(answer.repeat(2))];
        cases.push(Case { next: PARAMETERS, ..self.good("doubled", STREAM, doubled) });
        for (name, requirement, noise) in [
            ("noise", HEADER, &[0x00, 0x55, 0xAA][..]),
            ("noise-like-header", HEADER, &[0xFF]),
            ("false-header", RESUME, &[0xFF, 0xFF, 0xFD, 0x00, 0x01]),
        ] {
            let played = vec![burst([noise, answer].concat())];
            cases.push(self.good(format!("{name}-before"), requirement, played));
        }
        let request = frame(self.0.packet.clone());
        let mut other = changed(answer, 4, |_| 2);
        WIRE.repair(&mut other);
        let before = if self.0.has_data() { status(2, 0, &OTHER) } else { other.clone() };
        cases.push(self.foreign("echo-before", LAYOUT, request.clone()));
        cases.push(self.foreign("other-device-before", PARAMETERS, before));
        cases.push(self.bad("other-device", PARAMETERS, other));
        cases.push(self.bad("echo", LAYOUT, request));
        let instruction = instruction(1, 0x03, [&[0], &OTHER[..]].concat());
        cases.push(self.bad("instruction-packet", LAYOUT, frame(instruction)));
        let silent = self.bad("late", LENGTH, Vec::new());
        cases.push(Case { late: answer.clone(), next: PARAMETERS, ..silent });
        cases
    }

    /// Answers that tell an error. Who answers a Ping is there, whatever it says.
    fn errors(&self) -> Vec<Case> {
        if self.0.told().model_number.is_some() {
            return Vec::new();
        }
        let case = |name: String, error: u8| {
            let alert = (error & 0x80 != 0).then_some(true);
            let told = Reported { id: 1, error: Some(error & 0x7F), alert, ..Reported::default() };
            // A host need not await an answer without data.
            let due = Due { partly: !self.0.has_data(), ..refused(told) };
            Case { due, ..self.good(name, FIELDS, vec![burst(status(1, error, &[]))]) }
        };
        let mut cases: Vec<_> =
            (1..=7).map(|number| case(format!("error-{number}"), number)).collect();
        cases.push(case("alert-and-error".to_owned(), 0x84));
        cases
    }

    /// Answers to a Read with another number of bytes than it asks for.
    fn of_read(&self) -> Vec<Case> {
        let Some(held) = self.0.told().data else { return Vec::new() };
        let more = [&held[..], &OTHER].concat();
        let sizes = [("fewer-bytes", held.get(..2).unwrap_or_default()), ("more-bytes", &more)];
        let case = |(name, held): (&str, &[u8])| Case {
            next: STREAM,
            ..self.bad(name, "dynamixel2.read.status", status(1, 0, held))
        };
        sizes.into_iter().map(case).collect()
    }
}

/// What is returned of each. After each answer to a Read, and after those of another call that leave
/// something behind, what the next Read returns.
pub(super) fn checks(author: &Author<'_>, right: &Right) -> Vec<Check> {
    if !right.is_to_one() {
        return Vec::new();
    }
    let is_read = right.told().data.is_some();
    let leaves = |name: &str| {
        let last = right.answer.len().saturating_sub(1);
        let (cut, flip) = (format!("cut-{last:02}"), format!("flip-{last:02}"));
        let others = ["doubled", "late", "other-device-before", "false-header-before", "error-1"];
        is_read || others.contains(&name) || name == cut || name == flip
    };
    let call = right.name();
    let both = |case: Case| {
        let id = |about: &str| format!("dynamixel2.host.{call}.{}/{about}", case.name);
        let answered = Step { late: case.late.into(), ..right.answered(case.played) };
        let next = vec![burst(status(1, 0, &NEXT))];
        let next = step(read(1, 140, 4), vec![next.clone(), next.clone(), next]);
        let steps = vec![answered.clone(), next];
        let result = author.returned(id("result"), case.requirement, vec![answered], case.due);
        let next = author.returned(id("next"), case.next, steps, all([data(1, &NEXT)]));
        [Some(result), leaves(&case.name).then_some(next)]
    };
    let cases = Cases(right);
    let all = [cases.damaged(), cases.foreigners(), cases.errors(), cases.of_read()];
    let mut checks: Vec<_> = all.into_iter().flatten().flat_map(both).flatten().collect();
    checks.extend(alert(author, right));
    if is_read {
        checks.extend(nothing(author, right));
    }
    if !right.has_data() {
        checks.push(silence(author, right));
    }
    checks
}

/// No answer, however often it is asked for, after one that was right; and noise without end.
fn nothing(author: &Author<'_>, right: &Right) -> Vec<Check> {
    let damaged = vec![burst(changed(&right.answer, 9, |byte| byte ^ 0x10))];
    let cases =
        [("silence-after-right", PARAMETERS, Vec::new()), ("damaged-after-right", CRC, damaged)];
    let check = |(name, requirement, answer): (&str, &str, _)| {
        let id = format!("dynamixel2.host.read.{name}/result");
        author.returned(id, requirement, vec![right.step(), right.answered(answer)], failed())
    };
    let mut checks: Vec<_> = cases.into_iter().map(check).collect();
    let drips = (1..=DRIPS).map(|drip| later(drip * DRIP_MS, [0])).collect();
    let id = "dynamixel2.host.read.drip/result".to_owned();
    let steps = vec![step(right.packet.clone(), vec![drips])];
    checks.push(author.returned(id, HEADER, steps, failed()));
    checks
}

/// What a call without data returns that nothing answers.
fn silence(author: &Author<'_>, right: &Right) -> Check {
    let call = right.name();
    let question = format!("What does {call} return that nothing answers?");
    let id = format!("dynamixel2.host.{call}.silence/result");
    let [_, requirement] = right.requirements;
    let silent = author.returned(id, requirement, vec![right.answered(Vec::new())], all([]));
    Check { demand: Demand::record(&question, []), ..silent }
}

/// The right answer with the alert. What a call makes of the alert is unspecified.
fn alert(author: &Author<'_>, right: &Right) -> [Check; 2] {
    let call = right.name();
    let id = |about: &str| format!("dynamixel2.host.{call}.alert/{about}");
    let mut answer = changed(&right.answer, 8, |_| 0x80);
    WIRE.repair(&mut answer);
    let steps = vec![right.answered(vec![burst(answer)])];
    let told = Reported { alert: Some(true), ..right.told() };
    let due = Due { partly: !right.has_data(), or: vec![Trouble::Status], ..all([told]) };
    let result = author.returned(id("result"), FIELDS, steps, due);
    let question = format!("What does {call} return whose answer has the alert?");
    let told = Check { id: id("told"), demand: Demand::record(&question, []), ..result.clone() };
    [result, told]
}
