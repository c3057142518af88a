//! What a device must answer, and the judgement of what came back.

mod profile;

use std::fmt;

use actucheck_spec::model::HexBytes;
use actucheck_spec::wire::{Packet, Wire};
use serde::{Deserialize, Serialize};

use super::device;
use crate::adapter::{Asked, Bits, Heard, Question, Reported};
use crate::verdict::Verdict;

pub(super) use self::profile::behaviour;

/// What must come back in a step: one of these rows of answers, and nothing else.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Wanted(pub Vec<Vec<Like>>);

/// What an answer must say. What is absent may be anything; the alert always may.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Like {
    /// The ID that it comes from.
    pub id: u8,
    /// Its error number.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub error: Option<u8>,
    /// Its data, part by part.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub data: Option<Vec<Part>>,
}

/// A part of the data of an answer.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Part {
    /// These bytes.
    Bytes(HexBytes),
    /// So many bytes.
    Any(usize),
    /// Bytes that the first answer to an earlier step had.
    Same {
        /// The step, from 0.
        step: usize,
        /// Where they began in its data.
        from: usize,
        /// How many they are.
        count: usize,
    },
    /// Four bytes, low byte first: the number that the first answer to an earlier step was, and more.
    Moved {
        /// The step, from 0.
        step: usize,
        /// How much more.
        by: i64,
        /// How far it may be off: what is measured is never quite still.
        within: i64,
    },
    /// Without this the check is not about the device: an answer without an error, with a number of so many bytes,
    /// which has some bits.
    Given {
        /// What the device needs, in words after "it needs".
        what: String,
        /// How many bytes it has.
        size: usize,
        /// The bits.
        has: Bits,
    },
    /// No bytes, in an answer that has the alert.
    Alert,
    /// A register of so many bytes that is not 0 exactly if the answer has the alert.
    Alarms(usize),
    /// A signed number of so many bytes, high byte first, between two others.
    Between {
        /// How many bytes it has.
        size: usize,
        /// The lowest that it may be.
        lowest: i64,
        /// The highest that it may be.
        highest: i64,
    },
    /// A number of so many bytes, low byte first, which has some bits.
    Bits {
        /// How many bytes it has.
        size: usize,
        /// The bits.
        has: Bits,
    },
    /// Four bytes, low byte first: a signed number between two others.
    Number {
        /// The lowest that it may be.
        lowest: i64,
        /// The highest that it may be.
        highest: i64,
    },
}

/// What came back in a step.
struct Told {
    answers: Vec<Reported>,
    /// Bytes that are in no packet.
    stray: usize,
}

impl Told {
    fn of(wire: Wire, asked: &Asked, heard: &Heard) -> Self {
        let bytes = heard.received();
        let packets = asked.packets(wire, &bytes);
        let size = |packet: &Packet| size_in(wire, packet, &bytes);
        let found: usize = packets.iter().map(size).sum();
        let answers = packets.iter().flat_map(|packet| device::reported(wire, packet)).collect();
        Self { answers, stray: bytes.len().saturating_sub(found) + heard.more }
    }
}

/// What came back in each step.
fn all_told(wire: Wire, steps: &[Asked], heard: &[Heard]) -> Vec<Told> {
    steps.iter().zip(heard).map(|(asked, heard)| Told::of(wire, asked, heard)).collect()
}

/// How many bytes of these a packet has: some may be written in several ways.
fn size_in(wire: Wire, packet: &Packet, bytes: &[u8]) -> usize {
    let (frame, context) = (wire.encode(packet).unwrap_or_default(), wire.context(packet));
    if !wire.is_unspecified(&frame, &context) {
        return frame.len();
    }
    let is_it = |bytes: &[u8]| wire.decode(bytes, &context).is_ok_and(|found| found == *packet);
    let mut sizes = frame.len()..=bytes.len();
    sizes.find(|size| bytes.windows(*size).any(is_it)).unwrap_or_default()
}

