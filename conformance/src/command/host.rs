//! `actucheck host`.

use std::collections::BTreeMap;
use std::process::ExitCode;

use actucheck::suite::{self, Options};
use actucheck_spec::Spec;
use clap::Args;

use super::shared::{self, Checking, Failure, Planned, Selection, Subjects};
use super::{ENDED, EXIT};

const EXAMPLES: &str = "\
Examples:
  actucheck host -- python3 my_adapter.py
      check a library that opens a port and talks with devices
  actucheck host --select '*.basic.*' -- ./my-adapter
      only what each call sends, and what it returns of a right answer
  actucheck host --select '*.read.flip-*' --report html=report.html -- ./my-adapter
      answers with one byte changed, with a page to read
  actucheck host --wire innfos -- conformance/adapters/innfos-python/run
      a library that sends datagrams
  actucheck host --port tcp -- ./my-adapter
      a library that opens serial ports over TCP
  actucheck host --partition 2/4 --report json=2.json -- ./my-adapter
      one of four parts, each on a machine of its own; `actucheck report merge` makes one report of them
  actucheck replay dynamixel2.host.after.action/read -- ./my-adapter
      one conversation again

For each check the host opens a port and makes calls, and the other end plays devices by a script: right \
answers, damaged and late ones, those of others, or none. The port is a pseudo-terminal, or a UDP port of this \
machine where packets are datagrams. What the host sends, what it returns, that it returns within --timeout, \
and that the next call is right, is judged by the documents. What they leave unspecified is recorded. `actucheck adapter guide` tells how an adapter opens a port.";

/// Checks a host: a library that talks with devices, behind an adapter
#[derive(Debug, Args)]
#[command(after_help = format!("{EXAMPLES}\n\n{EXIT}, {ENDED}"))]
#[command(mut_arg("timeout", |arg| arg.default_value("3")))]
#[command(mut_arg("command", |arg| arg.help("The adapter's command with its arguments")))]
pub(crate) struct Host {
    #[command(flatten)]
    selection: Selection,
    #[command(flatten)]
    checking: Checking,
}

/// Runs the checks, writes the reports, and returns the exit status.
pub(crate) fn run(options: &Host) -> Result<ExitCode, Failure> {
    let spec = shared::spec()?;
    let selection = &options.selection;
    options.checking.run(&spec, selection, |subjects| plan(selection, &spec, subjects))
}

fn plan<'a>(
    selection: &Selection,
    spec: &'a Spec,
    subjects: &Subjects,
) -> Result<Planned<'a>, Failure> {
    let hello = &subjects.hello;
    if !hello.is_host() {
        return Err(shared::no_host());
    }
    let wires = selection.offered_wires(hello)?;
    let plan = suite::host_plan(spec, &wires);
    if plan.ids().next().is_none() {
        let wires: Vec<_> = wires.iter().map(|wire| wire.id()).collect();
        let message = format!("there are no checks of hosts on {} yet", wires.join(" and "));
        return Err(Failure::usage(message));
    }
    let widest = suite::host_plan(spec, &wires);
    Ok(Planned { wires, plan, widest, records: BTreeMap::new(), options: Options::new() })
}
