//! Faults that a bus may have: what is lost or changed on the way from the devices, and what happens to
//! the devices themselves.
//!
//! A fault is written as `flip:0.01` (a hundredth of all answers), `flip#5` (the fifth answer), `flip#5-`
//! (from the fifth on) or `flip` (every answer). Answers are counted over the whole bus, from 1. What is
//! left to chance comes from a seed: the same seed and the same requests have the same faults.

use std::mem;
use std::str::FromStr;
use std::time::Duration;

use proptest::prelude::RngExt;
use proptest::test_runner::TestRng;
use thiserror::Error;

use super::Chunk;
use crate::legible::{LONGEST_NAME, legible};
use crate::names::nearest;
use crate::suite::random::runner;

/// A fault, and the answers that have it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fault {
    what: What,
    when: When,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum When {
    Always,
    /// The answers with these numbers.
    Counted {
        first: u64,
        last: u64,
    },
    /// This share of all.
    Share(f64),
}

/// What goes wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum What {
    Line(OnLine),
    Device(OnDevice),
}

/// What goes wrong with an answer on the line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum OnLine {
    Flip,
    Drop,
    Add,
    Double,
    NoiseBefore,
    NoiseAfter,
    Babble,
    Split,
    Late(Duration),
    Lost,
}

/// What goes wrong with a device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum OnDevice {
    /// The answer has the ID of another device.
    OtherId,
    /// The devices lose their power and get it back; the answer is lost.
    Power,
    /// The devices have an alarm after the answer.
    Alarm(Alarm),
}

/// What devices may have an alarm for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Alarm {
    LowVoltage,
    Overheating,
    Overload,
    Encoder,
}

/// The faults by name, in the order of the help.
const FAULTS: [(&str, What, &str); 16] = [
    ("flip", What::Line(OnLine::Flip), "a bit is another"),
    ("drop", What::Line(OnLine::Drop), "a byte is missing"),
    ("add", What::Line(OnLine::Add), "there is a byte more"),
    ("double", What::Line(OnLine::Double), "a byte comes twice"),
    ("noise-before", What::Line(OnLine::NoiseBefore), "bytes of noise come before it"),
    ("noise-after", What::Line(OnLine::NoiseAfter), "bytes of noise come after it"),
    ("babble", What::Line(OnLine::Babble), "noise comes instead of it"),
    ("split", What::Line(OnLine::Split), "it comes in two pieces, 5 ms apart"),
    (
        "late",
        What::Line(OnLine::Late(Duration::from_millis(50))),
        "it comes late; late=200ms says how much",
    ),
    ("lost", What::Line(OnLine::Lost), "nothing comes"),
    ("other-id", What::Device(OnDevice::OtherId), "it has the ID of another device"),
    (
        "power",
        What::Device(OnDevice::Power),
        "nothing comes, as all devices lose their power; it is back at once",
    ),
    (
        "low-voltage",
        What::Device(OnDevice::Alarm(Alarm::LowVoltage)),
        "after it the devices have this alarm, if they know it",
    ),
    (
        "overheating",
        What::Device(OnDevice::Alarm(Alarm::Overheating)),
        "after it the devices have this alarm, if they know it",
    ),
    (
        "overload",
        What::Device(OnDevice::Alarm(Alarm::Overload)),
        "after it the devices have this alarm, if they know it",
    ),
    (
        "encoder",
        What::Device(OnDevice::Alarm(Alarm::Encoder)),
        "after it the devices have this alarm, if they know it",
    ),
];

/// Why words are no fault.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum FaultError {
    /// There is none of this name.
    #[error("no fault is called `{name}`; {hint}")]
    Unknown {
        /// The name.
        name: String,
        /// What may be meant.
        hint: String,
    },
    /// It does not say which answers.
    #[error(
        "`{0}` does not say which answers; write flip#5 for the fifth, flip#5- from it on, flip:0.01 for one in a hundred"
    )]
    When(String),
    /// It has no such time.
    #[error("`{0}` has no time; write it as late=200ms")]
    Time(String),
}

impl Fault {
    /// The names, each with what is wrong with an answer.
    pub fn names() -> impl Iterator<Item = (&'static str, &'static str)> {
        FAULTS.into_iter().map(|(name, _, words)| (name, words))
    }
}

