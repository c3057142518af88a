//! `actucheck codec`.

use std::collections::BTreeMap;
use std::num::NonZeroUsize;
use std::ops::ControlFlow;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use actucheck::adapter::Op;
use actucheck::report::{Report, Run, Stopped, text};
use actucheck::run;
use actucheck::suite::expect::Expectations;
use actucheck::suite::saved;
use actucheck::verdict::Outcome;
use indicatif::{ProgressBar, ProgressStyle};

use super::Failure;
use super::output::Outputs;
use crate::cli::Codec;

/// Runs the checks and writes the reports; the exit status says what came out.
pub(crate) fn run(options: &Codec) -> Result<ExitCode, Failure> {
    let spec = super::spec()?;
    let selection = &options.selection;
    let outputs = Outputs::open(&options.reports)?;
    let mut subjects = super::subjects(&options.adapter, options.jobs)?;
    let hello = subjects.hello.clone();
    let mut all = super::checks(&spec, selection.wire, &selection.growth, Some(&hello));
    let mut records = BTreeMap::new();
    for path in &options.also {
        let more = saved::read(path).map_err(|error| Failure::new(Failure::USAGE, error))?;
        for (_, check) in more.into_iter().filter(|(wire, _)| *wire == selection.wire) {
            records.insert(check.id.clone(), path.clone());
            all.push(check);
        }
    }
    let expectations = match &options.expect {
        Some(path) => {
            Expectations::read(path, &all).map_err(|error| Failure::new(Failure::USAGE, error))?
        }
        None => Expectations::default(),
    };
    let checks = super::selected(all, selection)?;

    let progress = progress(checks.len());
    let started = Instant::now();
    let mut limit = Limit::new(options.max_fail, super::interrupted()?);
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
        options: super::options(selection.wire, &selection.growth, Some(&hello)),
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

/// Shows on a terminal, and there only, after a second.
fn progress(checks: usize) -> ProgressBar {
    let bar = ProgressBar::new(checks as u64);
    let template = "{bar:30} {pos}/{len} checks  {per_sec}  {eta} left";
    // The template is a constant; one that indicatif does not like shows its default.
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style);
    }
    bar.enable_steady_tick(Duration::from_secs(1));
    bar
}
