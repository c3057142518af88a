//! `actucheck report render`.

use std::path::PathBuf;
use std::process::ExitCode;

use actucheck::report::format::NO_JSONL;
use actucheck::report::{Format, screen};
use clap::Args;

use super::read;
use crate::command::WRITTEN;
use crate::command::shared::{Failure, Look, Outputs, Reports, next};

const EXAMPLES: &str = "\
Examples:
  actucheck report render report.json
      as `actucheck codec` printed it
  actucheck report render report.json --report html=report.html --report markdown=-";

/// Writes a report in other formats
#[derive(Debug, Args)]
#[command(after_help = format!("{EXAMPLES}\n\n{WRITTEN}"))]
pub(crate) struct Render {
    /// A report, as `--report json=FILE` writes it
    #[arg(value_name = "REPORT")]
    file: PathBuf,
    #[command(flatten)]
    reports: Reports,
    #[command(flatten)]
    look: Look,
}

/// Reads the report and writes it.
pub(crate) fn run(options: &Render) -> Result<ExitCode, Failure> {
    if options.reports.formats().any(|format| format == Format::Jsonl) {
        return Err(Failure::usage(NO_JSONL));
    }
    let report = read(&options.file)?;
    Outputs::open(&options.reports, [])?.write(
        |format, out| format.write(&report, out),
        |out| screen::write(&report, &options.look.terminal(Some(next(&report))), out),
    )?;
    Ok(ExitCode::SUCCESS)
}
