//! Reads the files that a user names. Each is read within limits, so that one that has no end, nests
//! deep or is not what it should be is refused soon and in one sentence.

use std::fs::{self, File};
use std::io::{self, Read as _};
use std::path::Path;

use serde::de::DeserializeOwned;
use thiserror::Error;

use crate::legible::{LONGEST_TEXT, legible};

/// The most bytes of a YAML file: several times those of an expected-failures file that names every
/// check that there is.
const LONGEST_YAML: u64 = 16 << 20;
/// The most bytes of a report. Version 3 had every check in it.
const LONGEST_JSON: u64 = 64 << 20;

/// The most bytes of a `.model` file: twenty times those of the longest one that its maker has.
const LONGEST_MODEL: u64 = 1 << 20;

/// Why a file can't be read.
#[derive(Debug, Error)]
pub enum InputError {
    /// The system does not read it.
    #[error("cannot read {path}: {error}")]
    Read {
        /// The file.
        path: String,
        /// What the system says.
        error: io::Error,
    },
    /// It is a folder, a device or a pipe.
    #[error("{0} is not a file with an end; write it to a file first, and name that")]
    NoFile(String),
    /// It is too long.
    #[error("{path} has more than {} MiB; split it", most >> 20)]
    TooLong {
        /// The file.
        path: String,
        /// The most bytes that it may have.
        most: u64,
    },
    /// It is no text.
    #[error("{0} is not a text in UTF-8")]
    NoText(String),
}

/// The text of a YAML file.
///
/// # Errors
/// If it can't be read.
pub fn yaml_text(path: &Path) -> Result<String, InputError> {
    text(path, LONGEST_YAML)
}

/// The text of a `.model` file of a device.
///
/// # Errors
/// If it can't be read.
pub fn model_text(path: &Path) -> Result<String, InputError> {
    text(path, LONGEST_MODEL)
}

/// The text of a JSON file.
///
/// # Errors
/// If it can't be read.
pub fn json_text(path: &Path) -> Result<String, InputError> {
    text(path, LONGEST_JSON)
}

/// The content of a YAML text.
///
/// # Errors
/// What is wrong, with the place.
pub fn yaml<T: DeserializeOwned>(text: &str) -> Result<T, String> {
    actucheck_spec::load::yaml(text).map_err(|message| legible(&message, LONGEST_TEXT))
}

fn text(path: &Path, most: u64) -> Result<String, InputError> {
    let name = || path.display().to_string();
    let read = |error| InputError::Read { path: name(), error };
    // To open a pipe may take forever.
    if !fs::metadata(path).map_err(read)?.is_file() {
        return Err(InputError::NoFile(name()));
    }
    let mut bytes = Vec::new();
    // The file may grow meanwhile.
    File::open(path).and_then(|file| file.take(most + 1).read_to_end(&mut bytes)).map_err(read)?;
    if u64::try_from(bytes.len()).is_ok_and(|size| size > most) {
        return Err(InputError::TooLong { path: name(), most });
    }
    String::from_utf8(bytes).map_err(|_| InputError::NoText(name()))
}
