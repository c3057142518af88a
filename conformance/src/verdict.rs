//! The verdict on an answer, and the outcome of a check.

mod schema;

use std::collections::BTreeMap;
use std::fmt;

use actucheck_spec::model::{HexBytes, Level};
use schemars::JsonSchema;
use serde::{Deserialize, Deserializer, Serialize};

use crate::adapter::{Output, Question};
use crate::explain::mistake;

/// The result of a check in one word.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// The answer is right.
    Pass,
    /// The answer is wrong.
    Fail,
    /// The answer depends on what was asked before, or on time: asked again, it is another one.
    Flaky,
    /// The answer breaks a recommendation, or rejects the input for the wrong reason.
    Warn,
    /// The documents leave it unspecified; the answer is noted, not judged.
    Recorded,
    /// The subject does not offer the op.
    Skip,
    /// There was no answer in time.
    Timeout,
    /// The adapter ended instead of answering.
    Crash,
    /// The answer violates the adapter protocol.
    AdapterFault,
    /// It was not asked: the adapter does not start again, or such questions cost it too often.
    NotRun,
    /// The answer is wrong, as the expected-failures file says.
    ExpectedFailure,
    /// The answer is right, although the expected-failures file says otherwise.
    UnexpectedPass,
}

impl Verdict {
    /// Every verdict, in the order of reports.
    pub const ALL: [Self; 12] = [
        Self::Pass,
        Self::Fail,
        Self::Flaky,
        Self::Warn,
        Self::Recorded,
        Self::Skip,
        Self::Timeout,
        Self::Crash,
        Self::AdapterFault,
        Self::NotRun,
        Self::ExpectedFailure,
        Self::UnexpectedPass,
    ];

    /// Every verdict, the worst one first: failures, then what could not be asked, then passes.
    const WORST_FIRST: [Self; 12] = [
        Self::Fail,
        Self::UnexpectedPass,
        Self::Crash,
        Self::Timeout,
        Self::Flaky,
        Self::AdapterFault,
        Self::NotRun,
        Self::ExpectedFailure,
        Self::Warn,
        Self::Pass,
        Self::Recorded,
        Self::Skip,
    ];

    /// Whether it is a failure, or the answer could not be judged.
    #[must_use]
    pub const fn is_wrong(self) -> bool {
        !self.is_fine() && !matches!(self, Self::Warn)
    }

    /// Whether there is nothing to look into: it is as demanded, or there was nothing to judge.
    #[must_use]
    pub const fn is_fine(self) -> bool {
        matches!(self, Self::Pass | Self::Recorded | Self::Skip)
    }

    /// Whether an expected-failures file may excuse it.
    #[must_use]
    pub const fn is_failure(self) -> bool {
        matches!(self, Self::Fail | Self::Flaky | Self::Timeout | Self::Crash | Self::AdapterFault)
    }

    /// Whether it accuses a requirement: a failure that is a fact.
    #[must_use]
    pub const fn accuses(self) -> bool {
        self.is_failure() && !matches!(self, Self::Flaky)
    }

    /// Whether a check with this verdict can be the cause of a later one's verdict. A crash has a
    /// cause of its own, unless the earlier check crashed too. What is not certain explains nothing,
    /// and nothing explains it.
    #[must_use]
    pub fn explains(self, later: Self) -> bool {
        match later {
            _ if self == Self::Flaky => false,
            Self::Flaky => false,
            Self::Fail => self.is_failure(),
            Self::Warn => self.is_failure() || self == Self::Warn,
            later => self == later && self.is_failure(),
        }
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Pass => "pass",
            Self::Fail => "fail",
            Self::Flaky => "flaky",
            Self::Warn => "warn",
            Self::Recorded => "recorded",
            Self::Skip => "skip",
            Self::Timeout => "timeout",
            Self::Crash => "crash",
            Self::AdapterFault => "adapter-fault",
            Self::NotRun => "not-run",
            Self::ExpectedFailure => "expected-failure",
            Self::UnexpectedPass => "unexpected-pass",
        })
    }
}

