//! Why an input can't be read.

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
    #[error("{}; choose with {}", readings(.0), options(.0))]
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

/// The bytes that an input is in several forms.
pub(super) fn readings(readings: &[(Form, Vec<u8>)]) -> String {
    let each = |(form, bytes): &(Form, Vec<u8>)| format!("as {form} (`{}`)", shortened(bytes));
    let each: Vec<_> = readings.iter().map(each).collect();
    format!("these are different bytes {}", each.join(" and "))
}

fn options(readings: &[(Form, Vec<u8>)]) -> String {
    let each: Vec<_> = readings.iter().map(|(form, _)| format!("--input {}", form.id())).collect();
    each.join(" or ")
}

/// A few bytes in hex.
fn shortened(bytes: &[u8]) -> String {
    const SHOWN: usize = 24;
    match bytes.get(..SHOWN) {
        Some(first) if bytes.len() > SHOWN => format!("{} …", spaced(first)),
        _ => spaced(bytes),
    }
}
