//! The report for a person at a terminal.

use std::collections::BTreeMap;
use std::io::{self, Write};

use anstyle::{AnsiColor, Style};

use super::Run;
use crate::explain::diff;
use crate::protocol::{Op, Output};
use crate::verdict::{Outcome, Totals, Verdict};

/// How many outcomes of one requirement are shown whole; the rest are counted.
const SHOWN: usize = 5;

const BOLD: Style = Style::new().bold();
const DIM: Style = Style::new().dimmed();

/// Writes the report with ANSI colours, which the writer may take out.
///
/// # Errors
/// If it can't be written.
pub fn write(run: &Run<'_>, out: &mut impl Write) -> io::Result<()> {
    let totals = run.totals();
    let who = run.implementation;
    writeln!(
        out,
        "{BOLD}{} {}{BOLD:#} ({})  wire {}  {} checks",
        who.name,
        who.version,
        who.language,
        run.wire.id(),
        totals.sum()
    )?;
    requirements(run, out)?;
    for verdict in [
        Verdict::ExpectedFailure,
        Verdict::Warn,
        Verdict::Fail,
        Verdict::UnexpectedPass,
        Verdict::Timeout,
        Verdict::Crash,
        Verdict::AdapterFault,
    ] {
        outcomes(run, verdict, out)?;
    }
    log(run, &totals, out)?;
    summary(&totals, out)
}

/// A line a requirement: how its checks came out.
fn requirements(run: &Run<'_>, out: &mut impl Write) -> io::Result<()> {
    let width = run.outcomes.iter().map(|outcome| outcome.requirement.len()).max().unwrap_or(0);
    for (requirement, outcomes) in by_requirement(run.outcomes) {
        let totals = Totals::of(outcomes);
        let counts = counts(&totals);
        writeln!(out, "  {requirement:width$}  {counts}")?;
    }
    Ok(())
}

/// All outcomes with this verdict, grouped by requirement.
fn outcomes(run: &Run<'_>, verdict: Verdict, out: &mut impl Write) -> io::Result<()> {
    let with_verdict = run.outcomes.iter().filter(|outcome| outcome.verdict == verdict);
    let style = style(verdict);
    for (requirement, outcomes) in by_requirement(with_verdict) {
        let word = verdict.to_string().to_uppercase().replace('-', " ");
        writeln!(out)?;
        writeln!(out, "{style}{word}{style:#} {BOLD}{requirement}{BOLD:#}")?;
        if let Some(row) = run.spec.requirement(requirement) {
            writeln!(out, "  {:9} {}", row.level, row.text)?;
            writeln!(out, "  {:9} {DIM}{}{DIM:#}", "says who", run.spec.place(&row.source))?;
        }
        for outcome in outcomes.iter().take(SHOWN) {
            self::outcome(outcome, out)?;
        }
        if let Some(more @ 1..) = outcomes.len().checked_sub(SHOWN) {
            writeln!(out, "  … and {more} more; --report json=FILE has them all:")?;
            for outcome in outcomes.iter().skip(SHOWN) {
                writeln!(out, "            {}", outcome.id)?;
            }
        }
    }
    Ok(())
}

fn outcome(outcome: &Outcome, out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "  {:9} {BOLD}{}{BOLD:#}", "check", outcome.id)?;
    if let Some(op) = &outcome.request {
        writeln!(out, "  {:9} {}", "request", request(op))?;
    }
    if let Some((expected, actual)) = outcome.bytes() {
        let diff = diff::bytes(expected, actual);
        writeln!(out, "  {:9} {}", "expected", diff.expected)?;
        writeln!(out, "  {:9} {}", "got", diff.actual)?;
        if let (Some(at), Some(Op::Encode { .. })) = (diff.first, &outcome.request) {
            let part = diff::part_of_frame(expected, at);
            writeln!(out, "  {:9} byte {at}, in the {part}", "differs")?;
        }
    } else {
        for (label, output) in [("expected", &outcome.expected), ("got", &outcome.actual)] {
            if let Some(output) = output {
                writeln!(out, "  {label:9} {}", shown(output))?;
            }
        }
    }
    writeln!(out, "  {:9} {}", "because", outcome.detail)
}

fn request(op: &Op) -> String {
    // Every op can be written as JSON: it has string keys only.
    serde_json::to_string(op).unwrap_or_default()
}

fn shown(output: &Output) -> String {
    match output {
        Output::Crc(crc) => format!("{crc:#06X}"),
        Output::Bytes(bytes) => bytes.to_string(),
        Output::Packet(packet) => serde_json::to_string(packet).unwrap_or_default(),
        Output::Packets(packets) => serde_json::to_string(packets).unwrap_or_default(),
    }
}

/// What the adapter logged, where something went wrong with the adapter itself.
fn log(run: &Run<'_>, totals: &Totals, out: &mut impl Write) -> io::Result<()> {
    let broke = [Verdict::Timeout, Verdict::Crash, Verdict::AdapterFault, Verdict::NotRun];
    if run.log.is_empty() || broke.iter().all(|verdict| totals.count(*verdict) == 0) {
        return Ok(());
    }
    writeln!(out, "\nThe adapter's standard error ends with:")?;
    for line in run.log.lines() {
        writeln!(out, "  {line}")?;
    }
    Ok(())
}

fn summary(totals: &Totals, out: &mut impl Write) -> io::Result<()> {
    let (word, color) = match totals.exit_status() {
        0 => ("passed", AnsiColor::Green),
        1 => ("FAILED", AnsiColor::Red),
        _ => ("incomplete", AnsiColor::Yellow),
    };
    let style = color.on_default().bold();
    writeln!(out, "\n{style}{word}{style:#}  {}", counts(totals))
}

/// `12 pass  3 fail`, without the verdicts that did not come out.
fn counts(totals: &Totals) -> String {
    let counts: Vec<_> = Verdict::ALL
        .iter()
        .filter(|verdict| totals.count(**verdict) > 0)
        .map(|verdict| {
            let style = style(*verdict);
            format!("{style}{} {verdict}{style:#}", totals.count(*verdict))
        })
        .collect();
    counts.join("  ")
}

const fn style(verdict: Verdict) -> Style {
    match verdict {
        Verdict::Pass => AnsiColor::Green.on_default(),
        Verdict::Fail | Verdict::UnexpectedPass => AnsiColor::Red.on_default().bold(),
        Verdict::Skip => DIM,
        _ => AnsiColor::Yellow.on_default(),
    }
}

/// Outcomes by requirement, in the order of the requirements' ids.
fn by_requirement<'a>(
    outcomes: impl IntoIterator<Item = &'a Outcome>,
) -> BTreeMap<&'a str, Vec<&'a Outcome>> {
    let mut groups: BTreeMap<&str, Vec<&Outcome>> = BTreeMap::new();
    for outcome in outcomes {
        groups.entry(&outcome.requirement).or_default().push(outcome);
    }
    groups
}
