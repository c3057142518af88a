//! `actucheck adapter guide`.

use std::io::{self, Write as _};
use std::process::ExitCode;

use clap::Args;

const EXAMPLES: &str = "\
Example:
  actucheck adapter guide | less";

/// Prints the guide for authors of adapters
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Guide;

const GUIDE: &str = include_str!("../../../adapters/GUIDE.md");

/// Prints the guide.
pub(crate) fn run() -> ExitCode {
    // A closed pipe, as of `| head`, is not an error.
    let _ = io::stdout().write_all(GUIDE.as_bytes());
    ExitCode::SUCCESS
}
