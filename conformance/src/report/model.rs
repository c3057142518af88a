//! The content of a report, for every format.

use std::collections::BTreeMap;

use actucheck_spec::Spec;
use actucheck_spec::model::Level;
use schemars::JsonSchema;
use serde::{Deserialize, Deserializer, Serialize};

use crate::adapter::{Implementation, Wire};
use crate::explain::diff::Diff;
use crate::legible::{LONGEST_TEXT, legible};
use crate::suite::expect::Audit;
use crate::suite::partition::Partition;
use crate::traffic::Traffic;
use crate::verdict::{Outcome, Totals, Verdict};

/// Version of the report's format. It changes when a field is removed or gets another meaning.
pub const VERSION: u32 = 6;

/// The result of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Report {
    /// Version of the report's format.
    pub version: u32,
    /// What was checked, and with which checks.
    #[serde(flatten)]
    pub header: Header,
    /// The result of the whole run.
    #[serde(flatten)]
    pub summary: Summary,
    /// The requirements that failures accuse, the most basic first.
    #[serde(default)]
    pub causes: Vec<Cause>,
    /// The mistakes that may explain wrong answers, with the number of failures that fit each.
    #[serde(default)]
    pub mistakes: Vec<Tally>,
    /// Each requirement that checks were about, in the order of the documents.
    pub requirements: Vec<RequirementResult>,
    /// What the implementation does where the documents leave it unspecified.
    pub profile: Vec<ProfileEntry>,
    /// Why checks were skipped.
    pub skips: Vec<Tally>,
    /// Why failures are expected.
    #[serde(default)]
    pub expected_failures: Vec<Tally>,
    /// What came of the expected-failures file in a part of a run; absent for a whole one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub expectations: Option<Audit>,
    /// The checks that did not pass, by requirement and verdict.
    pub not_passed: Vec<NotPassed>,
    /// The last lines that the adapter logged.
    pub log: String,
}

/// The facts about a run that are known before its first check.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Header {
    /// Version of the program that wrote it.
    pub actucheck: String,
    /// When the run began, in UTC, as in RFC 3339; `null` in earlier reports.
    #[serde(default)]
    pub date: Option<String>,
    /// The program's command line, quoted for a shell; `null` in earlier reports.
    #[serde(default)]
    pub command_line: Option<String>,
    /// The implementation that was checked.
    pub implementation: Implementation,
    /// The wires.
    #[serde(alias = "wire", deserialize_with = "wires")]
    pub wires: Vec<Wire>,
    /// The adapter's command with its arguments; empty for the built-in codec.
    pub command: Vec<String>,
    /// The seed of the generated checks.
    pub seed: u64,
    /// How many packets were generated.
    pub cases: u32,
    /// The most bytes in the bodies that were all tried inside every kind of packet.
    pub body_length: u32,
    /// The part of a run that it is about; absent for a whole run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub part: Option<Part>,
}

/// A part of a run, and what all parts of that run have in common.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Part {
    /// Which part.
    #[serde(flatten)]
    pub partition: Partition,
    /// How many checks the whole run has.
    pub checks: usize,
    /// A hash of their ids.
    pub ids: String,
    /// The options that verdicts may depend on, each with its value.
    pub settings: Vec<String>,
}

/// Earlier versions have one wire.
fn wires<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<Wire>, D::Error> {
    #[derive(Deserialize)]
    #[serde(untagged)]
    enum Wires {
        One(Wire),
        Several(Vec<Wire>),
    }
    Ok(match Deserialize::deserialize(deserializer)? {
        Wires::One(wire) => vec![wire],
        Wires::Several(wires) => wires,
    })
}

/// The facts about a run that are known after its last check.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Summary {
    /// How long the run took.
    pub seconds: f64,
    /// Why the run ended early, if it did.
    pub stopped: Option<Stopped>,
    /// How many checks were not asked because of that.
    pub left: usize,
    /// The count of each verdict.
    pub totals: Totals,
    /// What passed on the line to a device; absent if none was checked.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub traffic: Option<Traffic>,
}

/// Why a run ended early.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Stopped {
    /// The user ended it.
    Interrupted,
    /// The allowed number of failures was reached.
    MaxFail,
}

/// A requirement that failures accuse.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Cause {
    /// The requirement's id.
    pub requirement: String,
    /// The id of the first check that accuses it.
    pub check: String,
    /// How many of its own checks failed.
    pub failed: usize,
    /// How many checks of other requirements failed because of it.
    pub follow: usize,
    /// The number of the first check that failed because of it; only in a part of a run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub number: Option<usize>,
}

/// The result for a requirement.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct RequirementResult {
    /// The requirement's id.
    pub id: String,
    /// The requirement's level.
    pub level: Level,
    /// Its text and source; `null` for a rule of the adapter protocol, which no document has.
    pub statement: Option<Statement>,
    /// The worst verdict of its checks.
    pub verdict: Verdict,
    /// The count of each verdict.
    pub totals: Totals,
}

