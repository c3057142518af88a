//! `actucheck list`.

use std::io::{self, Write as _};
use std::process::ExitCode;

use actucheck::suite;
use actucheck::suite::check::Check;
use clap::Args;

use super::WRITTEN;
use super::shared::{self, Failure, Growth, Selection};

const EXAMPLES: &str = "\
Examples:
  actucheck list --select '*stuffing.body*' | head
  actucheck list --wire innfos --skip '*negative*'";

/// Lists the checks of codecs, then those of hosts
#[derive(Debug, Args)]
#[command(after_help = format!("{EXAMPLES}\n\n{WRITTEN}"))]
pub(crate) struct List {
    #[command(flatten)]
    selection: Selection,
    #[command(flatten)]
    growth: Growth,
}

/// Prints one line per check: id, level and requirement.
pub(crate) fn run(options: &List) -> Result<ExitCode, Failure> {
    let spec = shared::spec()?;
    let selection = &options.selection;
    let wires = selection.wires();
    let hosts = suite::host_plan(&spec, &wires);
    let mut plan = options.growth.plan(&spec, &wires, None).and(hosts);
    selection.restrict(&mut plan)?;
    let mut out = io::BufWriter::new(io::stdout().lock());
    let line = |check: Check| writeln!(out, "{}  {}  {}", check.id, check.level, check.requirement);
    let written = plan.checks().try_for_each(line).and_then(|()| out.flush());
    shared::printed(written)?;
    Ok(ExitCode::SUCCESS)
}
