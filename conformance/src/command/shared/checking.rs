//! A run of checks: who is asked, and what becomes of the outcomes.

use std::collections::BTreeMap;
use std::num::{NonZeroU32, NonZeroUsize};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use actucheck::adapter::{HostPort, Wire};
use actucheck::report::model::Part;
use actucheck::report::{Collector, End, Run, Stopped, screen};
use actucheck::run;
use actucheck::suite::Options;
use actucheck::suite::expect::{Expectations, Extended, Failures, Rows};
use actucheck::suite::partition::Partition;
use actucheck::suite::plan::{Outline, Plan};
use actucheck::verdict::Outcome;
use actucheck_spec::Spec;
use clap::Args;

use super::{
    Adapter, Failure, Look, Outputs, Reports, Selection, Streams, Subjects, Target, both,
    command_line, date, interrupted, next, progress,
};

/// The options of a run of checks that a codec or a host behind an adapter is asked.
#[derive(Debug, Args)]
pub(crate) struct Checking {
    #[command(flatten)]
    running: Running,
    /// How many processes of the adapter share the work
    #[arg(long, value_name = "N", default_value = "1", value_parser = clap::value_parser!(u8).range(1..))]
    jobs: u8,
    /// Ask only the part K of N of the checks, so that N machines share a run; `actucheck report merge`
    /// makes one report of the parts
    #[arg(long, value_name = "K/N", conflicts_with = "write_expect")]
    partition: Option<Partition>,
    #[command(flatten)]
    adapter: Adapter,
}

/// The options of a run of checks, whoever is asked.
#[derive(Debug, Args)]
pub(crate) struct Running {
    /// Expected failures: these checks may fail, and must not pass
    #[arg(long, value_name = "FILE")]
    expect: Option<PathBuf>,
    /// Write a file for --expect with what failed, by cause, with reasons to fill in; the rows of
    /// --expect stay, but ids that pass now go
    #[arg(long, value_name = "FILE")]
    write_expect: Option<PathBuf>,
    #[command(flatten)]
    reports: Reports,
    #[command(flatten)]
    look: Look,
    /// End the run after this many unexpected failures
    #[arg(long, value_name = "N")]
    max_fail: Option<NonZeroUsize>,
    /// Ask each check so many times in a row; answers that change are `flaky`
    #[arg(long, value_name = "N", default_value = "1")]
    repeat: NonZeroU32,
}

/// What is asked in a run.
pub(crate) struct Planned<'a> {
    pub(crate) wires: Vec<Wire>,
    pub(crate) plan: Plan<'a>,
    /// Checks of every kind that other options, or another implementation, have.
    pub(crate) widest: Plan<'a>,
    /// The files of the checks that `actucheck list` does not have, by the checks' ids.
    pub(crate) records: BTreeMap<String, PathBuf>,
    /// The options that determine the checks.
    pub(crate) options: Options,
}

/// Who is asked.
#[derive(Clone, Copy)]
pub(crate) struct Asked<'c> {
    /// The port that hosts get, if it is chosen.
    pub(crate) port: Option<HostPort>,
    /// The command that was started; empty without one.
    pub(crate) command: &'c [String],
    /// The words that ask checks again, before the glob of their ids, if `replay` does not.
    pub(crate) again: &'c [String],
    /// The part that is asked, if not the whole.
    pub(crate) partition: Option<Partition>,
    /// The options that verdicts may depend on, each with its value.
    pub(crate) settings: &'c [String],
}

impl Checking {
    /// Runs the selected checks of a plan, writes the reports, and returns the exit status.
    pub(crate) fn run<'a>(
        &self,
        spec: &'a Spec,
        selection: &Selection,
        plan: impl FnOnce(&mut Subjects) -> Result<Planned<'a>, Failure>,
    ) -> Result<ExitCode, Failure> {
        let Self { running, jobs, partition, adapter } = self;
        let settings = [running.settings(), adapter.settings()].concat();
        let asked = Asked {
            port: adapter.port(),
            command: &adapter.command,
            again: &[],
            partition: *partition,
            settings: &settings,
        };
        running.run(spec, selection, adapter.trace(), asked, |interrupted| {
            let mut subjects = Subjects::start(adapter, *jobs, interrupted)?;
            let planned = plan(&mut subjects)?;
            Ok((subjects, planned))
        })
    }
}