/// The outcome of one check.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Outcome {
    /// The check's id.
    pub id: String,
    /// The id of the requirement that it tests.
    pub requirement: String,
    /// The level of that requirement.
    pub level: Level,
    /// The verdict.
    pub verdict: Verdict,
    /// The reason in a sentence; empty for a pass.
    pub detail: String,
    /// The earlier check that this one failed because of; its own requirement is not accused then.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub because: Option<Because>,
    /// Why the failure is expected; only for [`Verdict::ExpectedFailure`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
    /// The request; only if the check did not pass.
    #[serde(
        default,
        skip_serializing_if = "Option::is_none",
        deserialize_with = "schema::question"
    )]
    #[schemars(schema_with = "schema::requested")]
    pub request: Option<Question>,
    /// The expected answer; only if another one came.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub expected: Option<Output>,
    /// The actual answer.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(schema_with = "schema::answered")]
    pub actual: Option<Output>,
    /// What the subject does where the documents leave it unspecified; only for
    /// [`Verdict::Recorded`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub behaviour: Option<Behaviour>,
    /// What must be asked before it, so that it fails; only for [`Verdict::Flaky`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub after: Option<After>,
    /// The end of the adapter's error output, if this question ended the adapter.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub log: Option<String>,
    /// The number of the check in the whole run, from 1; only in a part of a run. 0 is a question that
    /// comes before all checks.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub number: Option<usize>,
}

/// The fewest earlier requests that bring a failure about.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct After {
    /// How many they are.
    pub count: usize,
    /// The ids of their checks in the order in which they are asked; the last 16 of more.
    pub checks: Vec<String>,
}

impl After {
    /// How many ids are kept.
    const KEPT: usize = 16;

    /// Keeps the ids of the last of these checks.
    #[must_use]
    pub fn of(ids: &[&str]) -> Self {
        let last = ids.get(ids.len().saturating_sub(Self::KEPT)..).unwrap_or_default();
        let checks = last.iter().map(|id| (*id).to_owned()).collect();
        Self { count: ids.len(), checks }
    }

    /// Whether the ids of all of them are known.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        self.checks.len() == self.count
    }
}

/// The cause of a failure: an earlier, more basic check that failed.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Because {
    /// The id of that check.
    pub check: String,
    /// The id of the requirement that it tests, which is the one that is accused.
    pub requirement: String,
}

/// What a subject does where the documents leave it unspecified.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Behaviour {
    /// The question, in words.
    pub question: String,
    /// The behaviour in a few words.
    pub answer: String,
}

impl Outcome {
    /// Whether it follows from the failure of another requirement.
    #[must_use]
    pub fn follows(&self) -> bool {
        self.because.as_ref().is_some_and(|cause| cause.requirement != self.requirement)
    }

    /// The check and the requirement that are accused: its own, unless it follows from another.
    #[must_use]
    pub fn cause(&self) -> Because {
        let own = || Because { check: self.id.clone(), requirement: self.requirement.clone() };
        self.because.clone().unwrap_or_else(own)
    }

    /// The likeliest mistake that fits a wrong answer: its name, and what must hold, in words.
    #[must_use]
    pub fn mistake(&self) -> Option<(&'static str, String)> {
        let failed = self.verdict == Verdict::Fail;
        mistake::of_answer(
            self.request.as_ref().filter(|_| failed)?,
            self.expected.as_ref()?,
            self.actual.as_ref()?,
        )
    }

    /// The expected and the actual bytes, if they differ. For packets: the parameters of the first
    /// packet that differs.
    #[must_use]
    pub fn bytes(&self) -> Option<(&HexBytes, &HexBytes)> {
        let (expected, actual) = (self.expected.as_ref()?, self.actual.as_ref()?);
        let mut pairs = bytes_of(expected).into_iter().zip(bytes_of(actual));
        pairs.find(|(expected, actual)| expected != actual)
    }
}

