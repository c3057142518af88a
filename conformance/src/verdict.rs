//! What came out of a check.

use std::collections::BTreeMap;
use std::fmt;

use actucheck_spec::model::{HexBytes, Level};
use serde::Serialize;

use crate::protocol::{Op, Output};

/// What came out of a check, in one word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// As demanded.
    Pass,
    /// Not as demanded.
    Fail,
    /// Not as recommended, or rejected for another reason than the right one.
    Warn,
    /// The documents leave it open; what is done is recorded, not judged.
    Recorded,
    /// The implementation does not offer it.
    Skip,
    /// No answer in time.
    Timeout,
    /// The adapter ended instead of answering.
    Crash,
    /// The adapter's answer is none of the adapter protocol.
    AdapterFault,
    /// The adapter could not be started again to ask it.
    NotRun,
    /// Not as demanded, as the expected-failures file says.
    ExpectedFailure,
    /// As demanded, though the expected-failures file says otherwise.
    UnexpectedPass,
}

impl Verdict {
    /// Every verdict, in the order of reports.
    pub const ALL: [Self; 11] = [
        Self::Pass,
        Self::Fail,
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

    /// Whether an expected-failures file may excuse it.
    #[must_use]
    pub const fn is_failure(self) -> bool {
        matches!(self, Self::Fail | Self::Timeout | Self::Crash | Self::AdapterFault)
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Pass => "pass",
            Self::Fail => "fail",
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
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Outcome {
    /// The check's id.
    pub id: String,
    /// The id of the requirement that it tests.
    pub requirement: String,
    /// How binding that is.
    pub level: Level,
    /// What came out.
    pub verdict: Verdict,
    /// Why, in a sentence; empty for a pass.
    pub detail: String,
    /// What was asked; only where it did not pass.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub request: Option<Op>,
    /// What was demanded; only where something else came.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub expected: Option<Output>,
    /// What came instead.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub actual: Option<Output>,
    /// What is done where the documents leave it open; only of [`Verdict::Recorded`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub behaviour: Option<Behaviour>,
}

/// What an implementation does where the documents leave it open.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Behaviour {
    /// The question, in words.
    pub question: String,
    /// What is done, in a few words.
    pub answer: String,
}

impl Outcome {
    /// The bytes demanded and the bytes that came, where both are bytes.
    #[must_use]
    pub fn bytes(&self) -> Option<(&HexBytes, &HexBytes)> {
        match (&self.expected, &self.actual) {
            (Some(Output::Bytes(expected)), Some(Output::Bytes(actual))) => {
                Some((expected, actual))
            }
            _ => None,
        }
    }
}

/// How often each verdict came out.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(transparent)]
pub struct Totals(BTreeMap<Verdict, usize>);

impl Totals {
    /// Counts the verdicts of some outcomes; every verdict is there, if only with 0.
    pub fn of<'a>(outcomes: impl IntoIterator<Item = &'a Outcome>) -> Self {
        let mut counts: BTreeMap<_, _> = Verdict::ALL.map(|verdict| (verdict, 0)).into();
        for outcome in outcomes {
            *counts.entry(outcome.verdict).or_default() += 1;
        }
        Self(counts)
    }

    /// How often this verdict came out.
    #[must_use]
    pub fn count(&self, verdict: Verdict) -> usize {
        self.0.get(&verdict).copied().unwrap_or_default()
    }

    /// All checks.
    #[must_use]
    pub fn sum(&self) -> usize {
        self.0.values().sum()
    }

    /// The exit status of a run with this outcome: 0 all passed, 1 something failed, 3 something
    /// could not be run.
    #[must_use]
    pub fn exit_status(&self) -> u8 {
        let any = |verdicts: &[Verdict]| verdicts.iter().any(|verdict| self.count(*verdict) > 0);
        let judged =
            any(&[Verdict::Pass, Verdict::Warn, Verdict::Recorded, Verdict::ExpectedFailure]);
        if any(&[Verdict::Fail, Verdict::UnexpectedPass]) {
            1
        } else if any(&[Verdict::Timeout, Verdict::Crash, Verdict::AdapterFault, Verdict::NotRun])
            || !judged
        {
            3
        } else {
            0
        }
    }
}
