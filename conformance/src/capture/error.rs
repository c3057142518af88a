//! Why an input can't be read.

use std::fmt::Write as _;
use std::io;

use crate::explain::diff::spaced;

use super::Form;

/// Why an input can't be read. Each is a sentence that says what the user can do.
#[derive(Debug, thiserror::Error)]
pub enum Unreadable {
    /// There are no bytes.
    #[error("there are no bytes; write them as `FF FF FD 00`, or name a file that has them")]
    Empty,
    /// Two forms give different bytes.
    #[error("{}", two_readings(.0))]
    Ambiguous(Vec<(Form, Vec<u8>)>),
    /// A text is not in its form.
    #[error("line {line}: {what}")]
    Line {
        /// The line, from 1.
        line: u64,
        /// What is wrong with it.
        what: String,
    },
    /// A file is not in its form.
    #[error("{0}")]
    File(String),
    /// The input ends with an error.
    #[error("the input can't be read: {0}")]
    Io(#[from] io::Error),
}

fn two_readings(readings: &[(Form, Vec<u8>)]) -> String {
    let mut text = "these are different bytes".to_owned();
    let mut options = Vec::new();
    for (form, bytes) in readings {
        // Writing to a string can't fail.
        let _ = write!(text, " as {form} (`{}`)", shortened(bytes));
        options.push(format!("--input {}", form.id()));
        text.push_str(if options.len() < readings.len() { " and" } else { "" });
    }
    format!("{text}; choose with {}", options.join(" or "))
}

/// A few bytes in hex.
fn shortened(bytes: &[u8]) -> String {
    const SHOWN: usize = 24;
    match bytes.get(..SHOWN) {
        Some(first) if bytes.len() > SHOWN => format!("{} …", spaced(first)),
        _ => spaced(bytes),
    }
}
