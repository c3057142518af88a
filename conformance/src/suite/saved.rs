//! Checks in a file, so that findings can be asked again.

use std::path::Path;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::check::Check;
use crate::input::{self, InputError};
use crate::legible::{LONGEST_NAME, first_hidden, legible};

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
/// If it is malformed, has text that does not show, or is of another version.
pub fn parse(name: &str, text: &str) -> Result<Vec<Check>, SavedError> {
    let path = || name.to_owned();
    let file: File =
        input::yaml(text).map_err(|error| SavedError::Parse { path: path(), error })?;
    if file.version != VERSION {
        return Err(SavedError::Version { path: path(), version: file.version });
    }
    // Nobody knows who wrote the file.
    let texts = serde_json::to_value(&file.checks)
        .map_err(|error| SavedError::Parse { path: path(), error: error.to_string() })?;
    if let Some(text) = first_hidden(&texts, usize::MAX) {
        let error = format!("`{}` has characters that do not show", legible(&text, LONGEST_NAME));
        return Err(SavedError::Parse { path: path(), error });
    }
    Ok(file.checks)
}
