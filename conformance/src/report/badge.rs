//! The report as a badge for a README, in the endpoint format of shields.io.

use std::io::{self, Write};

use serde::Serialize;

use super::model::Report;
use super::{json, words};
use crate::verdict::Verdict;

/// What a badge says. Its fields have the names of the endpoint format, version 1.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
struct Badge {
    schema_version: u8,
    label: String,
    message: String,
    color: &'static str,
    /// Whether the colour is that of a failure, whatever the page that shows it asks for.
    is_error: bool,
}

/// Writes a badge: the wires, and how many requirements have failed.
///
/// # Errors
/// If it can't be written.
pub fn write(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    let failed = report.requirements.iter().filter(|row| row.verdict.is_wrong());
    let failed = failed.filter(|row| row.verdict != Verdict::ExpectedFailure).count();
    let (message, color) = match report.exit_status() {
        0 => {
            let passed = report.summary.totals.count(Verdict::Pass);
            (format!("{} passed", words::count(passed, "check")), "brightgreen")
        }
        1 => (format!("{} failed", words::count(failed, "requirement")), "red"),
        _ => (report.word().to_owned(), "lightgrey"),
    };
    let wires = report.header.wires.iter().map(|wire| wire.id().to_owned());
    let label: Vec<_> = wires.chain(report.part()).collect();
    let badge = Badge {
        schema_version: 1,
        label: label.join(", "),
        message,
        color,
        is_error: report.exit_status() == 1,
    };
    json::write(&badge, out)
}
