//! The report for a person at a terminal.

use std::collections::BTreeMap;
use std::io::{self, Write};

use anstyle::{AnsiColor, Style};

use actucheck_spec::Spec;

use super::{Run, Stopped};
use crate::check::{Check, Demand, Open};
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
    if let Some(stopped) = run.stopped {
        let why = match stopped {
            Stopped::Interrupted => "interrupted",
            Stopped::MaxFail => "as much failed as --max-fail allows",
        };
        writeln!(out, "\n{why}: {} checks were not asked", run.left)?;
    }
    summary(&totals, out)
}

/// Writes one check: what it asks, what it demands, and which sentence of which document that is.
///
/// # Errors
/// If it can't be written.
pub fn check(spec: &Spec, check: &Check, out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "{BOLD}{}{BOLD:#}", check.id)?;
    statement(spec, &check.requirement, out)?;
    writeln!(out, "  {:9} {DIM}{}{DIM:#}", "packet of", spec.place(&check.source))?;
    writeln!(out, "  {:9} {}", "request", request(&check.op))?;
    let (outputs, reject) = match &check.demand {
        Demand::Yield(output) => (std::slice::from_ref(output), None),
        Demand::YieldOneOf(outputs) => (outputs.as_slice(), None),
        Demand::Reject(fault) => (&[][..], Some(format!("a rejection ({fault})"))),
        Demand::Record(open) => return question(open, out),
    };
    for output in outputs {
        writeln!(out, "  {:9} {}", "demanded", shown(output))?;
    }
    reject.map_or(Ok(()), |reject| writeln!(out, "  {:9} {reject}", "demanded"))
}

/// A question that the documents leave open, and the ways that are foreseen.
fn question(open: &Open, out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "  {:9} {}", "recorded", open.question)?;
    for way in &open.ways {
        writeln!(out, "  {:9} {}: {}", "", way.name, shown(&way.output))?;
    }
    writeln!(out, "  {:9} or a rejection", "")
}

/// A requirement in words, and who says so.
fn statement(spec: &Spec, requirement: &str, out: &mut impl Write) -> io::Result<()> {
    let Some(row) = spec.requirement(requirement) else { return Ok(()) };
    writeln!(out, "  {:9} {}", row.level, row.text)?;
    writeln!(out, "  {:9} {DIM}{}{DIM:#}", "says who", spec.place(&row.source))
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
        statement(run.spec, requirement, out)?;
        for outcome in outcomes.iter().take(SHOWN) {
            self::outcome(outcome, out)?;
            replay_line(run, outcome, out)?;
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

/// The command that asks the same again.
fn replay_line(run: &Run<'_>, outcome: &Outcome, out: &mut impl Write) -> io::Result<()> {
    let what = run.record.map_or_else(|| outcome.id.clone(), |path| path.display().to_string());
    write!(out, "  {:9} actucheck replay {what}", "replay")?;
    if let Some(rest) = outcome.id.split_once(".seed-").map(|(_, rest)| rest) {
        let digits = rest.find(|character: char| !character.is_ascii_digit());
        write!(out, " --seed {}", rest.get(..digits.unwrap_or(rest.len())).unwrap_or_default())?;
    }
    if !run.command.is_empty() {
        write!(out, " -- {}", run.command.join(" "))?;
    }
    writeln!(out)
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
