//! Exports the spec in other formats, for use without this crate. The output is deterministic.

pub mod c_header;
pub mod json;
pub mod markdown;
pub mod vectors;
pub mod wireshark;

use std::fmt;

use serde::Serialize;

/// Why the spec can't be exported.
#[derive(Debug)]
pub enum ExportError {
    /// Two things in the spec would have this name in C.
    Name(String),
    /// Something can't be written as JSON.
    Json(serde_json::Error),
}

impl fmt::Display for ExportError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Name(name) => write!(f, "two things would be called {name}"),
            Self::Json(error) => write!(f, "no JSON: {error}"),
        }
    }
}

impl std::error::Error for ExportError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Name(_) => None,
            Self::Json(error) => Some(error),
        }
    }
}

fn to_json(value: &impl Serialize) -> Result<String, ExportError> {
    let text = serde_json::to_string_pretty(value).map_err(ExportError::Json)?;
    Ok(text + "\n")
}
