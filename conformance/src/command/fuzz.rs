//! `actucheck fuzz`.

#[cfg(unix)]
mod on_port;

use std::hash::{BuildHasher, RandomState};
use std::io::{self, Write};
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use actucheck::adapter::{Hello, Permissions, Wire};
use actucheck::blackbox::{self, Asks, Finding, Fuzzed, fuzz};
use actucheck::legible::{LONGEST_TEXT, legible};
use actucheck::report::screen::{self, Detail};
use actucheck::report::{Collector, End, Report, Run};
use actucheck::suite::device::Target;
use actucheck::suite::partition::Partition;
use actucheck::suite::{Options, saved};
use actucheck_spec::Spec;
use clap::Args;
use clap::builder::ArgPredicate;
use indicatif::ProgressBar;

use super::ENDED;
#[cfg(unix)]
use super::device::writing::end;
use super::shared::{self, Adapter, Failure, Look, Subjects, duration, wire};

const EXAMPLES: &str = "\
Examples:
  actucheck fuzz -- python3 my_adapter.py
      for a minute, from another seed each time
  actucheck fuzz --seed 7 --cases 100000 -- ./my-adapter
      the same again, whatever the machine
  actucheck fuzz --time 10m --jobs 4 -- ./my-adapter
      four processes of the adapter side by side
  actucheck fuzz --seed 7 --cases 100000 --partition 2/4 -- ./my-adapter
      a quarter of that, as one of four machines
  actucheck fuzz --host -- python3 my_adapter.py
      conversations of a library that opens a port, on a line with faults
  actucheck fuzz --device /dev/ttyUSB0 --time 5m
      requests to the device with ID 1 on a serial port, which only read
  actucheck fuzz --device --seed 7 --cases 300 -- actucheck bus ja40@1 --stdio
      a virtual device, to see what it looks like; firmware that was compiled for this machine goes the same way
  actucheck fuzz --wire innfos --device udp://192.168.1.30:2000 --id 6
      the actuator with the address 6 behind its board
  actucheck replay findings.yaml -- ./my-adapter
      what was found, asked again
  actucheck device /dev/ttyUSB0 --replay findings.yaml
      the same of a device

A seed and a number of probes ask the same each time, for any number of processes. What is found \
is then the same too, unless answers depend on time or on earlier questions. A failure that does \
not come again on a fresh process is told, with the questions before it that bring it about, if \
they are found.

With --host a probe is a conversation, as of `actucheck host`: up to six calls, each with answers that \
are right, or damaged, late, doubled, missing, or of others. Each call is judged: what it returns by \
the packets that the reference model finds in what came, and what it sends. What the documents leave \
unspecified is not judged. What is found is shrunk to the shortest conversation; what does not come again \
is told, but is no failure: a machine may be too busy for a host that does not wait long.

With --device a probe is a conversation of one to six requests to a device: Ping, Read of any registers or \
addresses, undefined instructions, packets to others, damaged packets, and noise; with --wire innfos each command \
that reads, the board's handshake and query, and damaged datagrams. With --allow write-ram registers of the RAM area \
that do nothing by themselves, or an actuator's values, are written too, by every instruction that writes them, while \
torque is off; the device holds afterwards what it held before, as after `actucheck device`. Nothing else is sent that could be \
taken for an instruction that changes something. What must come back is what the documents say, and of stored \
registers and values that they stay as they are; what the documents leave unspecified is not judged.

What an adapter skips five times without another answer is not asked any more; the summary says \
what that was.

Exit status: 0 no failure found (a recommendation may be broken), 1 a failure found, 2 wrong usage, \
3 the adapter failed too often or skips everything, or what was found could not be written, 4 the adapter \
could not be started";