impl Running {
    /// Runs the selected checks of a plan, writes the reports, and returns the exit status. `trace` is
    /// another file that is written.
    pub(crate) fn run<'a>(
        &self,
        spec: &'a Spec,
        selection: &Selection,
        trace: Option<&Path>,
        Asked { port, command, again, partition, settings }: Asked<'_>,
        start: impl FnOnce(&Arc<AtomicBool>) -> Result<(Subjects, Planned<'a>), Failure>,
    ) -> Result<ExitCode, Failure> {
        let others = trace.into_iter().chain(self.write_expect.as_deref());
        let outputs = Outputs::open(&self.reports, others)?;
        let write_expect =
            self.write_expect.as_ref().map(|path| self.new_file(path)).transpose()?;
        let interrupted = interrupted()?;
        let start = Start::new(self, selection, &interrupted, start);
        let (mut outputs, start) = outputs.unless_failed(start)?;
        let Start { mut subjects, mut planned, mut expectations } = start;
        let part = partition.map(|partition| take_part(&mut planned.plan, partition, settings));
        let Planned { wires, plan, records, options, .. } = planned;
        let hello = subjects.hello.clone();
        let size = plan.size();
        let template = "{bar:30} {pos}/{len} checks  {per_sec}  {eta} left";
        let bar = progress(Some(size as u64), template);
        let started = Instant::now();
        let run = Run {
            spec,
            date: date(),
            command_line: command_line(),
            implementation: &hello.implementation,
            wires: &wires,
            options,
            part,
            port,
            command,
            again,
            records,
        };
        let mut streams = Streams::begin(&mut outputs, &run.header());
        let mut collector = Collector::new(&run);
        let mut failures = Failures::default();
        let mut limit = Limit::new(self.max_fail);
        // A bar that moves too often takes time.
        let stride = if size > 10_000 { 64 } else { 1 };
        let mut handed_on = 0_u64;
        let asked =
            run::run(&mut subjects.all, &plan, self.repeat, &interrupted, &mut |mut outcome| {
                handed_on += 1;
                if handed_on.is_multiple_of(stride) {
                    bar.inc(stride);
                }
                expectations.apply(&mut outcome);
                if write_expect.is_some() {
                    failures.add(&outcome);
                }
                streams.check(&run, &outcome);
                let goes_on = limit.after(&outcome);
                collector.add(outcome);
                goes_on
            });
        let seconds = started.elapsed().as_secs_f64();
        bar.finish_and_clear();

        let traffic = subjects.traffic();
        let (log, traced) = subjects.end();
        let audit = expectations.audit();
        audit.unexpected().into_iter().for_each(|passes| collector.revise(passes));
        let report = collector.finish(End {
            seconds,
            stopped: if limit.is_reached() {
                Some(Stopped::MaxFail)
            } else {
                interrupted.load(Ordering::Relaxed).then_some(Stopped::Interrupted)
            },
            left: size.saturating_sub(asked),
            log,
            traffic,
            expectations: partition.filter(|_| audit.is_of_file()).map(|_| audit.clone()),
        });
        let streamed = streams.end(&report.summary);
        let written = outputs.write(
            |format, out| format.write(&report, out),
            |out| screen::write(&report, &self.look.terminal(Some(next(&report))), out),
        );
        // Of a part, they are made when all parts are merged.
        if report.summary.stopped.is_none() && partition.is_none() {
            say(&audit.remarks());
        }
        let kept = write_expect.map_or(Ok(()), |target| {
            let name = target.name.clone();
            let new = expectations.with(&failures, &plan, spec).map_err(Failure::incomplete)?;
            target.write(new.text.as_bytes())?;
            anstream::eprintln!(
                "actucheck: {}",
                said(&name, &new, &failures, report.summary.stopped)
            );
            Ok(())
        });
        let problems = [traced, streamed, written, kept];
        problems.into_iter().fold(Ok(()), both)?;
        Ok(ExitCode::from(report.exit_status()))
    }

