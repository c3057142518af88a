//! `actucheck adapter check`.

use std::io::{self, Write};
use std::process::ExitCode;
use std::sync::atomic::Ordering;

use actucheck::adapter::Wire;
use actucheck::adapter::lint::{self, Point, Report, Said};
use actucheck::legible::{LONGEST_TEXT, legible};
use actucheck::suite::{self, Options};
use anstyle::AnsiColor;

use clap::Args;

use crate::command::ENDED;
use crate::command::shared::{self, Exchange, Failure};

const EXAMPLES: &str = "\
Examples:
  actucheck adapter check -- python3 adapter.py
  actucheck adapter check --verbose -- ./my-adapter
      with every line exchanged
  actucheck adapter check --start-timeout 60 -- ./run

Exit status: 0 all is well, 1 something is wrong, 2 wrong usage, 3 it was interrupted, or the
results could not be written, 4 the adapter could not be started";

/// Checks an adapter itself, point by point, before its library is checked
#[derive(Debug, Args)]
#[command(after_help = format!("{EXAMPLES}, {ENDED}"))]
pub(crate) struct Check {
    #[command(flatten)]
    exchange: Exchange,
    /// Print every line exchanged, not only the last few before a problem
    #[arg(short, long)]
    verbose: bool,
    /// The adapter's command with its arguments
    #[arg(last = true, required = true, value_name = "COMMAND")]
    command: Vec<String>,
}

/// How many of the last lines before a problem are shown.
const SHOWN: usize = 4;
/// How many characters of a line are shown.
const WIDTH: usize = 400;

/// Checks an adapter and prints the results.
pub(crate) fn run(options: &Check) -> Result<ExitCode, Failure> {
    let spec = shared::spec()?;
    let hosts = suite::host_plan(&spec, &Wire::ALL);
    let plan = suite::plan(&spec, &Wire::ALL, &Options::new()).and(hosts);
    let interrupted = shared::interrupted()?;
    let settings = options.exchange.settings(&interrupted)?;
    let command = options.command.join(" ");
    let report = lint::check(&options.command, &settings, &[plan]).map_err(|error| {
        let message = format!("cannot run `{command}`: {error}; give the command after `--`");
        Failure::not_started(message)
    })?;
    shared::finish(settings.trace)?;
    if interrupted.load(Ordering::Relaxed) && !report.is_good() {
        return Err(Failure::incomplete("interrupted; the adapter was not checked to its end"));
    }
    let written = write(&report, &command, options.verbose, &mut anstream::stdout());
    shared::printed(written)?;
    Ok(ExitCode::from(match &report.hello {
        Some(_) if report.is_good() => 0,
        Some(_) => Failure::FAILED,
        None => Failure::NOT_STARTED,
    }))
}

fn write(report: &Report, command: &str, verbose: bool, out: &mut impl Write) -> io::Result<()> {
    report.points.iter().try_for_each(|point| line(point, verbose, out))?;
    let wrong = report.points.iter().filter(|point| point.result.is_err()).count();
    if wrong == 0 {
        let style = AnsiColor::Green.on_default().bold();
        let offers = report.hello.as_ref().is_some_and(|hello| !hello.ops.is_empty());
        let next = if offers {
            "check its library next"
        } else {
            "it offers no op yet; implement one, then run"
        };
        let is_host_only = report.hello.as_ref().is_some_and(|hello| {
            hello
                .ops
                .iter()
                .all(|op| ["open", "call", "exchange", "close", "hello", "bye"].contains(&&**op))
        });
        let what = if offers && is_host_only { "host" } else { "codec" };
        return writeln!(out, "\n{style}well{style:#}  {next}: actucheck {what} -- {command}");
    }
    if !report.log.is_empty() {
        writeln!(out, "\nIts standard error ends with:")?;
        report.log.lines().try_for_each(|line| writeln!(out, "  {}", legible(line, WIDTH)))?;
    }
    let style = AnsiColor::Red.on_default().bold();
    let rest = if report.ended_early() { "; the remaining points were not checked" } else { "" };
    writeln!(out, "\n{style}WRONG{style:#}  {wrong} of {} points{rest}", report.points.len())
}

/// Prints a point on one line. The exchanged lines, and how to fix a problem, follow on more lines.
fn line(point: &Point, verbose: bool, out: &mut impl Write) -> io::Result<()> {
    let name = &point.name;
    match &point.result {
        Ok(remark) => {
            let style = AnsiColor::Green.on_default();
            let remark = legible(remark, LONGEST_TEXT);
            let remark = if remark.is_empty() { remark } else { format!(" ({remark})") };
            writeln!(out, "  {style}ok{style:#}     {name}{remark}")?;
        }
        Err(problem) => {
            let style = AnsiColor::Red.on_default().bold();
            writeln!(
                out,
                "  {style}WRONG{style:#}  {name}: {}",
                legible(&problem.what, LONGEST_TEXT)
            )?;
        }
    }
    let left_out = match (verbose, &point.result) {
        (true, _) => 0,
        (false, Ok(_)) => point.said.len(),
        (false, Err(_)) => point.said.len().saturating_sub(SHOWN),
    };
    if left_out > 0 && point.result.is_err() {
        writeln!(out, "         {left_out} lines before these; --verbose prints them")?;
    }
    for Said { by_adapter, line } in point.said.iter().skip(left_out) {
        let who = if *by_adapter { "got " } else { "sent" };
        writeln!(out, "         {who}  {}", legible(line, WIDTH))?;
    }
    match &point.result {
        Ok(_) => Ok(()),
        Err(problem) => writeln!(out, "         mend  {}", problem.mend),
    }
}
