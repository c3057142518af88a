//! The expected-failures file.

use std::fmt;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::input::{self, InputError};

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
    /// A row has no ids, or one of no check.
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

/// The file's content.
#[derive(Debug, Default)]
pub(super) struct File {
    /// Whether the file has nothing in it.
    pub(super) is_blank: bool,
    /// The comment at the beginning, with its line ends and blank lines.
    pub(super) comment: String,
    pub(super) rows: Vec<Row>,
}

/// Failures with a common reason.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Row {
    /// Ids of checks, or globs over ids.
    pub(super) ids: Vec<String>,
    /// Why the failure is expected.
    pub(super) reason: String,
    /// A link to a report or other evidence.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) upstream: Option<String>,
    /// Whether the checks pass at times.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub(super) flaky: bool,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Content {
    expected_failures: Option<Vec<Row>>,
}

/// The comment of a file that had none.
const COMMENT: &str = "# Failures that are expected; `actucheck codec --expect` reads this file.\n";

/// The comment at the beginning of a text, with blank lines. YAML has more line ends than text files have.
fn comment(text: &str) -> String {
    let lines = text
        .trim_start_matches('\u{feff}')
        .split_inclusive(['\n', '\r', '\u{85}', '\u{2028}', '\u{2029}']);
    let is_comment = |line: &&str| matches!(line.trim_start().chars().next(), None | Some('#'));
    lines.take_while(is_comment).collect()
}

impl File {
    /// Reads the text of the file `name`. An empty file has no rows.
    pub(super) fn parse(name: &str, text: &str) -> Result<Self, ExpectError> {
        let path = || name.to_owned();
        if text.trim().is_empty() {
            return Ok(Self { is_blank: true, ..Self::default() });
        }
        let content: Content =
            input::yaml(text).map_err(|message| ExpectError::Parse { path: path(), message })?;
        let rows = content.expected_failures.unwrap_or_default();
        if let Some(empty) = rows.iter().position(|row| row.ids.is_empty()) {
            let message = "it names no check; add one to `ids`, or take the row out".to_owned();
            return Err(ExpectError::Row { path: path(), row: empty + 1, message });
        }
        Ok(Self { is_blank: false, comment: comment(text), rows })
    }

    /// The text of the file.
    pub(super) fn text(self) -> Result<String, serde_yaml::Error> {
        let comment = if self.comment.trim().is_empty() { COMMENT } else { &self.comment };
        let rows = serde_yaml::to_string(&Content { expected_failures: Some(self.rows) })?;
        // The last line of a file may have no end.
        let end = if comment.ends_with('\n') { "" } else { "\n" };
        Ok(format!("{comment}{end}{rows}"))
    }
}

impl fmt::Display for Row {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.reason)?;
        self.upstream.as_ref().map_or(Ok(()), |upstream| write!(f, " ({upstream})"))
    }
}
