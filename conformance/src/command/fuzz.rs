//! `actucheck fuzz`.

use std::hash::{BuildHasher, RandomState};
use std::io::{self, Write};
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

use actucheck::adapter::Wire;
use actucheck::blackbox::{Finding, Fuzzed, fuzz};
use actucheck::report::{Collector, End, Report, Run, text};
use actucheck::suite::Options;
use actucheck::suite::saved;
use clap::Args;
use indicatif::ProgressBar;

use super::shared::{self, Adapter, Failure, Subjects, duration, wire};

const EXAMPLES: &str = "\
Examples:
  actucheck fuzz -- python3 my_adapter.py
      for a minute, from another seed each time
  actucheck fuzz --seed 7 --cases 100000 -- ./my-adapter
      the same again, whatever the machine
  actucheck replay findings.yaml -- ./my-adapter
      what was found, asked again

Exit status: 0 nothing found, 1 something found, 2 wrong usage, 3 the adapter failed too often, \
4 the adapter could not be started.";

/// Looks for failures that no check foresees, and shrinks them
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Fuzz {
    /// The wire whose packets are generated
    #[arg(long, value_parser = wire(), default_value_t)]
    wire: Wire,
    /// How long to fuzz, as in 90s, 10m or 1h; one minute if neither this nor --cases is given
    #[arg(long, value_name = "TIME", value_parser = duration, conflicts_with = "cases")]
    time: Option<Duration>,
    /// How many probes are generated
    #[arg(long, value_name = "N")]
    cases: Option<u64>,
    /// The seed of the probes; another one each time if it is not given
    #[arg(long, value_name = "N")]
    seed: Option<u64>,
    /// Where to write what was found
    #[arg(long, value_name = "FILE", default_value = "findings.yaml")]
    out: PathBuf,
    #[command(flatten)]
    adapter: Adapter,
}

/// The duration if the user gives neither a time nor a number of probes.
const MINUTE: Duration = Duration::from_mins(1);

/// How often a failing adapter is restarted. Every crash needs one restart, also a crash that was
/// seen before.
const RESTARTS: u32 = 1000;

/// Fuzzes, prints the findings and saves them.
pub(crate) fn run(options: &Fuzz) -> Result<ExitCode, Failure> {
    let spec = shared::spec()?;
    let mut subjects = Subjects::start_with(&options.adapter, 1, RESTARTS)?;
    let hello = subjects.hello.clone();
    let seed = options.seed.unwrap_or_else(|| RandomState::new().hash_one(()));
    let cases = options.cases.unwrap_or(u64::MAX);
    let time = options.time.or_else(|| options.cases.is_none().then_some(MINUTE));

    let started = Instant::now();
    let interrupted = shared::interrupted()?;
    let progress = progress(options.cases);
    let Some(subject) = subjects.all.first_mut() else { return Ok(ExitCode::SUCCESS) };
    let fuzzed = fuzz(&spec, options.wire, seed, cases, subject.as_mut(), |asked, found| {
        progress.set_position(asked);
        progress.set_message(format!("{found} kinds of failure"));
        let over = time.is_some_and(|time| started.elapsed() >= time);
        if over || interrupted.load(Ordering::Relaxed) {
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    });
    progress.finish_and_clear();
    let log = subjects.end()?;

    keep(options, &fuzzed.findings)?;
    let took = started.elapsed();
    let found = fuzzed.findings.iter();
    let run = Run {
        spec: &spec,
        implementation: &hello.implementation,
        wires: &[options.wire],
        options: Options { seed, ..Options::new() },
        command: &options.adapter.command,
        records: found.clone().map(|it| (it.check.id.clone(), options.out.clone())).collect(),
    };
    let mut collector = Collector::new(&run);
    collector.extend(found.map(|finding| finding.outcome.clone()));
    let report = collector.finish(End { seconds: took.as_secs_f64(), ..End::default() });
    let mut out = anstream::stdout();
    show(&report, &fuzzed.findings, &mut out)
        .and_then(|()| summary(options, seed, &fuzzed, took, &mut out))
        .map_err(Failure::incomplete)?;
    if let Some(reason) = &fuzzed.given_up {
        let last = log.lines().last().map(|line| format!("; it said `{line}`")).unwrap_or_default();
        return Err(Failure::incomplete(format!("{reason}{last}")));
    }
    Ok(ExitCode::from(u8::from(!fuzzed.findings.is_empty())))
}

/// Writes the smallest case of each kind of failure to a file that `replay` and `codec` take.
fn keep(options: &Fuzz, findings: &[Finding]) -> Result<(), Failure> {
    if findings.is_empty() {
        return Ok(());
    }
    let checks: Vec<_> = findings.iter().map(|finding| finding.check.clone()).collect();
    let cannot_write = |error: &dyn std::fmt::Display| {
        let path = options.out.display();
        Failure::incomplete(format!("cannot write {path}: {error}"))
    };
    let text = saved::write(&checks).map_err(|error| cannot_write(&error))?;
    std::fs::write(&options.out, text).map_err(|error| cannot_write(&error))
}

/// Prints the report on the smallest case of each kind of failure, then one line per kind.
fn show(report: &Report, findings: &[Finding], out: &mut impl Write) -> io::Result<()> {
    if findings.is_empty() {
        return Ok(());
    }
    text::write(report, out)?;
    writeln!(out)?;
    for Finding { kind, check, times, .. } in findings {
        writeln!(out, "{} {}: {}", kind.op, kind.requirement, kind.symptom)?;
        writeln!(out, "  {times} times; the smallest is {}", check.id)?;
    }
    Ok(())
}

fn summary(
    options: &Fuzz,
    seed: u64,
    fuzzed: &Fuzzed,
    took: Duration,
    out: &mut impl Write,
) -> io::Result<()> {
    let found = match fuzzed.findings.len() {
        0 => "nothing found".to_owned(),
        1 => format!("1 kind of failure, kept in {}", options.out.display()),
        count => format!("{count} kinds of failure, kept in {}", options.out.display()),
    };
    let seconds = took.as_secs_f64();
    writeln!(out, "{} probes in {seconds:.1} s, seed {seed}: {found}", fuzzed.asked)
}

fn progress(cases: Option<u64>) -> ProgressBar {
    let template = match cases {
        Some(_) => "{bar:30} {pos}/{len} probes  {per_sec}  {eta} left  {msg}",
        None => "{spinner} {pos} probes  {per_sec}  {elapsed}  {msg}",
    };
    shared::progress(cases, template)
}
