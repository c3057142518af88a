//! Checks in a file, so that findings can be asked again.

use std::path::Path;

use actucheck_spec::model::Citation;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::check::{Check, Demand, Unspecified, Way};
use crate::input::{self, InputError};
use crate::legible::{LONGEST_TEXT, legible};

/// Version of the file's form. It changes when a field goes or takes another meaning.
pub const VERSION: u32 = 1;

/// Why a file of checks can't be used.
#[derive(Debug, Error)]
pub enum SavedError {
    /// It can't be read.
    #[error(transparent)]
    Read(#[from] InputError),
    /// It is not a file of checks.
    #[error("{path} is no file with checks: {error}")]
    Parse {
        /// The file.
        path: String,
        /// What is wrong, with its line where the reader knows it.
        error: String,
    },
    /// It has another version.
    #[error("{path} is of version {version}, this program reads version {VERSION}")]
    Version {
        /// The file.
        path: String,
        /// Its version.
        version: u32,
    },
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    version: u32,
    checks: Vec<Check>,
}

/// These checks as the YAML text of a file.
///
/// # Errors
/// If they can't be written as YAML; no such check is known.
pub fn write(checks: &[Check]) -> Result<String, serde_yaml::Error> {
    serde_yaml::to_string(&File { version: VERSION, checks: checks.to_vec() })
}

/// Reads the file at `path`.
///
/// # Errors
/// If it can't be read, is malformed or of another version.
pub fn read(path: &Path) -> Result<Vec<Check>, SavedError> {
    parse(&path.display().to_string(), &input::yaml_text(path)?)
}

/// Reads the text of the file `name`.
///
/// # Errors
/// If it is malformed or of another version.
pub fn parse(name: &str, text: &str) -> Result<Vec<Check>, SavedError> {
    let path = || name.to_owned();
    let file: File =
        input::yaml(text).map_err(|error| SavedError::Parse { path: path(), error })?;
    if file.version != VERSION {
        return Err(SavedError::Version { path: path(), version: file.version });
    }
    Ok(file.checks.into_iter().map(cleaned).collect())
}

/// A check whose texts are legible, as nobody knows who wrote the file.
fn cleaned(check: Check) -> Check {
    let clean = |text: String| legible(&text, LONGEST_TEXT);
    let way = |way: Way| Way { name: clean(way.name), ..way };
    Check {
        id: clean(check.id),
        requirement: clean(check.requirement),
        source: Citation {
            document: clean(check.source.document),
            section: clean(check.source.section),
        },
        requires: check.requires.map(clean),
        demand: match check.demand {
            Demand::Record(Unspecified { question, ways }) => Demand::Record(Unspecified {
                question: clean(question),
                ways: ways.into_iter().map(way).collect(),
            }),
            demand => demand,
        },
        ..check
    }
}
