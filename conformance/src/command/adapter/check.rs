//! `actucheck adapter check`.

use std::io::{self, Write};
use std::process::ExitCode;

use actucheck::adapter::Wire;
use actucheck::adapter::lint::{self, Point, Report, Said};
use actucheck::suite::{self, Options};
use anstyle::AnsiColor;

use clap::Args;

use crate::command::shared::{self, Exchange, Failure};

const EXAMPLES: &str = "\
Examples:
  actucheck adapter check -- python3 adapter.py
  actucheck adapter check --start-timeout 60 -- ./run

Exit status: 0 all is well, 1 something is wrong, 2 wrong usage, 4 the adapter could not be started.";

/// Checks an adapter itself, point by point, before its library is checked
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Check {
    #[command(flatten)]
    exchange: Exchange,
    /// The adapter's command with its arguments
    #[arg(last = true, required = true, value_name = "COMMAND")]
    command: Vec<String>,
}

/// How many of the last lines of a conversation are shown.
const SHOWN: usize = 4;
/// How many characters of a line are shown.
const WIDTH: usize = 400;

/// Checks an adapter and prints the results.
pub(crate) fn run(options: &Check) -> Result<ExitCode, Failure> {
    let spec = shared::spec()?;
    let plan = suite::plan(&spec, &Wire::ALL, &Options::new());
    let settings = options.exchange.settings()?;
    let command = options.command.join(" ");
    let report = lint::check(&options.command, &settings, &[plan]).map_err(|error| {
        let message = format!("cannot run `{command}`: {error}; give the command after `--`");
        Failure::not_started(message)
    })?;
    shared::finish(settings.trace)?;
    write(&report, &command, &mut anstream::stdout()).map_err(Failure::incomplete)?;
    Ok(ExitCode::from(match &report.hello {
        Some(_) if report.is_good() => 0,
        Some(_) => Failure::FAILED,
        None => Failure::NOT_STARTED,
    }))
}

fn write(report: &Report, command: &str, out: &mut impl Write) -> io::Result<()> {
    report.points.iter().try_for_each(|point| line(point, out))?;
    let wrong = report.points.iter().filter(|point| point.result.is_err()).count();
    if wrong == 0 {
        let style = AnsiColor::Green.on_default().bold();
        let offers = report.hello.as_ref().is_some_and(|hello| !hello.ops.is_empty());
        let next = if offers {
            "check its library next"
        } else {
            "it offers no op yet; implement one, then run"
        };
        return writeln!(out, "\n{style}well{style:#}  {next}: actucheck codec -- {command}");
    }
    if !report.log.is_empty() {
        writeln!(out, "\nIts standard error ends with:")?;
        report.log.lines().try_for_each(|line| writeln!(out, "  {line}"))?;
    }
    let style = AnsiColor::Red.on_default().bold();
    let rest = if report.ended_early() { "; the remaining points were not checked" } else { "" };
    writeln!(out, "\n{style}WRONG{style:#}  {wrong} of {} points{rest}", report.points.len())
}

/// Prints a point on one line; a problem and how to fix it follow on more lines.
fn line(point: &Point, out: &mut impl Write) -> io::Result<()> {
    let name = &point.name;
    let problem = match &point.result {
        Ok(remark) => {
            let style = AnsiColor::Green.on_default();
            let remark = if remark.is_empty() { String::new() } else { format!(" ({remark})") };
            return writeln!(out, "  {style}ok{style:#}     {name}{remark}");
        }
        Err(problem) => problem,
    };
    let style = AnsiColor::Red.on_default().bold();
    writeln!(out, "  {style}WRONG{style:#}  {name}: {}", problem.what)?;
    for Said { by_adapter, line } in point.said.iter().skip(point.said.len().saturating_sub(SHOWN))
    {
        let dots = if line.chars().count() > WIDTH { "…" } else { "" };
        let line: String = line.chars().take(WIDTH).collect();
        writeln!(out, "         {}  {line}{dots}", if *by_adapter { "got " } else { "sent" })?;
    }
    writeln!(out, "         mend  {}", problem.mend)
}
