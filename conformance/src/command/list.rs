//! `actucheck list`.

use std::collections::BTreeSet;
use std::io::{self, Write as _};
use std::process::ExitCode;

use actucheck::adapter::Question;
use actucheck::suite;
use actucheck::suite::check::Check;
use actucheck::suite::plan::Plan;
use actucheck_spec::model::Role;
use clap::Args;

use super::WRITTEN;
use super::shared::{self, Failure, Growth, Selection, one_of};

const EXAMPLES: &str = "\
Examples:
  actucheck list --select '*stuffing.body*' | head
  actucheck list --wire innfos --skip '*negative*'
  actucheck list --role device";

/// Lists the checks of codecs, then those of hosts, then those of devices
#[derive(Debug, Args)]
#[command(after_help = format!("{EXAMPLES}\n\n{WRITTEN}"))]
pub(crate) struct List {
    #[command(flatten)]
    selection: Selection,
    /// Only the checks of this role
    #[arg(long, value_parser = one_of(ROLES))]
    role: Option<Role>,
    #[command(flatten)]
    growth: Growth,
}

const ROLES: [(Role, &str, &str); 3] = [
    (Role::Codec, "codec", "What builds and reads packets"),
    (Role::Host, "host", "What makes calls on a port"),
    (Role::Device, "device", "What answers on a port"),
];

/// Prints one line per check: id, level and requirement.
pub(crate) fn run(options: &List) -> Result<ExitCode, Failure> {
    let spec = shared::spec()?;
    let selection = &options.selection;
    let wires = selection.wires();
    let role = |role| options.role.is_none_or(|only| only == role);
    let mut plan = Plan::of(Vec::new());
    if role(Role::Codec) {
        plan = plan.and(options.growth.plan(&spec, &wires, None));
    }
    if role(Role::Host) {
        plan = plan.and(suite::host_plan(&spec, &wires));
    }
    if role(Role::Device) {
        plan = plan.and(suite::every_device_plan(&spec, &wires));
    }
    selection.restrict(&mut plan)?;
    let mut out = io::BufWriter::new(io::stdout().lock());
    // Devices of several models have the same check.
    let mut of_devices = BTreeSet::new();
    let is_new = |check: &Check| {
        !matches!(check.question, Question::Device { .. }) || of_devices.insert(check.id.clone())
    };
    let line = |check: Check| writeln!(out, "{}  {}  {}", check.id, check.level, check.requirement);
    let mut checks = plan.checks().filter(is_new);
    let written = checks.try_for_each(line).and_then(|()| out.flush());
    shared::printed(written)?;
    Ok(ExitCode::SUCCESS)
}
