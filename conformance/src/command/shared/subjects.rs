//! The subject that is judged: the built-in codec, or a library behind an adapter.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use actucheck::adapter::{Hello, HostPort, Settings, Timeouts, Trace, lint};
use actucheck::subject::{Builtin, Process, Subject};
use actucheck::suite::plan::Plan;
use actucheck::traffic::Traffic;
use clap::Args;

use super::value::{one_of, seconds};
use super::{Failure, Target};

/// An adapter, or none.
#[derive(Debug, Args)]
pub(crate) struct Adapter {
    #[command(flatten)]
    exchange: Exchange,
    /// The adapter's command with its arguments; without one the built-in codec is judged
    #[arg(last = true, value_name = "COMMAND")]
    pub(crate) command: Vec<String>,
}

/// How requests and replies are exchanged with an adapter.
#[derive(Debug, Args)]
pub(crate) struct Exchange {
    /// Seconds that the adapter may take for a request
    #[arg(long, value_name = "SECONDS", default_value = "1", value_parser = seconds)]
    timeout: Duration,
    /// Seconds that the adapter may take to start
    #[arg(long, value_name = "SECONDS", default_value = "10", value_parser = seconds)]
    start_timeout: Duration,
    /// Write every line exchanged with the adapter to this file
    #[arg(long, value_name = "FILE")]
    trace: Option<PathBuf>,
    /// The port that a host opens where packets are no datagrams [default: one in memory if the adapter has
    /// it, or else pty]
    #[arg(long, value_name = "KIND", value_parser = one_of(PORTS))]
    port: Option<HostPort>,
}

const PORTS: [(HostPort, &str, &str); 2] = [
    (HostPort::Pty, "pty", "The end of a pseudo-terminal"),
    (HostPort::Tcp, "tcp", "A TCP port of this machine, tcp://127.0.0.1:PORT"),
];

impl Adapter {
    /// The port that hosts get, if it is chosen.
    pub(crate) const fn port(&self) -> Option<HostPort> {
        self.exchange.port
    }

    /// The options that verdicts may depend on, each with its value.
    pub(crate) fn settings(&self) -> Vec<String> {
        let Exchange { timeout, start_timeout, port, .. } = &self.exchange;
        let limits = [("timeout", timeout), ("start-timeout", start_timeout)];
        let limits = limits.map(|(name, time)| format!("--{name} {}", time.as_secs_f64()));
        let port = port.map(|port| format!("--port {port}"));
        limits.into_iter().chain(port).collect()
    }

    /// The file that the exchange is written to, if it is.
    pub(crate) fn trace(&self) -> Option<&Path> {
        self.exchange.trace.as_deref()
    }
}

impl Exchange {
    /// How to run the adapter, until it is `interrupted`. Creates the trace file.
    pub(crate) fn settings(&self, interrupted: &Arc<AtomicBool>) -> Result<Settings, Failure> {
        let timeouts = Timeouts { start: self.start_timeout, request: self.timeout };
        let trace = self.trace.as_deref().map(open_trace).transpose()?;
        let interrupted = Arc::clone(interrupted);
        Ok(Settings { timeouts, trace, port: self.port, interrupted, ..Settings::default() })
    }
}

/// One subject, in one or several processes.
pub(crate) struct Subjects {
    /// Its answer to `hello`.
    pub(crate) hello: Hello,
    pub(crate) all: Vec<Box<dyn Subject + Send>>,
    trace: Option<Trace>,
}

impl Subjects {
    /// Starts `jobs` processes of the adapter, or the built-in codec without one. They are not awaited
    /// any more when `interrupted` is set.
    pub(crate) fn start(
        adapter: &Adapter,
        jobs: u8,
        interrupted: &Arc<AtomicBool>,
    ) -> Result<Self, Failure> {
        Self::start_with(adapter, jobs, None, interrupted)
    }

    /// The same, with a limit of restarts per process.
    pub(crate) fn start_with(
        adapter: &Adapter,
        jobs: u8,
        restarts: Option<u32>,
        interrupted: &Arc<AtomicBool>,
    ) -> Result<Self, Failure> {
        if adapter.command.is_empty() {
            // clap does not distinguish `--` with nothing after it from a missing `--`.
            if std::env::args_os().next_back().is_some_and(|last| last == "--") {
                return Err(Failure::usage(
                    "no command after `--`; give the adapter's, such as python3 adapter.py",
                ));
            }
            if adapter.exchange.trace.is_some() {
                return Err(Failure::usage("--trace needs an adapter; put its command after `--`"));
            }
            let mut subjects = Self::of(Builtin::default());
            subjects.all.resize_with(jobs.into(), || Box::new(Builtin::default()));
            return Ok(subjects);
        }
        let settings = adapter.exchange.settings(interrupted)?;
        let start = |number| {
            Process::start(&adapter.command, Settings { restarts, number, ..settings.clone() })
                .map_err(Failure::not_started)
        };
        let first = start(1)?;
        for contradiction in first.contradictions() {
            anstream::eprintln!("actucheck: the adapter says in hello: {contradiction}");
        }
        let mut subjects = Self::of(first);
        for number in 2..=u32::from(jobs) {
            subjects.all.push(Box::new(start(number)?));
        }
        Ok(Self { trace: settings.trace, ..subjects })
    }

    /// One subject without an adapter.
    pub(crate) fn of(subject: impl Subject + Send + 'static) -> Self {
        Self { hello: subject.hello().clone(), all: vec![Box::new(subject)], trace: None }
    }

    /// What passed on the line of a device so far.
    pub(crate) fn traffic(&self) -> Option<Traffic> {
        self.all.first().and_then(|subject| subject.traffic())
    }

    /// Says which question of the other role the adapter answers, if it plays one role only.
    pub(crate) fn say_other_role(&mut self, plan: &Plan<'_>) {
        let first = self.all.first_mut();
        if let Some(said) = first.and_then(|first| lint::other_role(first.as_mut(), plan)) {
            anstream::eprintln!("actucheck: {said}");
        }
    }

    /// Ends the processes. Returns the last lines that they logged, and whether the trace was written.
    pub(crate) fn end(self) -> (String, Result<(), Failure>) {
        let logs = self.all.iter().map(|subject| subject.log());
        let log = logs.filter(|log| !log.is_empty()).collect::<Vec<_>>().join("\n");
        drop(self.all);
        (log, finish(self.trace))
    }
}

/// Writes the rest of the trace.
pub(crate) fn finish(trace: Option<Trace>) -> Result<(), Failure> {
    let Some(trace) = trace else { return Ok(()) };
    trace.finish().map_err(|error| Failure::incomplete(format!("cannot write the trace: {error}")))
}

/// Unlike a report it is not written beside and renamed: if the program is killed, its lines say why.
fn open_trace(path: &Path) -> Result<Trace, Failure> {
    let file = Target::new(path)?.begin_record();
    let file =
        file.map_err(|error| Failure::usage(format!("cannot write {}: {error}", path.display())))?;
    Ok(Trace::new(Box::new(file)))
}
