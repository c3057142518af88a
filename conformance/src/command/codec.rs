//! `actucheck codec`.

use std::collections::BTreeMap;
use std::num::NonZeroUsize;
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use actucheck::adapter::Op;
use actucheck::report::{Report, Run, Stopped, text};
use actucheck::run;
use actucheck::suite::expect::Expectations;
use actucheck::suite::saved;
use actucheck::verdict::Outcome;
use clap::Args;

use super::shared::{self, Adapter, Failure, Outputs, Reports, Selection, Subjects};

const EXAMPLES: &str = "\
Examples:
  actucheck codec
      check the built-in codec
  actucheck codec -- python3 my_adapter.py
      check a library behind an adapter
  actucheck codec --select '*stuffing*' -- ./my-adapter
      only some checks
  actucheck codec --report html=report.html --report junit=report.xml -- ./my-adapter
      with a page to read and a file for what collects the results of tests
  actucheck codec --report json=- -- ./my-adapter | jq .totals
      everything, for a program
  actucheck codec --cases 20000 --body-length 7 --jobs 4 -- ./my-adapter
      more than half a million checks
  actucheck codec --jobs 4 --max-fail 10 -- ./my-adapter
      four adapters side by side, until something failed ten times

Ctrl-C ends a run early and reports what was found so far.

Exit status: 0 all passed, 1 something failed, 2 wrong usage, 3 something could not be run, \
4 the adapter could not be started.";

/// Checks a codec: the built-in one, or a library behind an adapter
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Codec {
    #[command(flatten)]
    selection: Selection,
    /// Ask the checks of this file too, as `actucheck fuzz` writes it; may be given more than once
    #[arg(long, value_name = "FILE")]
    also: Vec<PathBuf>,
    /// Known failures, which do not fail the run as long as they do fail
    #[arg(long, value_name = "FILE")]
    expect: Option<PathBuf>,
    #[command(flatten)]
    reports: Reports,
    /// How many processes of the adapter share the work
    #[arg(long, value_name = "N", default_value = "1", value_parser = clap::value_parser!(u8).range(1..))]
    jobs: u8,
    /// End the run after so many unexpected failures
    #[arg(long, value_name = "N")]
    max_fail: Option<NonZeroUsize>,
    #[command(flatten)]
    adapter: Adapter,
}

/// Runs the checks and writes the reports; the exit status says what came out.
pub(crate) fn run(options: &Codec) -> Result<ExitCode, Failure> {
    let spec = shared::spec()?;
    let selection = &options.selection;
    let outputs = Outputs::open(&options.reports)?;
    let mut subjects = Subjects::start(&options.adapter, options.jobs)?;
    let hello = subjects.hello.clone();
    let mut all = selection.growth.checks(&spec, selection.wire, Some(&hello));
    let mut records = BTreeMap::new();
    for path in &options.also {
        let more = saved::read(path).map_err(Failure::usage)?;
        for (_, check) in more.into_iter().filter(|(wire, _)| *wire == selection.wire) {
            records.insert(check.id.clone(), path.clone());
            all.push(check);
        }
    }
    let expectations = match &options.expect {
        Some(path) => Expectations::read(path, &all).map_err(Failure::usage)?,
        None => Expectations::default(),
    };
    let checks = selection.of(all)?;

    let template = "{bar:30} {pos}/{len} checks  {per_sec}  {eta} left";
    let progress = shared::progress(Some(checks.len() as u64), template);
    let started = Instant::now();
    let mut limit = Limit::new(options.max_fail, shared::interrupted()?);
    let mut outcomes = run::run(&mut subjects.all, &checks, |outcome| {
        progress.inc(1);
        limit.after(outcome, &expectations)
    });
    let seconds = started.elapsed().as_secs_f64();
    progress.finish_and_clear();
    // The op that no adapter has is none of the checks.
    let asked = outcomes.iter().filter(|outcome| outcome.request != Some(Op::Invented)).count();
    expectations.apply(&mut outcomes);

    let report = Report::from(Run {
        spec: &spec,
        implementation: &hello.implementation,
        options: selection.growth.options(selection.wire, Some(&hello)),
        command: &options.adapter.command,
        records,
        left: checks.len().saturating_sub(asked),
        outcomes,
        stopped: limit.stopped,
        seconds,
        log: subjects.end()?,
    });
    outputs.write(|format, out| format.write(&report, out), |out| text::write(&report, out))?;
    Ok(ExitCode::from(report.exit_status()))
}

/// What ends a run early.
struct Limit {
    interrupted: Arc<AtomicBool>,
    max_fail: Option<NonZeroUsize>,
    failed: usize,
    stopped: Option<Stopped>,
}

impl Limit {
    fn new(max_fail: Option<NonZeroUsize>, interrupted: Arc<AtomicBool>) -> Self {
        Self { interrupted, max_fail, failed: 0, stopped: None }
    }

    /// Whether the run goes on after this outcome.
    fn after(&mut self, outcome: &Outcome, expectations: &Expectations) -> ControlFlow<()> {
        if outcome.verdict.is_failure() && !expectations.expect(&outcome.id) {
            self.failed += 1;
        }
        if self.interrupted.load(Ordering::Relaxed) {
            self.stopped = Some(Stopped::Interrupted);
        } else if self.max_fail.is_some_and(|most| self.failed >= most.get()) {
            self.stopped = Some(Stopped::MaxFail);
        } else {
            return ControlFlow::Continue(());
        }
        ControlFlow::Break(())
    }
}