/// Looks for failures that no check foresees, and shrinks them
#[derive(Debug, Args)]
#[command(after_help = format!("{EXAMPLES}, {ENDED}"))]
#[command(mut_arg("timeout", |arg| arg.default_value_if("host", ArgPredicate::IsPresent, "3").help(
    "Seconds that the adapter may take for a request [default: 1, with --host 3]"
).hide_default_value(true)))]
pub(crate) struct Fuzz {
    /// The wire whose packets are generated
    #[arg(long, value_parser = wire(), default_value_t)]
    wire: Wire,
    /// Fuzz a host that opens a port, with conversations on a line with faults
    #[arg(long)]
    host: bool,
    #[cfg(unix)]
    #[command(flatten)]
    on_port: on_port::OnPort,
    /// How long to fuzz, as in 90s, 10m or 1h; one minute if neither this nor --cases is given
    #[arg(long, value_name = "TIME", value_parser = duration, conflicts_with = "cases")]
    time: Option<Duration>,
    /// How many probes are asked
    #[arg(long, value_name = "N")]
    cases: Option<u64>,
    /// The seed of the probes; another one each time if it is not given
    #[arg(long, value_name = "N")]
    seed: Option<u64>,
    /// Ask only the part K of N of the probes of a seed, so that N machines share them
    #[arg(long, value_name = "K/N", requires = "seed")]
    partition: Option<Partition>,
    /// How many processes of the adapter run side by side
    #[arg(long, value_name = "N", default_value = "1", value_parser = clap::value_parser!(u8).range(1..))]
    jobs: u8,
    /// Where to write what was found
    #[arg(long, value_name = "FILE", default_value = "findings.yaml")]
    out: PathBuf,
    #[command(flatten)]
    look: Look,
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
    shared::Target::all_differ(options.adapter.trace().into_iter().chain([options.out.as_path()]))?;
    let out = shared::Target::new(&options.out)?;
    let interrupted = shared::interrupted()?;
    let Begun { mut subjects, device, end } = options.begin(&spec, &interrupted)?;
    let hello = subjects.hello.clone();
    if !hello.wires.iter().any(|id| id == options.wire.id()) {
        return Err(shared::not_offered(options.wire, &hello));
    }
    if options.host {
        has_port(&hello, options.wire)?;
    }
    let asks = match &device {
        Some((target, allowed)) => Asks::Device(target, allowed),
        None if options.host => Asks::Host,
        None => Asks::Codec,
    };
    let seed = options.seed.unwrap_or_else(|| RandomState::new().hash_one(()));
    let cases = options.cases.unwrap_or(u64::MAX);
    let time = options.time.or_else(|| options.cases.is_none().then_some(MINUTE));

