//! The report for programs.

use std::io::{self, Write};

use serde::Serialize;

use super::{Run, Stopped};
use crate::protocol::Implementation;
use crate::verdict::{Outcome, Totals};

/// Version of the report's form. It changes when a field goes or takes another meaning.
pub const VERSION: u32 = 1;

#[derive(Serialize)]
struct Report<'a> {
    version: u32,
    actucheck: &'static str,
    implementation: &'a Implementation,
    wire: &'static str,
    totals: Totals,
    stopped: Option<Stopped>,
    left: usize,
    results: &'a [Outcome],
}

/// Writes the report as one JSON object.
///
/// # Errors
/// If it can't be written.
pub fn write(run: &Run<'_>, mut out: impl Write) -> io::Result<()> {
    let report = Report {
        version: VERSION,
        actucheck: env!("CARGO_PKG_VERSION"),
        implementation: run.implementation,
        wire: run.wire.id(),
        totals: run.totals(),
        stopped: run.stopped,
        left: run.left,
        results: run.outcomes,
    };
    serde_json::to_writer_pretty(&mut out, &report)?;
    out.write_all(b"\n")?;
    out.flush()
}
