//! What each subcommand does.

pub(crate) mod adapter;
pub(crate) mod codec;
pub(crate) mod completions;
pub(crate) mod decode;
pub(crate) mod fuzz;
pub(crate) mod list;
mod output;
pub(crate) mod replay;
pub(crate) mod report;
pub(crate) mod show;
pub(crate) mod spec;

use std::fmt;
use std::fs::File;
use std::io::BufWriter;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use actucheck::adapter::{Hello, Settings, Timeouts, Trace, Wire};
use actucheck::subject::{Builtin, Process, Subject};
use actucheck::suite;
use actucheck::suite::check::Check;
use actucheck::suite::select::select;
use actucheck_spec::Spec;
use actucheck_spec::model::Level;

use crate::cli::{self, Adapter, Exchange, Growth, Selection};

/// Why a command ends early, and with which exit status.
#[derive(Debug)]
pub(crate) struct Failure {
    /// The exit status.
    pub(crate) status: u8,
    message: String,
}

impl Failure {
    /// The packet is not valid, or a check failed.
    pub(crate) const FAILED: u8 = 1;
    /// The command was not used as it must be.
    pub(crate) const USAGE: u8 = 2;
    /// Something could not be done.
    pub(crate) const INCOMPLETE: u8 = 3;
    /// The adapter could not be started.
    pub(crate) const NOT_STARTED: u8 = 4;

    /// A failure with its exit status and one sentence that tells the user what to do.
    pub(crate) fn new(status: u8, message: impl fmt::Display) -> Self {
        Self { status, message: message.to_string() }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

/// The spec that this program was built with.
fn spec() -> Result<Spec, Failure> {
    Spec::embedded().map_err(|defects| {
        let defects: Vec<_> = defects.iter().map(ToString::to_string).collect();
        Failure::new(Failure::INCOMPLETE, defects.join("\n"))
    })
}

/// Every check of a wire; with the lengths around its limit for an implementation that says one.
fn checks(spec: &Spec, wire: Wire, growth: &Growth, hello: Option<&Hello>) -> Vec<Check> {
    suite::all(spec, &options(wire, growth, hello))
}

/// What decides which checks a wire has.
fn options(wire: Wire, growth: &Growth, hello: Option<&Hello>) -> suite::Options {
    let max_packet = hello.and_then(|hello| hello.limits.max_packet);
    let Growth { seed, cases, body_length } = *growth;
    suite::Options { wire, seed, cases, body_length, max_packet }
}

/// The checks that the user means.
fn selected(checks: Vec<Check>, selection: &Selection) -> Result<Vec<Check>, Failure> {
    let level = match selection.level {
        cli::Level::Must => Level::Must,
        cli::Level::Should => Level::Should,
        cli::Level::May => Level::May,
    };
    select(checks, &selection.select, &selection.skip)
        .map(|checks| checks.into_iter().filter(|check| check.level <= level).collect())
        .map_err(|error| Failure::new(Failure::USAGE, error))
}

/// The check with this id, of whichever wire, and of bodies of any length.
fn named(
    spec: &Spec,
    id: &str,
    growth: &Growth,
    hello: Option<&Hello>,
) -> Result<(Wire, Check), Failure> {
    let all = |growth: Growth| {
        let of = |wire| (wire, checks(spec, wire, &growth, hello));
        Wire::ALL.map(of).into_iter().find_map(|(wire, checks)| {
            let check = checks.into_iter().find(|check| check.id == id)?;
            Some((wire, check))
        })
    };
    let longest = Growth { body_length: suite::Options::LONGEST_BODY, ..*growth };
    all(*growth).or_else(|| all(longest)).ok_or_else(|| {
        let message = format!("no check has the id `{id}`; `actucheck list` has them all");
        Failure::new(Failure::USAGE, message)
    })
}

/// What is to be asked: `jobs` processes of the adapter, or the built-in codec without one.
fn subjects(adapter: &Adapter, jobs: u8) -> Result<Subjects, Failure> {
    subjects_with(adapter, jobs, Settings::default().restarts)
}

/// The same, with another limit to how often each process is started again.
fn subjects_with(adapter: &Adapter, jobs: u8, restarts: u32) -> Result<Subjects, Failure> {
    if adapter.command.is_empty() {
        // clap does not tell `--` with nothing behind it from no `--` at all.
        if std::env::args_os().next_back().is_some_and(|last| last == "--") {
            let message = "no command behind `--`; give the adapter's, such as python3 adapter.py";
            return Err(Failure::new(Failure::USAGE, message));
        }
        let mut subjects = Subjects::of(Builtin::default());
        subjects.all.resize_with(jobs.into(), || Box::new(Builtin::default()));
        return Ok(subjects);
    }
    let settings = settings(&adapter.exchange)?;
    let start = |number| {
        Process::start(&adapter.command, Settings { restarts, number, ..settings.clone() })
            .map_err(|error| Failure::new(Failure::NOT_STARTED, error))
    };
    let mut subjects = Subjects::of(start(1)?);
    for number in 2..=u32::from(jobs) {
        subjects.all.push(Box::new(start(number)?));
    }
    Ok(Subjects { trace: settings.trace, ..subjects })
}

/// How an adapter is run, the first of its kind.
fn settings(exchange: &Exchange) -> Result<Settings, Failure> {
    let timeouts = Timeouts { start: exchange.start_timeout, request: exchange.timeout };
    let trace = exchange.trace.as_deref().map(open_trace).transpose()?;
    Ok(Settings { timeouts, trace, ..Settings::default() })
}

/// A flag that Ctrl-C sets.
fn interrupted() -> Result<Arc<AtomicBool>, Failure> {
    let flag = Arc::new(AtomicBool::new(false));
    let setter = Arc::clone(&flag);
    ctrlc::set_handler(move || setter.store(true, Ordering::Relaxed)).map_err(|error| {
        Failure::new(Failure::INCOMPLETE, format!("cannot listen for Ctrl-C: {error}"))
    })?;
    Ok(flag)
}

/// One implementation, once or several times.
struct Subjects {
    /// What it says of itself.
    hello: Hello,
    all: Vec<Box<dyn Subject + Send>>,
    trace: Option<Trace>,
}

impl Subjects {
    fn of(subject: impl Subject + Send + 'static) -> Self {
        Self { hello: subject.hello().clone(), all: vec![Box::new(subject)], trace: None }
    }

    /// Ends it; the last lines that it logged.
    fn end(self) -> Result<String, Failure> {
        let logs = self.all.iter().map(|subject| subject.log());
        let log = logs.filter(|log| !log.is_empty()).collect::<Vec<_>>().join("\n");
        drop(self.all);
        if let Some(trace) = self.trace {
            trace.finish().map_err(|error| {
                Failure::new(Failure::INCOMPLETE, format!("cannot write the trace: {error}"))
            })?;
        }
        Ok(log)
    }
}

fn open_trace(path: &Path) -> Result<Trace, Failure> {
    let file = File::create(path).map_err(|error| {
        Failure::new(Failure::USAGE, format!("cannot write {}: {error}", path.display()))
    })?;
    Ok(Trace::new(Box::new(BufWriter::new(file))))
}