/// The verdict on what came back, and the reason.
pub(super) fn judge(question: &Question, wanted: &[Wanted], heard: &[Heard]) -> (Verdict, String) {
    let Question::Device { wire, steps, .. } = question else {
        return (Verdict::NotRun, "the demand is not one on a device".to_owned());
    };
    let told = all_told(*wire, steps, heard);
    for (place, (wanted, came)) in wanted.iter().zip(&told).enumerate() {
        if !wanted.is_met(came, &told) {
            let step =
                if steps.len() > 1 { format!("step {}: ", place + 1) } else { String::new() };
            return (Verdict::Fail, format!("{step}{came} came back, but it must be {wanted}"));
        }
        if let Some(what) = wanted.lacks(came) {
            return (Verdict::Skip, format!("it needs {what}"));
        }
    }
    if told.len() < wanted.len() {
        return (Verdict::NotRun, "it was not asked to the end".to_owned());
    }
    (Verdict::Pass, String::new())
}

/// What the device does in the first step that is wrong, in words that leave out all numbers.
pub(crate) fn symptom(
    question: &Question,
    wanted: &[Wanted],
    heard: &[Heard],
) -> Option<&'static str> {
    let Question::Device { wire, steps, .. } = question else { return None };
    let told = all_told(*wire, steps, heard);
    let (wanted, came) =
        wanted.iter().zip(&told).find(|(wanted, came)| !wanted.is_met(came, &told))?;
    if came.stray > 0 {
        return Some("sends what is no packet");
    }
    let counts = || wanted.0.iter().map(Vec::len);
    if counts().all(|count| count > came.answers.len()) {
        return Some("does not answer");
    }
    if counts().all(|count| count < came.answers.len()) {
        return Some("answers what it must not");
    }
    let is_error = |row: &Vec<Like>| {
        let mut pairs = row.iter().zip(&came.answers);
        pairs.all(|(like, answer)| {
            like.error.is_none_or(|error| answer.error.unwrap_or_default() == error)
        })
    };
    let rows = wanted.0.iter().filter(|row| row.len() == came.answers.len());
    let is_right = rows.into_iter().any(is_error);
    Some(if is_right { "answers with other data" } else { "answers with another error" })
}

impl Wanted {
    fn is_met(&self, came: &Told, all: &[Told]) -> bool {
        let fits = |row: &Vec<Like>| {
            row.len() == came.answers.len()
                && row.iter().zip(&came.answers).all(|(like, answer)| like.fits(answer, all))
        };
        came.stray == 0 && self.0.iter().any(fits)
    }
}

impl Wanted {
    /// What the device must be in for the check, and is not.
    fn lacks(&self, came: &Told) -> Option<&str> {
        let answer = came.answers.first()?;
        let (data, is_done) = (answer.data.as_ref()?, answer.error.unwrap_or_default() == 0);
        let parts = self.0.iter().flatten().filter_map(|like| like.data.as_ref()).flatten();
        parts.into_iter().find_map(|part| match part {
            Part::Given { what, has, .. } => {
                (!is_done || !has.are_in(&data.0)).then_some(what.as_str())
            }
            _ => None,
        })
    }
}

impl Like {
    fn fits(&self, answer: &Reported, all: &[Told]) -> bool {
        self.id == answer.id
            && self.error.is_none_or(|error| answer.error.unwrap_or_default() == error)
            && self.data.as_ref().is_none_or(|parts| are_in(parts, answer, all))
    }
}

fn are_in(parts: &[Part], answer: &Reported, all: &[Told]) -> bool {
    let mut rest = answer.data.as_ref().map_or(&[][..], |data| data.0.as_slice());
    let alert = answer.alert.unwrap_or_default();
    for part in parts {
        let Some((bytes, after)) = rest.split_at_checked(part.size()) else { return false };
        rest = after;
        if !part.is(bytes, alert, all) {
            return false;
        }
    }
    rest.is_empty()
}

impl Part {
    /// How many bytes it has.
    pub(super) const fn size(&self) -> usize {
        match self {
            Self::Bytes(bytes) => bytes.0.len(),
            Self::Any(size)
            | Self::Alarms(size)
            | Self::Same { count: size, .. }
            | Self::Between { size, .. }
            | Self::Given { size, .. }
            | Self::Bits { size, .. } => *size,
            Self::Moved { .. } | Self::Number { .. } => size_of::<i32>(),
            Self::Alert => 0,
        }
    }

