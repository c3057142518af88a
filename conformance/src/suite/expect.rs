//! Expected failures: the checks that a subject is known to fail, each with a reason. The file is
//! audited: an expected failure that passes is reported.

use std::collections::BTreeMap;
use std::fmt;
use std::path::Path;
use std::sync::Arc;

use serde::Deserialize;
use thiserror::Error;

use super::plan::Plan;
use super::select::Patterns;
use crate::input::{self, InputError};
use crate::verdict::{Outcome, Verdict};

/// Why an expected-failures file can't be used.
#[derive(Debug, Error)]
pub enum ExpectError {
    /// It can't be read.
    #[error(transparent)]
    Read(#[from] InputError),
    /// It is not an expected-failures file.
    #[error("{path}: {message}")]
    Parse {
        /// The file.
        path: String,
        /// What is wrong, with line and column.
        message: String,
    },
    /// An id in a row is not a glob, or matches no check.
    #[error("{path}: row {row}: {message}")]
    Row {
        /// The file.
        path: String,
        /// The row, from 1.
        row: usize,
        /// What is wrong.
        message: String,
    },
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct ExpectationsFile {
    expected_failures: Vec<Row>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Row {
    /// Ids of checks, or globs over ids.
    ids: Vec<String>,
    /// Why the failure is expected.
    reason: String,
    /// A link to a report or other evidence.
    upstream: Option<String>,
}

/// The expected failures of a subject, and what came out of them so far.
#[derive(Debug, Default)]
pub struct Expectations {
    patterns: Patterns,
    /// Of each pattern, in the same order.
    expected: Vec<Expected>,
    /// The passes of checks that are expected to fail, by requirement and by the patterns that match.
    /// Whether a pattern is outdated is known only when all its checks were asked.
    passes: BTreeMap<(String, Vec<usize>), Passes>,
}

/// An id or a glob of a row.
#[derive(Debug)]
struct Expected {
    /// The row of the id or glob.
    row: Arc<Row>,
    /// How many checks it matches.
    checks: usize,
    /// How many of them were asked.
    asked: usize,
    /// Whether one of them failed.
    failed: bool,
}

/// How many checks passed, and the first of them.
#[derive(Debug, Default)]
struct Passes {
    count: usize,
    first: Vec<Outcome>,
}

/// How many passes of a requirement's checks are kept.
const KEPT: usize = 5;

/// Passes of a requirement's checks that an expected-failures file says are failures.
#[derive(Clone, Debug, PartialEq)]
pub struct Unexpected {
    /// The requirement's id.
    pub requirement: String,
    /// How many there are.
    pub count: usize,
    /// The first few of them.
    pub first: Vec<Outcome>,
}

impl Expectations {
    /// Reads the file at `path`.
    ///
    /// # Errors
    /// If it can't be read, is malformed, or has a row that matches no check of the plan.
    pub fn read(path: &Path, plan: &Plan<'_>) -> Result<Self, ExpectError> {
        let name = path.display().to_string();
        let text = input::yaml_text(path)?;
        let parse = |message| ExpectError::Parse { path: name.clone(), message };
        let file: ExpectationsFile = input::yaml(&text).map_err(parse)?;
        let texts = file.expected_failures.iter().flat_map(|row| &row.ids).map(String::as_str);
        let patterns = Patterns::new(texts).map_err(parse)?;
        let mut counts = plan.count_matches(&patterns).into_iter();
        let mut expected = Vec::new();
        for (index, row) in file.expected_failures.into_iter().enumerate() {
            let row = Arc::new(row);
            for id in &row.ids {
                let checks = counts.next().unwrap_or_default();
                if checks == 0 {
                    let message = format!("`{id}` is the id of no check");
                    return Err(ExpectError::Row { path: name, row: index + 1, message });
                }
                let row = Arc::clone(&row);
                expected.push(Expected { row, checks, asked: 0, failed: false });
            }
        }
        Ok(Self { patterns, expected, passes: BTreeMap::new() })
    }

    /// Turns an expected failure into [`Verdict::ExpectedFailure`], and notes a pass that is not
    /// expected.
    pub fn apply(&mut self, outcome: &mut Outcome) {
        let matches = self.patterns.matches(&outcome.id);
        let failed = outcome.verdict.is_failure();
        for place in &matches {
            let Some(expected) = self.expected.get_mut(*place) else { continue };
            expected.asked += 1;
            expected.failed |= failed;
            if outcome.verdict.is_failure() {
                outcome.verdict = Verdict::ExpectedFailure;
                outcome.reason = Some(expected.row.to_string());
            }
        }
        if outcome.verdict == Verdict::Pass && !matches.is_empty() {
            let passes = self.passes.entry((outcome.requirement.clone(), matches)).or_default();
            passes.count += 1;
            if passes.first.len() < KEPT {
                passes.first.push(outcome.clone());
            }
        }
    }

    /// At the end of a run: the passes of checks that an outdated id or glob matches, as
    /// [`Verdict::UnexpectedPass`]. It is outdated if all checks that it matches were asked and none of
    /// them failed.
    #[must_use]
    pub fn unexpected(self) -> Vec<Unexpected> {
        let Self { patterns, expected, passes } = self;
        let stale = |place: &usize| {
            let expected = expected.get(*place)?;
            let stale = !expected.failed && expected.asked == expected.checks;
            if stale { patterns.texts().get(*place) } else { None }
        };
        let mut all = Vec::new();
        for ((requirement, places), Passes { count, mut first }) in passes {
            let Some(text) = places.iter().find_map(stale) else { continue };
            for outcome in &mut first {
                outcome.verdict = Verdict::UnexpectedPass;
                outcome.detail = format!(
                    "passes, though `{text}` is an expected failure; take it out of the file"
                );
            }
            all.push(Unexpected { requirement, count, first });
        }
        all
    }
}

impl fmt::Display for Row {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.reason)?;
        self.upstream.as_ref().map_or(Ok(()), |upstream| write!(f, " ({upstream})"))
    }
}
