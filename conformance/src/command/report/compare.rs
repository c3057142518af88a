//! `actucheck report compare`.

use std::path::PathBuf;
use std::process::ExitCode;

use actucheck::report::compare::{self, Comparison, Regression};
use clap::Args;

use super::read;
use crate::command::shared::{Failure, Outputs, Reports};

const EXAMPLES: &str = "\
Examples:
  actucheck codec --report json=ours.json
  actucheck codec --report json=theirs.json -- ./their-adapter
  actucheck report compare ours.json theirs.json
  actucheck report compare *.json --report html=matrix.html
  actucheck report compare yesterday.json today.json --fail-on-regression

Compared are the totals and the verdict of each requirement, and what is done where the documents
leave a question unspecified. Of what an implementation gets wrong, the smallest check is shown.

A requirement is met worse than in the first report if more of as many checks fail, expected or
not; if any of another number of checks fails and none did before; or if none is judged any more.

Exit status: 0 compared, 1 something is worse and --fail-on-regression is given, 2 wrong usage,
3 the output could not be written.";

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
    /// Fail if a requirement is met worse than in the first report
    #[arg(long)]
    fail_on_regression: bool,
    #[command(flatten)]
    reports: Reports,
}

/// Reads the reports and writes what differs between them.
pub(crate) fn run(options: &Compare) -> Result<ExitCode, Failure> {
    if options.reports.formats().any(|format| !format.compares()) {
        return Err(Failure::usage(compare::ONE_RUN));
    }
    let others = options.others.iter().map(|file| read(file)).collect::<Result<_, _>>()?;
    let comparison = Comparison::of(read(&options.first)?, others).map_err(Failure::usage)?;
    Outputs::open(&options.reports, [])?.write(
        |format, out| format.write_comparison(&comparison, out),
        |out| compare::write_text(&comparison, out),
    )?;
    match comparison.regressions().as_slice() {
        regressions @ [_, ..] if options.fail_on_regression => {
            Err(Failure::failed(worse(regressions)))
        }
        _ => Ok(ExitCode::SUCCESS),
    }
}

/// The first few regressions, and how many more there are.
fn worse(regressions: &[Regression]) -> String {
    const SHOWN: usize = 5;
    let first: Vec<_> = regressions.iter().take(SHOWN).map(ToString::to_string).collect();
    let more = match regressions.len().saturating_sub(SHOWN) {
        0 => String::new(),
        more => format!("; and {more} more"),
    };
    format!("worse than in the first report: {}{more}", first.join("; "))
}
