//! `actucheck codec`.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::process::ExitCode;

use actucheck::suite::check::Check;
use actucheck::suite::saved;
use actucheck_spec::Spec;
use clap::Args;

use super::shared::{self, Checking, Failure, Growth, Planned, Selection, Subjects};
use super::{ENDED, EXIT};

const EXAMPLES: &str = "\
Examples:
  actucheck codec
      check the built-in codec
  actucheck codec -- python3 my_adapter.py
      check a library behind an adapter
  actucheck codec --select '*stuffing*' --wire dynamixel2 -- ./my-adapter
      only some checks, of one of the wires that the adapter offers
  actucheck codec --report html=report.html --report junit=report.xml -- ./my-adapter
      with a page to read and a file for what collects the results of tests
  actucheck codec --report markdown+=\"$GITHUB_STEP_SUMMARY\" -- ./my-adapter
      adds to a file, as to the page of a GitHub job
  actucheck codec --report json=- -- ./my-adapter | jq .totals
      for a program: totals, requirements, and the smallest checks of each that did not pass
  actucheck codec --report jsonl=- -- ./my-adapter | jq -r 'select(.verdict == \"fail\").id'
      every outcome as it comes, one JSON object a line
  actucheck codec --cases 20000 --body-length 7 --jobs 4 -- ./my-adapter
      more than half a million checks
  actucheck codec --write-expect expected.yaml -- ./my-adapter
      notes what fails today as expected failures, by cause, with reasons to fill in
  actucheck codec --expect expected.yaml -- ./my-adapter
      passes as long as only that fails
  actucheck codec --expect expected.yaml --write-expect expected.yaml -- ./my-adapter
      adds what is new, and takes out what passes now
  actucheck codec --partition 2/4 --report json=2.json -- ./my-adapter
      one of four parts, each on a machine of its own; `actucheck report merge` makes one report of them
  actucheck codec --jobs 4 --max-fail 10 -- ./my-adapter
      four adapters side by side, until something failed ten times

Ctrl-C ends a run early and reports what was found so far; a second one ends it without.

A file of a report is replaced when the new report is whole. If a run cannot begin, as of a mistyped \
command, the reports of the run before stay, but a junit report says in an error why: else a CI \
server would take the old one for the new one.

What fails is asked again in a second process. If it does not fail in the same way there, it is \
`flaky`: it depends on what was asked before, which is then searched, or on time.";

/// Checks a codec: the built-in one, or a library behind an adapter
#[derive(Debug, Args)]
#[command(after_help = format!("{EXAMPLES}\n\n{EXIT}, {ENDED}"))]
#[command(mut_arg("port", |arg| arg.hide(true)))]
pub(crate) struct Codec {
    #[command(flatten)]
    selection: Selection,
    #[command(flatten)]
    growth: Growth,
    /// Ask the checks of this file too, as `actucheck fuzz` writes it; may be given more than once
    #[arg(long, value_name = "FILE")]
    also: Vec<PathBuf>,
    #[command(flatten)]
    checking: Checking,
}

/// Runs the checks, writes the reports, and returns the exit status.
pub(crate) fn run(options: &Codec) -> Result<ExitCode, Failure> {
    let spec = shared::spec()?;
    options.checking.run(&spec, &options.selection, |subjects| options.plan(&spec, subjects))
}

impl Codec {
    fn plan<'a>(&self, spec: &'a Spec, subjects: &mut Subjects) -> Result<Planned<'a>, Failure> {
        let hello = subjects.hello.clone();
        let wires = self.selection.offered_wires(&hello)?;
        let mut plan = self.growth.plan(spec, &wires, Some(&hello));
        subjects.say_other_role(&plan);
        let mut records = BTreeMap::new();
        for path in &self.also {
            let more = saved::read(path).map_err(Failure::usage)?;
            let selected = |check: &Check| wires.contains(&check.question.wire());
            let more: Vec<_> = more.into_iter().filter(selected).collect();
            records.extend(more.iter().map(|check| (check.id.clone(), path.clone())));
            plan.add(more);
        }
        let widest = self.growth.widest(spec);
        let options = self.growth.options(Some(&hello));
        Ok(Planned { wires, plan, widest, records, options })
    }
}
