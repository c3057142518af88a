//! Checks in a file, so that findings can be asked again.

use std::path::Path;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::check::Check;

/// Version of the file's form. It changes when a field goes or takes another meaning.
pub const VERSION: u32 = 1;

/// Why a file of checks can't be used.
#[derive(Debug, Error)]
pub enum SavedError {
    /// It can't be read.
    #[error("cannot read {path}: {error}")]
    Read {
        /// The file.
        path: String,
        /// What the system says.
        error: std::io::Error,
    },
    /// It is not a file of checks.
    #[error("{path} is no file with checks: {error}")]
    Parse {
        /// The file.
        path: String,
        /// What is wrong, with its line where the reader knows it.
        error: serde_yaml::Error,
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
    let name = path.display().to_string();
    let text = std::fs::read_to_string(path)
        .map_err(|error| SavedError::Read { path: name.clone(), error })?;
    let file: File = serde_yaml::from_str(&text)
        .map_err(|error| SavedError::Parse { path: name.clone(), error })?;
    if file.version != VERSION {
        return Err(SavedError::Version { path: name, version: file.version });
    }
    Ok(file.checks)
}