    /// The options that verdicts may depend on, each with its value.
    fn settings(&self) -> Vec<String> {
        let max_fail = self.max_fail.map(|most| format!("--max-fail {most}"));
        std::iter::once(format!("--repeat {}", self.repeat)).chain(max_fail).collect()
    }

    /// The file for `--write-expect`. Rows that a person wrote are not lost by mistake.
    fn new_file(&self, path: &Path) -> Result<Target, Failure> {
        let target = Target::new(path)?;
        let is_read = self.expect.as_deref().is_some_and(|read| Target::are_same(read, path));
        if target.has_content() && !is_read {
            let name = &target.name;
            let message =
                format!("{name} has rows already; give it to --expect too, so that they stay");
            return Err(Failure::usage(message));
        }
        Ok(target)
    }
}

/// Takes the part out of a plan, and says which it is.
fn take_part(plan: &mut Plan<'_>, partition: Partition, settings: &[String]) -> Part {
    let Outline { checks, ids } = plan.outline();
    plan.take_part(partition);
    Part { partition, checks, ids, settings: settings.to_vec() }
}

/// Tells what a user should know, a line each.
pub(crate) fn say(remarks: &[String]) {
    for remark in remarks {
        anstream::eprintln!("actucheck: {remark}");
    }
}

/// What was written for `--write-expect`, in a sentence.
fn said(name: &str, new: &Extended, failures: &Failures, stopped: Option<Stopped>) -> String {
    let (rows, failures) = (new.new, failures.count());
    let mut said = vec![format!("{name} has {rows} new rows for {failures} failures")];
    if rows > 0 {
        said.push("write the reasons".to_owned());
    }
    if new.outdated > 0 {
        said.push(format!("ids that pass now are out: {}", new.outdated));
    }
    if new.left_out > 0 {
        said.push(format!("not in it, as too many or the adapter's own: {}", new.left_out));
    }
    if stopped.is_some() {
        said.push("the run ended early, so more may be needed".to_owned());
    }
    said.join("; ")
}

/// What a run needs before its first check.
struct Start<'a> {
    subjects: Subjects,
    planned: Planned<'a>,
    expectations: Expectations,
}

impl<'a> Start<'a> {
    fn new(
        running: &Running,
        selection: &Selection,
        interrupted: &Arc<AtomicBool>,
        start: impl FnOnce(&Arc<AtomicBool>) -> Result<(Subjects, Planned<'a>), Failure>,
    ) -> Result<Self, Failure> {
        // A file that can't be used is told before anything is started or opened.
        let rows = running.expect.as_deref().map(Rows::read).transpose().map_err(Failure::usage)?;
        let (subjects, mut planned) = start(interrupted)?;
        let expectations = match rows {
            Some(rows) => rows.with(&planned.plan, &planned.widest).map_err(Failure::usage)?,
            None => Expectations::default(),
        };
        selection.restrict(&mut planned.plan)?;
        Ok(Self { subjects, planned, expectations })
    }
}

/// What ends a run early.
struct Limit {
    max_fail: Option<NonZeroUsize>,
    failed: usize,
}

impl Limit {
    const fn new(max_fail: Option<NonZeroUsize>) -> Self {
        Self { max_fail, failed: 0 }
    }

    fn is_reached(&self) -> bool {
        self.max_fail.is_some_and(|most| self.failed >= most.get())
    }

    /// Whether the run continues after this outcome.
    fn after(&mut self, outcome: &Outcome) -> ControlFlow<()> {
        if outcome.verdict.is_failure() {
            self.failed += 1;
        }
        if self.is_reached() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}
