//! Reads saved reports.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use indexmap::IndexSet;
use serde::Deserialize;
use serde_json::Value;
use thiserror::Error;

use super::model::{
    CheckResult, Header, NotPassed, ProfileEntry, Report, RequirementResult, Summary, Tally,
    VERSION,
};
use super::smallest::Smallest;
use crate::input::{self, InputError};
use crate::legible::legible;
use crate::run::UNKNOWN_OP;
use crate::traffic::Traffic;
use crate::verdict::{Totals, Verdict};

/// Why a file can't be read as a report.
#[derive(Debug, Error)]
pub enum ReadError {
    /// It can't be read.
    #[error(transparent)]
    Read(#[from] InputError),
    /// It is not a report.
    #[error("{path} is not a report that --report json=FILE wrote: {error}")]
    Parse {
        /// The file.
        path: String,
        /// What is wrong; if it is no JSON, with line and column.
        error: String,
    },
    /// It is a report of an unknown version.
    #[error(
        "{path} is a report of version {found}, this program reads {OLDEST} to {VERSION}; run the checks again, or use the actucheck that wrote it"
    )]
    Version {
        /// The file.
        path: String,
        /// Its version.
        found: u32,
    },
    /// Its numbers contradict each other.
    #[error("{path} contradicts itself: {what}; run the checks again")]
    Contradiction {
        /// The file.
        path: String,
        /// The contradiction.
        what: String,
    },
}

/// The oldest version that is read.
const OLDEST: u32 = 3;

/// The field that every version has.
#[derive(Deserialize)]
struct Versioned {
    version: u32,
}

/// Version 3, which kept the result of every check.
#[derive(Deserialize)]
struct Version3 {
    #[serde(flatten)]
    header: Header,
    #[serde(flatten)]
    summary: Summary,
    requirements: Vec<RequirementResult>,
    profile: Vec<ProfileEntry>,
    skips: Vec<Tally>,
    results: Vec<CheckResult>,
    log: String,
}

/// Reads a report in JSON.
///
/// # Errors
/// If it can't be read, is not a report, has an unknown version, or contradicts itself.
pub fn read(path: &Path) -> Result<Report, ReadError> {
    parse(&path.display().to_string(), &input::json_text(path)?)
}

/// Reads the text of the report `name`. What it says is made legible, as nobody knows who wrote it.
///
/// # Errors
/// If it is not a report, has an unknown version, or contradicts itself.
pub fn parse(name: &str, text: &str) -> Result<Report, ReadError> {
    let path = || name.to_owned();
    let parse = |error: serde_json::Error| ReadError::Parse {
        path: path(),
        error: clean(&error.to_string()),
    };
    let content = cleaned(serde_json::from_str(text).map_err(parse)?);
    let Versioned { version: found } = Versioned::deserialize(&content).map_err(parse)?;
    let report: Report = match found {
        4..=VERSION => {
            Report { version: VERSION, ..serde_json::from_value(content).map_err(parse)? }
        }
        OLDEST => serde_json::from_value::<Version3>(content).map_err(parse)?.into(),
        _ => return Err(ReadError::Version { path: path(), found }),
    };
    match contradiction(&report) {
        Some(what) => Err(ReadError::Contradiction { path: path(), what }),
        None => Ok(report),
    }
}

/// Every text legible, and on one line but for that of the log.
fn cleaned(content: Value) -> Value {
    match content {
        Value::String(text) => Value::String(clean(&text)),
        Value::Array(values) => values.into_iter().map(cleaned).collect(),
        Value::Object(fields) => {
            let field = |(name, value): (String, Value)| match value {
                Value::String(log) if name == "log" => {
                    let lines: Vec<_> = log.lines().map(clean).collect();
                    (name, Value::String(lines.join("\n")))
                }
                value => (clean(&name), cleaned(value)),
            };
            fields.into_iter().map(field).collect()
        }
        other => other,
    }
}

/// The size of the file limits that of its texts.
fn clean(text: &str) -> String {
    legible(text, usize::MAX)
}

impl From<Version3> for Report {
    fn from(old: Version3) -> Self {
        let Version3 { header, summary, requirements, profile, skips, results, log } = old;
        let places: IndexSet<&str> = requirements.iter().map(|row| row.id.as_str()).collect();
        let mut not_passed: BTreeMap<_, (String, Smallest)> = BTreeMap::new();
        for result in results {
            let (verdict, requirement) = (result.outcome.verdict, &result.outcome.requirement);
            if verdict.is_fine() {
                continue;
            }
            let key = (places.get_index_of(requirement.as_str()), verdict);
            let new = || (requirement.clone(), Smallest::default());
            let (_, smallest) = not_passed.entry(key).or_insert_with(new);
            let CheckResult { outcome, diff, differs_in, mistake, left_out, replay, size } = result;
            smallest.add(outcome, |outcome| CheckResult {
                outcome,
                diff,
                differs_in,
                mistake,
                left_out,
                replay,
                size,
            });
        }
        let row = |((_, verdict), (requirement, smallest)): ((_, Verdict), (String, Smallest))| {
            smallest.finish(requirement, verdict)
        };
        let not_passed = not_passed.into_iter().map(row).collect();
        Self {
            version: VERSION,
            header,
            summary,
            causes: Vec::new(),
            mistakes: Vec::new(),
            requirements,
            profile,
            skips,
            expected_failures: Vec::new(),
            expectations: None,
            not_passed,
            log,
        }
    }
}

/// Finds a contradiction in a report: what can be counted is counted again.
pub(super) fn contradiction(report: &Report) -> Option<String> {
    wrong_counts(report).or_else(|| wrong_causes(report)).or_else(|| wrong_part(report))
}

