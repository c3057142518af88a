//! Reports that were written before.

use std::path::Path;

use serde::Deserialize;
use thiserror::Error;

use super::model::{Report, VERSION};

/// Why a file can't be taken for a report.
#[derive(Debug, Error)]
pub enum ReadError {
    /// It can't be read.
    #[error("cannot read {path}: {error}")]
    Read {
        /// The file.
        path: String,
        /// What the system says.
        error: std::io::Error,
    },
    /// It is no report.
    #[error("{path} is no report, as --report json=FILE writes it: {error}")]
    Parse {
        /// The file.
        path: String,
        /// What is wrong, with line and column.
        error: serde_json::Error,
    },
    /// It is a report of another form than this program's.
    #[error(
        "{path} is a report of version {found}, this program reads {VERSION}; run the checks again, or use the actucheck that wrote it"
    )]
    Version {
        /// The file.
        path: String,
        /// Its version.
        found: u32,
    },
}

/// What every version has.
#[derive(Deserialize)]
struct Versioned {
    version: u32,
}

/// Reads a report in JSON.
///
/// # Errors
/// If it can't be read, is no report, or is one of another version.
pub fn read(path: &Path) -> Result<Report, ReadError> {
    let name = || path.display().to_string();
    let text =
        std::fs::read_to_string(path).map_err(|error| ReadError::Read { path: name(), error })?;
    let parse = |error| ReadError::Parse { path: name(), error };
    let Versioned { version: found } = serde_json::from_str(&text).map_err(parse)?;
    if found != VERSION {
        return Err(ReadError::Version { path: name(), found });
    }
    serde_json::from_str(&text).map_err(parse)
}
