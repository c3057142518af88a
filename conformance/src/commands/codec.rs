//! `actucheck codec`.

use std::fs::File;
use std::io::{self, Write};
use std::num::NonZeroUsize;
use std::ops::ControlFlow;
use std::path::Path;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use actucheck::expect::Expectations;
use actucheck::record;
use actucheck::report::{self, Run, Stopped};
use actucheck::run;
use actucheck::verdict::Outcome;
use indicatif::{ProgressBar, ProgressStyle};

use super::Failure;
use crate::cli::Codec;

/// Runs the checks and writes the reports; the exit status says what came out.
pub(crate) fn run(options: &Codec) -> Result<ExitCode, Failure> {
    let spec = super::spec()?;
    let selection = &options.selection;
    let mut reports = open_reports(options)?;
    let mut testees = super::testees(&options.adapter, options.jobs)?;
    let hello = testees.hello.clone();
    let mut all = super::checks(&spec, selection.wire, &selection.growth, Some(&hello));
    for path in &options.also {
        let more = record::read(path).map_err(|error| Failure::new(Failure::USAGE, error))?;
        let of_wire = more.into_iter().filter(|(wire, _)| *wire == selection.wire);
        all.extend(of_wire.map(|(_, check)| check));
    }
    let expectations = match &options.expect {
        Some(path) => {
            Expectations::read(path, &all).map_err(|error| Failure::new(Failure::USAGE, error))?
        }
        None => Expectations::default(),
    };
    let checks = super::selected(all, selection)?;

    let progress = progress(checks.len());
    let mut limit = Limit::new(options.max_fail, super::interrupted()?);
    let mut outcomes = run::run(&mut testees.all, &checks, |outcome| {
        progress.inc(1);
        limit.after(outcome, &expectations)
    });
    progress.finish_and_clear();
    expectations.apply(&mut outcomes);

    let run = Run {
        spec: &spec,
        implementation: &hello.implementation,
        wire: selection.wire,
        command: &options.adapter.command,
        record: None,
        outcomes: &outcomes,
        stopped: limit.stopped,
        left: checks.iter().len().saturating_sub(outcomes.iter().len()),
        log: testees.end()?,
    };
    for (name, file) in &mut reports {
        report::json::write(&run, file).map_err(|error| cannot_write(name, &error))?;
    }
    write_text(&run, options)?;
    Ok(ExitCode::from(run.exit_status()))
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

/// A report's name and where it goes.
type OpenReport = (String, Box<dyn Write>);

/// Opens the reports before the run, so that a wrong path costs no time.
fn open_reports(options: &Codec) -> Result<Vec<OpenReport>, Failure> {
    let open = |path: &Path| -> io::Result<Box<dyn Write>> {
        if path == Path::new("-") {
            return Ok(Box::new(io::stdout()));
        }
        Ok(Box::new(io::BufWriter::new(File::create(path)?)))
    };
    let mut reports = Vec::new();
    for report in &options.report {
        let name = report.path.display().to_string();
        let file = open(&report.path).map_err(|error| {
            Failure::new(Failure::USAGE, format!("cannot write {name}: {error}"))
        })?;
        reports.push((name, file));
    }
    Ok(reports)
}

/// Standard output, unless a report for programs goes there.
fn write_text(run: &Run<'_>, options: &Codec) -> Result<(), Failure> {
    let taken = options.report.iter().any(|report| report.path == Path::new("-"));
    let written = if taken {
        report::text::write(run, &mut anstream::stderr())
    } else {
        report::text::write(run, &mut anstream::stdout())
    };
    written.map_err(|error| cannot_write("the report", &error))
}

fn cannot_write(name: &str, error: &io::Error) -> Failure {
    Failure::new(Failure::INCOMPLETE, format!("cannot write {name}: {error}"))
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
