//! `actucheck list`.

use std::io::{self, Write as _};
use std::process::ExitCode;

use super::Failure;
use crate::cli::List;

/// Prints a line a check: its id and its requirement.
pub(crate) fn run(options: &List) -> Result<ExitCode, Failure> {
    let spec = super::spec()?;
    let selection = &options.selection;
    let checks = super::checks(&spec, selection.wire, &selection.growth, None);
    let checks = super::selected(checks, selection)?;
    let mut out = io::BufWriter::new(io::stdout().lock());
    for check in &checks {
        // A reader that has seen enough is no failure.
        if writeln!(out, "{}  {}  {}", check.id, check.level, check.requirement).is_err() {
            break;
        }
    }
    Ok(ExitCode::SUCCESS)
}