    let (started, date) = (Instant::now(), shared::date());
    let progress = progress(options);
    let part = options.partition;
    let probes = blackbox::Options { wire: options.wire, seed, cases, asks, part };
    let fuzzed = fuzz(&spec, &probes, &mut subjects.all, &|asked, found| {
        progress.set_position(asked);
        progress.set_message(format!("{found} kinds of finding"));
        let over = time.is_some_and(|time| started.elapsed() >= time);
        if over || interrupted.load(Ordering::Relaxed) {
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    });
    progress.finish_and_clear();
    // What cannot be written is told after the findings.
    let (log, traced) = subjects.end();
    let restored = end();
    let kept = keep(out, &fuzzed.findings);
    let took = started.elapsed();
    let found = fuzzed.findings.iter();
    let again = options.again();
    let run = Run {
        spec: &spec,
        date,
        command_line: shared::command_line(),
        implementation: &hello.implementation,
        wires: &[options.wire],
        options: Options { seed, ..Options::new() },
        part: None,
        port: options.adapter.port(),
        command: &options.adapter.command,
        again: &again,
        records: found
            .clone()
            .flat_map(Finding::checks)
            .map(|check| (check.id.clone(), options.out.clone()))
            .collect(),
    };
    let mut collector = Collector::new(&run);
    collector.extend(found.map(|finding| finding.outcome.clone()));
    let report = collector.finish(End { seconds: took.as_secs_f64(), ..End::default() });
    let mut out = anstream::stdout();
    let written = show(&report, &fuzzed, options.look, &mut out)
        .and_then(|()| summary(options, seed, &fuzzed, kept.is_ok(), took, &mut out));
    let written = shared::printed(written);
    [kept, traced, restored].into_iter().fold(written, shared::both)?;
    if let Some(reason) = &fuzzed.given_up {
        let last = log.lines().last().map(|line| format!("; it said `{line}`")).unwrap_or_default();
        return Err(Failure::incomplete(legible(&format!("{reason}{last}"), LONGEST_TEXT)));
    }
    let failed = |finding: &Finding| finding.outcome.verdict.is_failure();
    // A host that does not wait long fails by chance on a busy machine.
    let passing = fuzzed.passing.iter().filter(|finding| !finding.kind.is_of_host());
    let found = fuzzed.findings.iter().chain(passing).any(failed);
    Ok(ExitCode::from(u8::from(found)))
}

/// Whether conversations can be asked.
fn has_port(hello: &Hello, wire: Wire) -> Result<(), Failure> {
    if !hello.is_host() {
        return Err(shared::no_host());
    }
    if blackbox::has_conversations(wire) {
        return Ok(());
    }
    Err(Failure::usage(format!(
        "there are no conversations of hosts on {wire} yet; leave out --host"
    )))
}

/// Writes the smallest case of each kind of failure to a file that `replay` and `codec` take.
fn keep(out: shared::Target, findings: &[Finding]) -> Result<(), Failure> {
    if findings.is_empty() {
        return Ok(());
    }
    let checks: Vec<_> = findings.iter().flat_map(Finding::checks).cloned().collect();
    out.write(saved::write(&checks).map_err(Failure::incomplete)?.as_bytes())
}

/// How many kinds of finding are told on a screen.
const KINDS: usize = 4;

/// Prints the report on the smallest case of each kind of failure, then what is known of each kind.
fn show(report: &Report, fuzzed: &Fuzzed, look: Look, out: &mut impl Write) -> io::Result<()> {
    let most = match look.detail() {
        Detail::Least => return Ok(()),
        Detail::Screen => KINDS,
        Detail::Most => usize::MAX,
    };
    if !fuzzed.findings.is_empty() {
        screen::write(report, &look.terminal(None), out)?;
        writeln!(out)?;
    }
    for Finding { kind, check, before, times, .. } in fuzzed.findings.iter().take(most) {
        writeln!(out, "{} {}: {}", kind.op, kind.requirement, kind.symptom)?;
        writeln!(out, "  {times} times; the smallest is {}", check.id)?;
        if !before.is_empty() {
            let before: Vec<_> = before.iter().map(|check| check.id.as_str()).collect();
            let before = before.join(", ");
            writeln!(out, "  it depends on what came before: it needs {before} first")?;
        }
    }
    for Finding { kind, check, times, outcome, .. } in fuzzed.passing.iter().take(most) {
        writeln!(out, "{} {}: {}", kind.op, kind.requirement, kind.symptom)?;
        let detail = legible(&outcome.detail, LONGEST_TEXT);
        writeln!(out, "  {times} times, the first at {}: {detail}", check.id)?;
        writeln!(
            out,
            "  it did not come again on a fresh process, as far as there was time to ask; it may \
             depend on what came before, or on chance; it is not kept"
        )?;
    }
    let left = |findings: &[Finding]| findings.len().saturating_sub(most);
    match left(&fuzzed.findings) + left(&fuzzed.passing) {
        0 => Ok(()),
        more => writeln!(out, "… and {more} more; -v prints them"),
    }
}

fn summary(
    options: &Fuzz,
    seed: u64,
    fuzzed: &Fuzzed,
    is_kept: bool,
    took: Duration,
    out: &mut impl Write,
) -> io::Result<()> {
    let quiet = options.look.detail() == Detail::Least;
    for (reason, topics) in fuzzed.not_asked.iter().filter(|_| !quiet) {
        let topics: Vec<_> = topics.iter().map(ToString::to_string).collect();
        writeln!(out, "not asked, {reason}: {}", topics.join(", "))?;
    }
    let kinds = |count: usize, what: &str| match count {
        1 => format!("1 kind of finding{what}"),
        count => format!("{count} kinds of finding{what}"),
    };
    let place = is_kept.then(|| format!(", kept in {}", options.out.display()));
    let kept = kinds(fuzzed.findings.len(), &place.unwrap_or_default());
    let passing = kinds(fuzzed.passing.len(), " that did not come again");
    let found = match (fuzzed.findings.is_empty(), fuzzed.passing.is_empty()) {
        (true, true) => "nothing found".to_owned(),
        (false, true) => kept,
        (true, false) => passing,
        (false, false) => format!("{kept}, and {passing}"),
    };
    let seconds = took.as_secs_f64();
    let asked = options.asked();
    let part = options.partition.map(|part| format!(", {part}")).unwrap_or_default();
    writeln!(out, "{} {asked} in {seconds:.1} s, seed {seed}{part}: {found}", fuzzed.asked)
}

/// Who is asked.
struct Begun<'s> {
    subjects: Subjects,
    /// The device if it is one, and what may be done to it.
    device: Option<(Target<'s>, Permissions)>,
    /// Sets the device back if it was written to.
    end: Box<dyn Fn() -> Result<(), Failure>>,
}

impl From<Subjects> for Begun<'_> {
    fn from(subjects: Subjects) -> Self {
        Self { subjects, device: None, end: Box::new(|| Ok(())) }
    }
}

