//! `actucheck show`.

use std::process::ExitCode;

use actucheck::report::text;

use clap::Args;

use super::WRITTEN;
use super::shared::{self, Failure, Growth};

const EXAMPLES: &str = "\
Example:
  actucheck show dynamixel2.stuffing.goal-position/encode";

/// Shows one check: what it asks, what it demands, and which sentence demands it
#[derive(Debug, Args)]
#[command(after_help = format!("{EXAMPLES}\n\n{WRITTEN}"))]
pub(crate) struct Show {
    /// The check's id, as in `actucheck list` and in reports
    id: String,
    #[command(flatten)]
    growth: Growth,
}

/// Prints one check.
pub(crate) fn run(options: &Show) -> Result<ExitCode, Failure> {
    let spec = shared::spec()?;
    let check = options.growth.named(&spec, &options.id, None)?;
    let mut text = Vec::new();
    text::check(&spec, &check, &mut text).map_err(Failure::incomplete)?;
    shared::print(&text)?;
    Ok(ExitCode::SUCCESS)
}