fn bytes_of(output: &Output) -> Vec<&HexBytes> {
    match output {
        Output::Crc(_)
        | Output::Value(_)
        | Output::Message(_)
        | Output::Conversation(_)
        | Output::Line(_) => Vec::new(),
        Output::Bytes(bytes) => vec![bytes],
        Output::Packet(packet) => packet.wire().payload(packet),
        Output::Packets(packets) => {
            packets.iter().flat_map(|packet| packet.wire().payload(packet)).collect()
        }
    }
}

/// The count of each verdict. Every verdict has an entry, even if its count is 0.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(transparent)]
pub struct Totals(#[serde(deserialize_with = "every")] BTreeMap<Verdict, usize>);

/// Earlier reports know fewer verdicts.
fn every<'de, D: Deserializer<'de>>(deserializer: D) -> Result<BTreeMap<Verdict, usize>, D::Error> {
    let mut totals = Totals::default().0;
    totals.extend(BTreeMap::<Verdict, usize>::deserialize(deserializer)?);
    Ok(totals)
}

impl Default for Totals {
    fn default() -> Self {
        Self(Verdict::ALL.map(|verdict| (verdict, 0)).into())
    }
}

impl Totals {
    /// Counts the verdicts of some outcomes.
    pub fn of<'a>(outcomes: impl IntoIterator<Item = &'a Outcome>) -> Self {
        let mut totals = Self::default();
        for outcome in outcomes {
            totals.add(outcome.verdict, 1);
        }
        totals
    }

    /// Counts a verdict that came out so often.
    pub fn add(&mut self, verdict: Verdict, count: usize) {
        let counted = self.0.entry(verdict).or_default();
        *counted = counted.saturating_add(count);
    }

    /// Counts as `to` what was counted as `from`, so often.
    pub fn turn(&mut self, from: Verdict, to: Verdict, count: usize) {
        let there = self.0.entry(from).or_default();
        *there = there.saturating_sub(count);
        self.add(to, count);
    }

    /// The count of this verdict.
    #[must_use]
    pub fn count(&self, verdict: Verdict) -> usize {
        self.0.get(&verdict).copied().unwrap_or_default()
    }

    /// The count of all checks.
    #[must_use]
    pub fn sum(&self) -> usize {
        // A file may have any number in it.
        self.0.values().fold(0, |sum, count| sum.saturating_add(*count))
    }

    /// The worst verdict of all checks; `None` if there are no checks.
    #[must_use]
    pub fn worst(&self) -> Option<Verdict> {
        Verdict::WORST_FIRST.into_iter().find(|verdict| self.count(*verdict) > 0)
    }

    /// The verdicts that occurred, with their counts, in the order of reports.
    pub fn counts(&self) -> impl Iterator<Item = (Verdict, usize)> {
        let counts = Verdict::ALL.into_iter().map(|verdict| (verdict, self.count(verdict)));
        counts.filter(|(_, count)| *count > 0)
    }

    /// The exit status of a run with these totals: 0 all passed, 1 something failed, 3 something
    /// could not be run, or the adapter itself is at fault.
    #[must_use]
    pub fn exit_status(&self) -> u8 {
        let any = |verdicts: &[Verdict]| verdicts.iter().any(|verdict| self.count(*verdict) > 0);
        let judged =
            any(&[Verdict::Pass, Verdict::Warn, Verdict::Recorded, Verdict::ExpectedFailure]);
        let failed = [
            Verdict::Fail,
            Verdict::Flaky,
            Verdict::UnexpectedPass,
            Verdict::Crash,
            Verdict::Timeout,
        ];
        if any(&failed) {
            1
        } else if any(&[Verdict::AdapterFault, Verdict::NotRun]) || !judged {
            3
        } else {
            0
        }
    }
}
