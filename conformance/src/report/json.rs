//! The report for programs.

use std::io::{self, Write};

use serde::Serialize;

/// Writes a report, or several compared, as one JSON object.
///
/// # Errors
/// If it can't be written.
pub fn write(report: &impl Serialize, mut out: impl Write) -> io::Result<()> {
    serde_json::to_writer_pretty(&mut out, report)?;
    out.write_all(b"\n")?;
    out.flush()
}