impl Fuzz {
    /// Who is asked, and the device if it is one.
    #[cfg(unix)]
    fn begin<'s>(
        &self,
        spec: &'s Spec,
        interrupted: &Arc<AtomicBool>,
    ) -> Result<Begun<'s>, Failure> {
        if self.on_port.is_chosen() {
            let command = &self.adapter.command;
            let (device, target, allowed) =
                self.on_port.begin(self.wire, command, spec, interrupted)?;
            return Ok(Begun {
                subjects: Subjects::of(device.clone()),
                device: Some((target, allowed)),
                end: Box::new(move || end(&device)),
            });
        }
        Ok(self.start(interrupted)?.into())
    }

    /// Who is asked. There are no ports on this system.
    #[cfg(not(unix))]
    fn begin<'s>(
        &self,
        _spec: &'s Spec,
        interrupted: &Arc<AtomicBool>,
    ) -> Result<Begun<'s>, Failure> {
        Ok(self.start(interrupted)?.into())
    }

    fn start(&self, interrupted: &Arc<AtomicBool>) -> Result<Subjects, Failure> {
        Subjects::start_with(&self.adapter, self.jobs, Some(RESTARTS), interrupted)
    }

    /// The words that ask again what was found; none if `actucheck replay` does.
    #[cfg(unix)]
    fn again(&self) -> Vec<String> {
        if self.on_port.is_chosen() { self.on_port.again(self.wire, &self.out) } else { Vec::new() }
    }

    /// The words that ask again what was found; none, as `actucheck replay` does.
    #[cfg(not(unix))]
    fn again(&self) -> Vec<String> {
        Vec::new()
    }

    /// What its probes are.
    fn asked(&self) -> &'static str {
        #[cfg(unix)]
        let is_conversation = self.host || self.on_port.is_chosen();
        #[cfg(not(unix))]
        let is_conversation = self.host;
        if is_conversation { "conversations" } else { "probes" }
    }
}

fn progress(options: &Fuzz) -> ProgressBar {
    let asked = options.asked();
    let template = match options.cases {
        Some(_) => {
            format!("{{bar:30}} {{pos}}/{{len}} {asked}  {{per_sec}}  {{eta}} left  {{msg}}")
        }
        None => format!("{{spinner}} {{pos}} {asked}  {{per_sec}}  {{elapsed}}  {{msg}}"),
    };
    shared::progress(options.cases, &template)
}
