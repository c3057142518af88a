//! `actucheck codec`.

use std::collections::BTreeMap;
use std::num::{NonZeroU32, NonZeroUsize};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use actucheck::adapter::Wire;
use actucheck::report::{Collector, End, Run, Stopped, screen};
use actucheck::run;
use actucheck::suite::check::Check;
use actucheck::suite::expect::{Expectations, Extended, Failures};
use actucheck::suite::plan::Plan;
use actucheck::suite::saved;
use actucheck::verdict::Outcome;
use actucheck_spec::Spec;
use clap::Args;

use super::shared::{
    self, Adapter, Failure, Look, Outputs, Reports, Selection, Streams, Subjects, Target,
};
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
pub(crate) struct Codec {
    #[command(flatten)]
    selection: Selection,
    /// Ask the checks of this file too, as `actucheck fuzz` writes it; may be given more than once
    #[arg(long, value_name = "FILE")]
    also: Vec<PathBuf>,
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
    /// How many processes of the adapter share the work
    #[arg(long, value_name = "N", default_value = "1", value_parser = clap::value_parser!(u8).range(1..))]
    jobs: u8,
    /// End the run after this many unexpected failures
    #[arg(long, value_name = "N")]
    max_fail: Option<NonZeroUsize>,
    /// Ask each check so many times in a row; answers that change are `flaky`
    #[arg(long, value_name = "N", default_value = "1")]
    repeat: NonZeroU32,
    #[command(flatten)]
    adapter: Adapter,
}

/// Runs the checks, writes the reports, and returns the exit status.
pub(crate) fn run(options: &Codec) -> Result<ExitCode, Failure> {
    let spec = shared::spec()?;
    let selection = &options.selection;
    let others = options.adapter.trace().into_iter().chain(options.write_expect.as_deref());
    let outputs = Outputs::open(&options.reports, others)?;
    let write_expect = options.write_expect.as_ref().map(|path| new_file(path, options));
    let write_expect = write_expect.transpose()?;
    let interrupted = shared::interrupted()?;
    let (mut outputs, start) = outputs.unless_failed(Start::new(options, &spec, &interrupted))?;
    let Start { mut subjects, wires, plan, records, mut expectations } = start;
    let hello = subjects.hello.clone();
    let size = plan.size();

    let template = "{bar:30} {pos}/{len} checks  {per_sec}  {eta} left";
    let progress = shared::progress(Some(size as u64), template);
    let (started, date) = (Instant::now(), shared::date());
    let run = Run {
        spec: &spec,
        date,
        command_line: shared::command_line(),
        implementation: &hello.implementation,
        wires: &wires,
        options: selection.growth.options(Some(&hello)),
        command: &options.adapter.command,
        records,
    };
    let mut streams = Streams::begin(&mut outputs, &run.header());
    let mut collector = Collector::new(&run);
    let mut failures = Failures::default();
    let mut limit = Limit::new(options.max_fail);
    let mut handed_on = 0_u64;
    let asked =
        run::run(&mut subjects.all, &plan, options.repeat, &interrupted, &mut |mut outcome| {
            handed_on += 1;
            if handed_on.is_multiple_of(64) {
                progress.inc(64);
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
    progress.finish_and_clear();

    let (log, traced) = subjects.end();
    expectations.unexpected().into_iter().for_each(|passes| collector.revise(passes));
    let report = collector.finish(End {
        seconds,
        stopped: if limit.is_reached() {
            Some(Stopped::MaxFail)
        } else {
            interrupted.load(Ordering::Relaxed).then_some(Stopped::Interrupted)
        },
        left: size.saturating_sub(asked),
        log,
    });
    let streamed = streams.end(&report.summary);
    let written = outputs.write(
        |format, out| format.write(&report, out),
        |out| screen::write(&report, &options.look.terminal(Some(shared::next(&report))), out),
    );
    if report.summary.stopped.is_none() {
        expectations.remarks().iter().for_each(|remark| anstream::eprintln!("actucheck: {remark}"));
    }
    let kept = write_expect.map_or(Ok(()), |target| {
        let name = target.name.clone();
        let new = expectations.with(&failures, &plan, &spec).map_err(Failure::incomplete)?;
        target.write(new.text.as_bytes())?;
        anstream::eprintln!("actucheck: {}", said(&name, &new, &failures, report.summary.stopped));
        Ok(())
    });
    let problems = [traced, streamed, written, kept];
    problems.into_iter().fold(Ok(()), shared::both)?;
    Ok(ExitCode::from(report.exit_status()))
}

/// The file for `--write-expect`. Rows that a person wrote are not lost by mistake.
fn new_file(path: &Path, options: &Codec) -> Result<Target, Failure> {
    let target = Target::new(path)?;
    let is_read = options.expect.as_deref().is_some_and(|read| Target::are_same(read, path));
    if target.has_content() && !is_read {
        let name = &target.name;
        let message =
            format!("{name} has rows already; give it to --expect too, so that they stay");
        return Err(Failure::usage(message));
    }
    Ok(target)
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
    wires: Vec<Wire>,
    plan: Plan<'a>,
    /// The files of the checks that `--also` adds, by the checks' ids.
    records: BTreeMap<String, PathBuf>,
    expectations: Expectations,
}

impl<'a> Start<'a> {
    fn new(
        options: &Codec,
        spec: &'a Spec,
        interrupted: &Arc<AtomicBool>,
    ) -> Result<Self, Failure> {
        let selection = &options.selection;
        let mut subjects = Subjects::start(&options.adapter, options.jobs, interrupted)?;
        let hello = subjects.hello.clone();
        let wires = selection.offered_wires(&hello)?;
        let mut plan = selection.growth.plan(spec, &wires, Some(&hello));
        subjects.say_other_role(&plan);
        let mut records = BTreeMap::new();
        for path in &options.also {
            let more = saved::read(path).map_err(Failure::usage)?;
            let selected = |check: &Check| wires.contains(&check.question.wire());
            let more: Vec<_> = more.into_iter().filter(selected).collect();
            records.extend(more.iter().map(|check| (check.id.clone(), path.clone())));
            plan.add(more);
        }
        let expectations = match &options.expect {
            Some(path) => Expectations::read(path, &plan, &selection.growth.widest(spec))
                .map_err(Failure::usage)?,
            None => Expectations::default(),
        };
        selection.restrict(&mut plan)?;
        Ok(Self { subjects, wires, plan, records, expectations })
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
