//! `actucheck codec`.

use std::fs::File;
use std::io::{self, Write};
use std::path::Path;
use std::process::ExitCode;
use std::time::Duration;

use actucheck::expect::Expectations;
use actucheck::report::{self, Run};
use actucheck::run;
use indicatif::{ProgressBar, ProgressStyle};

use super::Failure;
use crate::cli::Codec;

/// Runs the checks and writes the reports; the exit status says what came out.
pub(crate) fn run(options: &Codec) -> Result<ExitCode, Failure> {
    let spec = super::spec()?;
    let selection = &options.selection;
    let all = super::checks(&spec, selection.wire, &selection.growth);
    let expectations = match &options.expect {
        Some(path) => {
            Expectations::read(path, &all).map_err(|error| Failure::new(Failure::USAGE, error))?
        }
        None => Expectations::default(),
    };
    let checks = super::selected(all, selection)?;
    let mut reports = open_reports(options)?;
    let mut testee = super::testee(&options.adapter)?;

    let progress = progress(checks.len());
    let mut outcomes = run::run(testee.as_mut(), &checks, |_| progress.inc(1));
    progress.finish_and_clear();
    expectations.apply(&mut outcomes);

    let hello = testee.hello().clone();
    let run = Run {
        spec: &spec,
        implementation: &hello.implementation,
        wire: selection.wire,
        command: &options.adapter.command,
        outcomes: &outcomes,
        log: testee.log(),
    };
    for (name, file) in &mut reports {
        report::json::write(&run, file).map_err(|error| cannot_write(name, &error))?;
    }
    write_text(&run, options)?;
    Ok(ExitCode::from(run.totals().exit_status()))
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
