//! `actucheck report compare`.

use std::path::PathBuf;
use std::process::ExitCode;

use actucheck::report::Format;
use actucheck::report::compare::{self, Comparison};
use clap::Args;

use super::read;
use crate::command::shared::{Failure, Outputs, Reports};

const EXAMPLES: &str = "\
Examples:
  actucheck codec --report json=ours.json
  actucheck codec --report json=theirs.json -- ./their-adapter
  actucheck report compare ours.json theirs.json
  actucheck report compare *.json --report html=matrix.html

Compared are the totals and the verdict of each requirement, and what is done where the documents
leave a question unspecified. Of what an implementation gets wrong, the smallest check is shown.

Exit status: 0 compared, 2 wrong usage.";

/// Shows which implementation breaks which requirement
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Compare {
    /// A report, as `--report json=FILE` writes it
    #[arg(value_name = "REPORT")]
    first: PathBuf,
    /// Reports of the same wire
    #[arg(required = true, value_name = "REPORT")]
    others: Vec<PathBuf>,
    #[command(flatten)]
    reports: Reports,
}

/// Reads the reports and writes what differs between them.
pub(crate) fn run(options: &Compare) -> Result<ExitCode, Failure> {
    if options.reports.any(Format::Junit) || options.reports.any(Format::Jsonl) {
        return Err(Failure::usage(compare::ONE_RUN));
    }
    let others = options.others.iter().map(|file| read(file)).collect::<Result<_, _>>()?;
    let comparison = Comparison::of(read(&options.first)?, others).map_err(Failure::usage)?;
    Outputs::open(&options.reports, [])?.write(
        |format, out| format.write_comparison(&comparison, out),
        |out| compare::write_text(&comparison, out),
    )?;
    Ok(ExitCode::SUCCESS)
}
