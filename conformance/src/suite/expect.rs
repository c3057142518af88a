//! Expected failures: the checks that a subject is known to fail, each with a reason. The file is
//! audited: an expected failure that passes is reported.

use std::fmt;
use std::path::Path;
use std::sync::Arc;

use globset::{Glob, GlobMatcher};
use serde::Deserialize;
use thiserror::Error;

use super::plan::Plan;
use super::select::Patterns;
use crate::verdict::{Outcome, Verdict};

/// Why an expected-failures file can't be used.
#[derive(Debug, Error)]
pub enum ExpectError {
    /// It can't be read.
    #[error("cannot read {path}: {error}")]
    Read {
        /// The file.
        path: String,
        /// What the system says.
        error: std::io::Error,
    },
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

/// The expected failures of a subject.
#[derive(Debug, Default)]
pub struct Expectations {
    globs: Vec<Expectation>,
}

/// A glob of a row.
#[derive(Debug)]
struct Expectation {
    glob: GlobMatcher,
    /// The row of the glob.
    row: Arc<Row>,
    /// How many checks it matches.
    checks: usize,
}

impl Expectations {
    /// Reads the file at `path`.
    ///
    /// # Errors
    /// If it can't be read, is malformed, or has a row that matches no check of the plan.
    pub fn read(path: &Path, plan: &Plan<'_>) -> Result<Self, ExpectError> {
        let name = path.display().to_string();
        let text = std::fs::read_to_string(path)
            .map_err(|error| ExpectError::Read { path: name.clone(), error })?;
        let file: ExpectationsFile = serde_yaml::from_str(&text).map_err(|error| {
            ExpectError::Parse { path: name.clone(), message: error.to_string() }
        })?;
        let texts = file.expected_failures.iter().flat_map(|row| &row.ids).map(String::as_str);
        let patterns = Patterns::new(texts)
            .map_err(|message| ExpectError::Parse { path: name.clone(), message })?;
        let mut counts = plan.count_matches(&patterns).into_iter();
        let mut globs = Vec::new();
        for (index, row) in file.expected_failures.into_iter().enumerate() {
            let fault = |message| ExpectError::Row { path: name.clone(), row: index + 1, message };
            let row = Arc::new(row);
            for id in &row.ids {
                let glob =
                    Glob::new(id).map_err(|error| fault(error.to_string()))?.compile_matcher();
                let checks = counts.next().unwrap_or_default();
                if checks == 0 {
                    return Err(fault(format!("`{id}` is the id of no check")));
                }
                globs.push(Expectation { glob, row: Arc::clone(&row), checks });
            }
        }
        Ok(Self { globs })
    }

    /// Whether the check with this id is expected to fail.
    #[must_use]
    pub fn expect(&self, id: &str) -> bool {
        self.globs.iter().any(|expected| expected.glob.is_match(id))
    }

    /// Turns expected failures into [`Verdict::ExpectedFailure`]. If all checks that an id or glob
    /// matches were asked and none of them failed, their passes become [`Verdict::UnexpectedPass`].
    pub fn apply(&self, outcomes: &mut [Outcome]) {
        for Expectation { glob, row, checks } in &self.globs {
            let mut matched: Vec<_> =
                outcomes.iter_mut().filter(|outcome| glob.is_match(&outcome.id)).collect();
            // Another row may have changed it already.
            let failed = matched.iter().any(|outcome| {
                outcome.verdict.is_failure() || outcome.verdict == Verdict::ExpectedFailure
            });
            let stale = !failed && matched.len() == *checks;
            for outcome in &mut matched {
                if outcome.verdict.is_failure() {
                    outcome.verdict = Verdict::ExpectedFailure;
                    outcome.detail = format!("{}; expected: {row}", outcome.detail);
                } else if outcome.verdict == Verdict::Pass && stale {
                    outcome.verdict = Verdict::UnexpectedPass;
                    outcome.detail = format!(
                        "passes, though `{}` is an expected failure; take it out of the file",
                        glob.glob()
                    );
                }
            }
        }
    }
}

impl fmt::Display for Row {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.reason)?;
        self.upstream.as_ref().map_or(Ok(()), |upstream| write!(f, " ({upstream})"))
    }
}