impl FromStr for Fault {
    type Err = FaultError;

    fn from_str(text: &str) -> Result<Self, FaultError> {
        let shown = || legible(text, LONGEST_NAME);
        let place = text.find(['#', ':']).unwrap_or(text.len());
        let (what, when) = text.split_at_checked(place).unwrap_or((text, ""));
        let (name, time) =
            what.split_once('=').map_or((what, None), |(name, time)| (name, Some(time)));
        let found = FAULTS.into_iter().find(|(known, ..)| *known == name);
        let (_, mut what, _) = found.ok_or_else(|| unknown(name))?;
        if let Some(time) = time {
            let What::Line(OnLine::Late(_)) = what else { return Err(FaultError::Time(shown())) };
            what = What::Line(OnLine::Late(
                milliseconds(time).ok_or_else(|| FaultError::Time(shown()))?,
            ));
        }
        let when = When::of(when).ok_or_else(|| FaultError::When(shown()))?;
        Ok(Self { what, when })
    }
}

fn unknown(name: &str) -> FaultError {
    let names = || FAULTS.iter().map(|(name, ..)| (*name).to_owned());
    let all = || format!("there are {}", names().collect::<Vec<_>>().join(", "));
    let hint = nearest(name, names()).map_or_else(all, |meant| format!("did you mean `{meant}`?"));
    FaultError::Unknown { name: legible(name, LONGEST_NAME), hint }
}

fn milliseconds(text: &str) -> Option<Duration> {
    text.strip_suffix("ms")?.parse().ok().map(Duration::from_millis)
}

impl When {
    fn of(text: &str) -> Option<Self> {
        if text.is_empty() {
            return Some(Self::Always);
        }
        if let Some(share) = text.strip_prefix(':') {
            let share = share.parse().ok().filter(|share| (0.0..=1.0).contains(share));
            return share.map(Self::Share);
        }
        let numbers = text.strip_prefix('#')?;
        let (first, last) = match numbers.split_once('-') {
            Some((first, "")) => (first.parse().ok()?, u64::MAX),
            Some((first, last)) => (first.parse().ok()?, last.parse().ok()?),
            None => (numbers.parse().ok()?, numbers.parse().ok()?),
        };
        (1..=last).contains(&first).then_some(Self::Counted { first, last })
    }
}

/// The faults of a bus, with the chance that decides.
pub(super) struct Faults {
    list: Vec<Fault>,
    chance: TestRng,
    /// The answers so far.
    count: u64,
}

impl Faults {
    pub(super) fn new(faults: Vec<Fault>, seed: u64) -> Self {
        Self { list: faults, chance: runner(seed).rng().clone(), count: 0 }
    }

    /// What is wrong with the next answer.
    pub(super) fn next(&mut self) -> Vec<What> {
        self.count += 1;
        let Self { list, chance, count } = self;
        let hits = |fault: &&Fault| match fault.when {
            When::Always => true,
            When::Counted { first, last } => (first..=last).contains(count),
            When::Share(share) => chance.random_bool(share),
        };
        list.iter().filter(hits).map(|fault| fault.what).collect()
    }

    /// Makes of an answer what arrives of it.
    pub(super) fn strike(&mut self, fault: OnLine, answer: &mut Vec<Chunk>) {
        let Some(chunk) = answer.first_mut().filter(|chunk| !chunk.bytes.is_empty()) else {
            return;
        };
        let (bytes, chance) = (&mut chunk.bytes, &mut self.chance);
        let place = chance.random_range(0..bytes.len());
        match fault {
            OnLine::Flip => {
                let bit = 1 << chance.random_range(0..8);
                if let Some(byte) = bytes.get_mut(place) {
                    *byte ^= bit;
                }
            }
            OnLine::Drop => drop(bytes.remove(place)),
            OnLine::Add => bytes.insert(place, chance.random()),
            OnLine::Double => bytes.insert(place, bytes.get(place).copied().unwrap_or_default()),
            OnLine::NoiseBefore => *bytes = [noise(chance), mem::take(bytes)].concat(),
            OnLine::NoiseAfter => bytes.extend(noise(chance)),
            OnLine::Babble => *bytes = noise(chance),
            // Neither piece is empty.
            OnLine::Split if bytes.len() > 1 => {
                let rest = bytes.split_off(chance.random_range(1..bytes.len()));
                let at = chunk.at + PAUSE;
                answer.insert(1, Chunk { at, bytes: rest });
            }
            OnLine::Split => {}
            OnLine::Late(time) => answer.iter_mut().for_each(|chunk| chunk.at += time),
            OnLine::Lost => answer.clear(),
        }
    }
}