    fn is(&self, bytes: &[u8], alert: bool, all: &[Told]) -> bool {
        match self {
            Self::Bytes(expected) => expected.0 == bytes,
            Self::Any(_) | Self::Given { .. } => true,
            Self::Alert => alert,
            Self::Alarms(_) => bytes.iter().any(|byte| *byte != 0) == alert,
            Self::Same { step, from, count } => {
                let earlier = all.get(*step).and_then(|told| told.answers.first()?.data.as_ref());
                earlier.and_then(|data| data.get(*from..from + count)) == Some(bytes)
            }
            Self::Between { lowest, highest, .. } => {
                let sign = bytes.first().map_or(0, |first| if *first < 0x80 { 0 } else { -1 });
                let number =
                    bytes.iter().fold(sign, |number: i64, byte| (number << 8) | i64::from(*byte));
                (*lowest..=*highest).contains(&number)
            }
            Self::Bits { has, .. } => has.are_in(bytes),
            Self::Number { lowest, highest } => {
                number(bytes).is_some_and(|number| (*lowest..=*highest).contains(&number))
            }
            Self::Moved { step, by, within } => {
                let data = all.get(*step).and_then(|told| told.answers.first()?.data.as_ref());
                let (before, now) = (data.and_then(|data| number(&data.0)), number(bytes));
                before.zip(now).is_some_and(|(before, now)| (now - before - by).abs() <= *within)
            }
        }
    }
}

/// A signed number of four bytes, low byte first.
fn number(bytes: &[u8]) -> Option<i64> {
    Some(i32::from_le_bytes(bytes.try_into().ok()?).into())
}

/// In words, such as `nothing`, or `device 1: error 0, 3 bytes; or nothing`.
impl fmt::Display for Wanted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let row = |row: &Vec<Like>| match row.as_slice() {
            [] => "nothing".to_owned(),
            row => row.iter().map(ToString::to_string).collect::<Vec<_>>().join(" and "),
        };
        f.write_str(&self.0.iter().map(row).collect::<Vec<_>>().join("; or "))
    }
}

impl fmt::Display for Like {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { id, error, data } = self;
        let data = data.as_ref().map(|parts| {
            let parts: Vec<_> = parts.iter().map(ToString::to_string).collect();
            if parts.is_empty() { "no data".to_owned() } else { parts.join(", then ") }
        });
        let facts = [error.map(|error| format!("error {error}")), data];
        let facts: Vec<_> = facts.into_iter().flatten().collect();
        write!(f, "device {id}: {}", facts.join(", "))
    }
}

impl fmt::Display for Part {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Bytes(bytes) => write!(f, "data {bytes}"),
            Self::Alarms(size) => write!(f, "{size} bytes, which are 0 unless there is the alert"),
            Self::Alert => f.write_str("the alert"),
            Self::Any(1) => f.write_str("1 byte"),
            Self::Any(size) => write!(f, "{size} bytes"),
            Self::Same { step, .. } => write!(f, "what step {} told", step + 1),
            Self::Moved { step, by, within } => {
                write!(f, "what step {} told and {by} more, within {within}", step + 1)
            }
            Self::Given { size, what, .. } => write!(f, "{size} bytes, and for this check {what}"),
            Self::Between { size, lowest, highest } => {
                write!(f, "{size} bytes, a number from {lowest} to {highest}")
            }
            Self::Number { lowest, highest } => {
                write!(f, "4 bytes, a number from {lowest} to {highest}")
            }
            Self::Bits { size, has: Bits { lowest, width, one_of } } => {
                let values: Vec<_> = one_of.iter().map(ToString::to_string).collect();
                let last = u32::from(*lowest) + u32::from(*width) - 1;
                write!(
                    f,
                    "{size} bytes, bits {lowest} to {last} of which are {}",
                    values.join(" or ")
                )
            }
        }
    }
}

impl fmt::Display for Told {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let answers = self.answers.iter().map(ToString::to_string);
        let stray = match self.stray {
            0 => None,
            1 => Some("1 byte of no packet".to_owned()),
            many => Some(format!("{many} bytes of no packet")),
        };
        let all: Vec<_> = answers.chain(stray).collect();
        f.write_str(&if all.is_empty() { "nothing".to_owned() } else { all.join("; ") })
    }
}
