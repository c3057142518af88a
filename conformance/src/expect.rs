//! Audited expected failures: what an implementation is known to get wrong, and why that is.

use std::path::Path;

use globset::GlobMatcher;
use serde::Deserialize;
use thiserror::Error;

use crate::check::Check;
use crate::select::glob;
use crate::verdict::{Outcome, Verdict};

/// Why an expected-failures file is of no use.
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
    /// It is no such file.
    #[error("{path}: {message}")]
    Parse {
        /// The file.
        path: String,
        /// What is wrong, with line and column.
        message: String,
    },
    /// A row's id is no glob, or is that of no check.
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
    /// A check's id, or a glob over ids.
    id: String,
    /// Why the failure is the implementation's own and known.
    reason: String,
    /// Where that is reported or can be seen.
    upstream: Option<String>,
}

/// The failures that are expected of an implementation.
#[derive(Debug, Default)]
pub struct Expectations {
    rows: Vec<(Row, GlobMatcher)>,
}

impl Expectations {
    /// Reads the file at `path`.
    ///
    /// # Errors
    /// If it can't be read, is malformed, or has a row that is about none of `checks`.
    pub fn read(path: &Path, checks: &[Check]) -> Result<Self, ExpectError> {
        let name = path.display().to_string();
        let text = std::fs::read_to_string(path).map_err(|error| ExpectError::Read {
            path: name.clone(),
            error,
        })?;
        let file: ExpectationsFile =
            serde_yaml::from_str(&text).map_err(|error| ExpectError::Parse {
                path: name.clone(),
                message: error.to_string(),
            })?;
        let mut rows = Vec::new();
        for (index, row) in file.expected_failures.into_iter().enumerate() {
            let fault = |message| ExpectError::Row {
                path: name.clone(),
                row: index + 1,
                message,
            };
            let matcher = glob(&row.id).map_err(fault)?.compile_matcher();
            if !checks.iter().any(|check| matcher.is_match(&check.id)) {
                return Err(fault(format!("`{}` is the id of no check", row.id)));
            }
            rows.push((row, matcher));
        }
        Ok(Self { rows })
    }

    /// Turns expected failures into [`Verdict::ExpectedFailure`], and the passes of a row none of
    /// whose checks failed into [`Verdict::UnexpectedPass`].
    pub fn apply(&self, outcomes: &mut [Outcome]) {
        for (row, matcher) in &self.rows {
            let mut failed = false;
            for outcome in outcomes
                .iter_mut()
                .filter(|outcome| matcher.is_match(&outcome.id))
            {
                if outcome.verdict.is_failure() {
                    failed = true;
                    outcome.verdict = Verdict::ExpectedFailure;
                    outcome.detail = format!("{}; expected: {}", outcome.detail, row.reason);
                    if let Some(upstream) = &row.upstream {
                        outcome.detail = format!("{} ({upstream})", outcome.detail);
                    }
                }
            }
            if failed {
                continue;
            }
            for outcome in outcomes
                .iter_mut()
                .filter(|outcome| matcher.is_match(&outcome.id))
            {
                if outcome.verdict == Verdict::Pass {
                    outcome.verdict = Verdict::UnexpectedPass;
                    outcome.detail = format!(
                        "passes, though `{}` is an expected failure; take the row out",
                        row.id
                    );
                }
            }
        }
    }
}