/// Between the pieces of an answer.
const PAUSE: Duration = Duration::from_millis(5);

/// Up to 16 bytes.
fn noise(chance: &mut TestRng) -> Vec<u8> {
    let length = chance.random_range(1..=16);
    (0..length).map(|_| chance.random()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(text: &str) -> Result<Fault, FaultError> {
        text.parse()
    }

    #[test]
    fn a_fault_says_what_and_when() {
        let flip = What::Line(OnLine::Flip);
        for (text, when) in [
            ("flip", When::Always),
            ("flip#5", When::Counted { first: 5, last: 5 }),
            ("flip#5-", When::Counted { first: 5, last: u64::MAX }),
            ("flip#5-7", When::Counted { first: 5, last: 7 }),
            ("flip:0.25", When::Share(0.25)),
        ] {
            assert_eq!(of(text), Ok(Fault { what: flip, when }));
        }
        let late = What::Line(OnLine::Late(Duration::from_millis(7)));
        assert_eq!(of("late=7ms"), Ok(Fault { what: late, when: When::Always }));
        for text in ["flip#0", "flip#7-5", "flip#", "flip:1.5", "flip:-1", "flip:NaN", "flip#x"] {
            assert_eq!(of(text), Err(FaultError::When(text.to_owned())));
        }
        for text in ["late=7", "late=ms", "late=7s", "flip=7ms"] {
            assert_eq!(of(text), Err(FaultError::Time(text.to_owned())));
        }
        let hint = of("flop").unwrap_err().to_string();
        assert_eq!(hint, "no fault is called `flop`; did you mean `flip`?");
    }

    /// Every fault changes an answer in its own way, the same for the same seed.
    #[test]
    fn a_seed_strikes_again_in_the_same_way() {
        let before = Chunk { at: Duration::ZERO, bytes: (0..40).collect() };
        let struck = |fault, seed| {
            let mut answer = vec![before.clone()];
            Faults::new(Vec::new(), seed).strike(fault, &mut answer);
            answer
        };
        let whole = |answer: &[Chunk]| {
            answer.iter().flat_map(|chunk| chunk.bytes.clone()).collect::<Vec<_>>()
        };
        for seed in 0..50 {
            for (name, what, _) in FAULTS {
                let What::Line(fault) = what else { continue };
                let answer = struck(fault, seed);
                assert_eq!(answer, struck(fault, seed), "{name}");
                assert_ne!(answer, std::slice::from_ref(&before), "{name}");
                assert!(answer.iter().all(|chunk| !chunk.bytes.is_empty()), "{name}");
                let bytes = whole(&answer);
                let (more, less) = (bytes.len() > 40, bytes.len() < 40);
                let expected = match fault {
                    OnLine::Drop | OnLine::Babble | OnLine::Lost => (false, true),
                    OnLine::Flip | OnLine::Split | OnLine::Late(_) => (false, false),
                    _ => (true, false),
                };
                assert_eq!((more, less), expected, "{name}: {bytes:?}");
            }
        }
        let flips: Vec<_> = (0..8).map(|seed| struck(OnLine::Flip, seed)).collect();
        assert!(flips.iter().any(|other| *other != flips[0]));
    }

    #[test]
    fn a_share_of_the_answers_has_the_fault() {
        let mut faults = Faults::new(vec![of("flip:0.1").unwrap(), of("lost#3-4").unwrap()], 1);
        let hits: Vec<_> = (0..1000).map(|_| faults.next()).collect();
        let lost: Vec<_> =
            (0..1000).filter(|at| hits[*at].contains(&What::Line(OnLine::Lost))).collect();
        assert_eq!(lost, [2, 3]);
        let flips = hits.iter().filter(|hit| hit.contains(&What::Line(OnLine::Flip))).count();
        assert!((60..140).contains(&flips), "{flips}");
    }
}