/// Finds a part that there can't be.
fn wrong_part(report: &Report) -> Option<String> {
    let part = report.header.part.as_ref()?;
    if !part.partition.is_valid() {
        return Some(format!("there is no {}", part.partition));
    }
    let own = report.requirements.iter().filter(|row| row.id != UNKNOWN_OP);
    let own = sum(own.map(RequirementResult::checks)).saturating_add(report.summary.left);
    (own > part.checks).then(|| format!("a part of {} checks has {own}", part.checks))
}

/// Finds totals that are not those of what they count.
fn wrong_counts(report: &Report) -> Option<String> {
    let mut totals = Totals::default();
    let mut ids = BTreeSet::new();
    for row in &report.requirements {
        if !ids.insert(&row.id) {
            return Some(format!("it has {} twice", row.id));
        }
        if row.totals.worst() != Some(row.verdict) {
            return Some(format!("the totals of {} do not come to {}", row.id, row.verdict));
        }
        row.totals.counts().for_each(|(verdict, count)| totals.add(verdict, count));
    }
    if totals != report.summary.totals {
        return Some("its totals are not those of its requirements".to_owned());
    }
    // No sum of what is counted below is more, so none overflows.
    if totals.sum() == usize::MAX {
        return Some("it tells of more checks than there can be".to_owned());
    }
    let behaviours = report.profile.iter().flat_map(|question| &question.behaviours);
    for (verdict, counted) in [
        (Verdict::Skip, sum(report.skips.iter().map(|tally| tally.count))),
        (Verdict::Recorded, sum(behaviours.map(|tally| tally.count))),
        (Verdict::ExpectedFailure, sum(report.expected_failures.iter().map(|tally| tally.count))),
    ] {
        // Reports of earlier versions have no reasons of expected failures.
        let is_told = verdict != Verdict::ExpectedFailure || counted > 0;
        if is_told && counted != totals.count(verdict) {
            let told = totals.count(verdict);
            return Some(format!(
                "it tells of {counted} checks with verdict {verdict}, not {told}"
            ));
        }
    }
    if let Some(what) = report.summary.traffic.as_ref().and_then(wrong_times) {
        return Some(what);
    }
    if sum(report.mistakes.iter().map(|tally| tally.count)) > totals.count(Verdict::Fail) {
        return Some("more failures fit its mistakes than there are".to_owned());
    }
    let mut rows = BTreeSet::new();
    for row in &report.not_passed {
        if !rows.insert((&row.requirement, row.verdict)) {
            return Some(format!("it has {} with verdict {} twice", row.requirement, row.verdict));
        }
    }
    for row in &report.requirements {
        let mut verdicts = row.totals.counts().map(|(verdict, _)| verdict);
        let lacks = |verdict: &Verdict| !verdict.is_fine() && !rows.contains(&(&row.id, *verdict));
        if let Some(verdict) = verdicts.find(lacks) {
            return Some(format!("it lacks the checks of {} with verdict {verdict}", row.id));
        }
    }
    let wrong = |NotPassed { requirement, verdict, count, following, smallest }: &&NotPassed| {
        let row = report.requirements.iter().find(|row| row.id == *requirement);
        row.is_none_or(|row| row.totals.count(*verdict) != *count)
            || smallest.len() > *count
            || sum(following.values().copied()) > *count
            || smallest.iter().any(|kept| {
                kept.outcome.requirement != *requirement || kept.outcome.verdict != *verdict
            })
    };
    let NotPassed { requirement, verdict, .. } = report.not_passed.iter().find(wrong)?;
    Some(format!("its checks of {requirement} with verdict {verdict} are not what its totals say"))
}

/// Finds times of answers that are in no order, or are more than there are.
fn wrong_times(traffic: &Traffic) -> Option<String> {
    let Traffic { response, by_instruction, .. } = traffic;
    let each = by_instruction.iter().map(|response| &response.spread);
    if let Some(spread) = response.iter().chain(each.clone()).find(|spread| !spread.is_ordered()) {
        return Some(format!("the times of {} answers are in no order", spread.count));
    }
    let all = response.map_or(0, |spread| spread.count);
    let counted = sum(each.map(|spread| spread.count));
    (counted != all).then(|| format!("it tells of times of {all} answers, not {counted}"))
}

/// Finds a requirement that is at fault for another number of failures than the report says.
fn wrong_causes(report: &Report) -> Option<String> {
    // Reports of earlier versions do not say what is at fault, nor do those that are made of them.
    if report.causes.is_empty() {
        return None;
    }
    // Of each requirement: how many of its own checks failed, and how many of others because of it.
    let mut counted: BTreeMap<&str, (usize, usize)> = BTreeMap::new();
    for row in report.not_passed.iter().filter(|row| row.verdict.accuses()) {
        let own = row.count.saturating_sub(sum(row.following.values().copied()));
        let (failed, _) = counted.entry(&row.requirement).or_default();
        *failed = failed.saturating_add(own);
        for (cause, count) in &row.following {
            let (_, follow) = counted.entry(cause).or_default();
            *follow = follow.saturating_add(*count);
        }
    }
    counted.retain(|_, counts| *counts != (0, 0));
    let mut told = report.causes.iter();
    let wrong = told.find(|cause| {
        counted.remove(cause.requirement.as_str()) != Some((cause.failed, cause.follow))
    });
    let requirement = wrong.map(|cause| cause.requirement.as_str());
    let requirement = requirement.or_else(|| counted.keys().next().copied())?;
    Some(format!("what it says {requirement} is at fault for is not what its checks say"))
}

/// A file may have any number in it.
fn sum(counts: impl Iterator<Item = usize>) -> usize {
    counts.fold(0, usize::saturating_add)
}
