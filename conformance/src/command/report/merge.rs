//! `actucheck report merge`.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use actucheck::report::merge::{Named, merge};
use clap::Args;

use super::{read, refuse_jsonl, write};
use crate::command::shared::{self, Failure, Look, Reports, say};

const EXAMPLES: &str = "\
Examples:
  actucheck codec --partition 1/2 --report json=1.json -- ./my-adapter
  actucheck codec --partition 2/2 --report json=2.json -- ./my-adapter
  actucheck report merge 1.json 2.json
      the report of the whole run, as one machine would have written it
  actucheck report merge parts/*.json --report junit=junit.xml --report html=report.html

The parts are of one run: of the same implementation, version, checks and options, and each is there
once. The time is the sum of theirs. A check that is expected to fail and passes is told here if
it takes all parts to know it.

Exit status: that of the whole run: 0 all passed, 1 something failed, was flaky, crashed or gave no answer in \
time, 3 something could not be run or written, or the adapter itself is at fault; 2 the reports are not \
those of all parts of one run, or wrong usage";

/// Merges the reports of all parts of a run into that of the whole
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Merge {
    /// The report of a part, as `--partition K/N` with `--report json=FILE` writes it
    #[arg(required = true, value_name = "PART")]
    files: Vec<PathBuf>,
    #[command(flatten)]
    reports: Reports,
    #[command(flatten)]
    look: Look,
}

/// Reads the reports, and writes that of the whole run.
pub(crate) fn run(options: &Merge) -> Result<ExitCode, Failure> {
    refuse_jsonl(&options.reports)?;
    let named = |file: &PathBuf| Ok((name(file), read(file)?));
    let parts = options.files.iter().map(named).collect::<Result<Vec<Named>, _>>()?;
    let (report, expectations) = merge(&shared::spec()?, parts).map_err(Failure::usage)?;
    write(&report, &options.reports, options.look)?;
    if let Some(audit) = expectations.filter(|_| report.summary.stopped.is_none()) {
        say(&audit.remarks());
    }
    Ok(ExitCode::from(report.exit_status()))
}

fn name(file: &Path) -> String {
    file.display().to_string()
}
