//! `actucheck report render`.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;

use super::{read, refuse_jsonl, write};
use crate::command::WRITTEN;
use crate::command::shared::{Failure, Look, Reports};

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
    refuse_jsonl(&options.reports)?;
    let report = read(&options.file)?;
    write(&report, &options.reports, options.look)?;
    Ok(ExitCode::SUCCESS)
}