/// A statement of a document.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Statement {
    /// In our own words.
    pub text: String,
    /// The document's title.
    pub document: String,
    /// The section.
    pub section: String,
    /// Ids of the errata that the demand rests on.
    #[serde(default)]
    pub errata: Vec<String>,
}

/// A question that the documents leave unspecified, and what the implementation does.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct ProfileEntry {
    /// The id of the requirement that the question is about.
    pub requirement: String,
    /// The question, in words.
    pub question: String,
    /// The behaviours, the most frequent first.
    pub behaviours: Vec<Tally>,
}

/// How many checks have a text in common.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Tally {
    /// The text.
    pub text: String,
    /// The number of checks.
    pub count: usize,
    /// The id of the first of them.
    pub example: String,
    /// The number of the first of them; only in a part of a run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub number: Option<usize>,
}

/// The checks of a requirement with the same verdict, which is not a pass. Answers that are not
/// judged are in [`Report::profile`], and skipped checks in [`Report::skips`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct NotPassed {
    /// The requirement's id.
    pub requirement: String,
    /// The verdict.
    pub verdict: Verdict,
    /// The number of checks with this verdict.
    pub count: usize,
    /// How many of them follow from the failure of another requirement, and do not accuse this one,
    /// by that requirement.
    #[serde(default)]
    pub following: BTreeMap<String, usize>,
    /// The checks with the shortest requests, at most 5; those that follow from others come last.
    pub smallest: Vec<CheckResult>,
}

/// The outcome of a check.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CheckResult {
    /// Check, verdict and evidence.
    #[serde(flatten)]
    pub outcome: Outcome,
    /// Where the expected and the actual bytes differ. For packets: where the parameters of the
    /// first packet that differs do.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub diff: Option<Diff>,
    /// The part of the frame with the first byte that differs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub differs_in: Option<String>,
    /// What may explain the answer, in words: `fits if …`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mistake: Option<String>,
    /// The number of bytes of the request and the outputs that were cut off.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub left_out: Option<usize>,
    /// The command that asks the check again; only if the check did not pass.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub replay: Option<String>,
    /// The length of the request, by which the smallest are found; only in a part of a run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub size: Option<usize>,
}

impl Report {
    /// The exit status: as [`Totals::exit_status`], and 3 for a run that ended early without a
    /// failure. Of a part it does not matter if nothing was judged: other parts have the rest.
    #[must_use]
    pub fn exit_status(&self) -> u8 {
        let totals = &self.summary.totals;
        let is_idle = totals.sum() == totals.count(Verdict::Skip);
        match (totals.exit_status(), self.summary.stopped) {
            (3, None) if self.header.part.is_some() && is_idle => 0,
            (0, Some(_)) => 3,
            (status, _) => status,
        }
    }

    /// The run in one word: `passed`, `FAILED`, or `incomplete`.
    #[must_use]
    pub fn word(&self) -> &'static str {
        match self.exit_status() {
            0 => "passed",
            1 => "FAILED",
            _ => "incomplete",
        }
    }

    /// Whether the adapter itself had a problem, so that its log is of interest.
    #[must_use]
    pub fn adapter_broke(&self) -> bool {
        let broke = [Verdict::Timeout, Verdict::Crash, Verdict::AdapterFault, Verdict::NotRun];
        broke.into_iter().any(|verdict| self.summary.totals.count(verdict) > 0)
    }
}

impl CheckResult {
    /// The result for a check that passed, though it is expected to fail.
    #[must_use]
    pub fn of_pass(outcome: Outcome) -> Self {
        let detail = legible(&outcome.detail, LONGEST_TEXT);
        Self {
            outcome: Outcome { detail, ..outcome },
            diff: None,
            differs_in: None,
            mistake: None,
            left_out: None,
            replay: None,
            size: None,
        }
    }
}

impl RequirementResult {
    /// The number of its checks.
    #[must_use]
    pub fn checks(&self) -> usize {
        self.totals.sum()
    }
}

impl Statement {
    /// The statement of the requirement with this id; `None` if no document has it.
    #[must_use]
    pub fn of(spec: &Spec, requirement: &str) -> Option<Self> {
        let row = spec.requirement(requirement)?;
        let document = spec.document(&row.source.document)?.title.clone();
        let (text, section) = (row.text.clone(), row.source.section.clone());
        Some(Self { text, document, section, errata: row.errata.clone() })
    }

    /// The document and the section, and the errata that the demand rests on.
    #[must_use]
    pub fn place(&self) -> String {
        let place = format!("{}, {}", self.document, self.section);
        if self.errata.is_empty() {
            place
        } else {
            format!("{place}; rests on {}", self.errata.join(", "))
        }
    }
}
