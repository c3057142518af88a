//! `actucheck adapter guide`.

use std::process::ExitCode;

use clap::Args;

use crate::command::WRITTEN;
use crate::command::shared::{self, Failure};

const EXAMPLES: &str = "\
Example:
  actucheck adapter guide | less";

/// Prints the guide for authors of adapters
#[derive(Debug, Args)]
#[command(after_help = format!("{EXAMPLES}\n\n{WRITTEN}"))]
pub(crate) struct Guide;

const GUIDE: &str = include_str!("../../../adapters/GUIDE.md");

/// Prints the guide.
pub(crate) fn run() -> Result<ExitCode, Failure> {
    shared::print(GUIDE)?;
    Ok(ExitCode::SUCCESS)
}
