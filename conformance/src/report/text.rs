//! The report for a person at a terminal.

use std::io::{self, Write};

use actucheck_spec::Spec;
use actucheck_spec::model::Level;
use anstyle::{AnsiColor, Style};

use super::model::{CheckResult, Report, Statement};
use super::view::Group;
use super::words;
use crate::suite::check::{Check, Demand, Unspecified};
use crate::verdict::{Totals, Verdict};

/// How many checks of a group are shown with their evidence, and how many more by their ids.
const WHOLE: usize = 5;
const NAMED: usize = 20;

pub(super) const BOLD: Style = Style::new().bold();
pub(super) const DIM: Style = Style::new().dimmed();

/// Writes the report with ANSI colours, which the writer may take out.
///
/// # Errors
/// If it can't be written.
pub fn write(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    let who = &report.implementation;
    writeln!(
        out,
        "{BOLD}{} {}{BOLD:#} ({})  wire {}  {} checks",
        who.name,
        who.version,
        who.language,
        report.wire.id(),
        report.totals.sum()
    )?;
    requirements(report, out)?;
    // What is most urgent stands last, where the terminal ends.
    for verdict in Report::URGENT.into_iter().rev() {
        for group in report.groups(verdict) {
            self::group(&group, out)?;
        }
    }
    profile(report, out)?;
    log(report, out)?;
    if let Some(sentence) = report.cut_short() {
        writeln!(out, "\n{sentence}")?;
    }
    summary(report, out)
}

/// Writes one check: what it asks, what it demands, and which sentence of which document that is.
///
/// # Errors
/// If it can't be written.
pub fn check(spec: &Spec, check: &Check, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "{BOLD}{}{BOLD:#}", check.id)?;
    if let Some(words) = Statement::of(spec, &check.requirement) {
        statement(check.level, &words, out)?;
    }
    writeln!(out, "  {:9} {DIM}{}{DIM:#}", "packet of", spec.place(&check.source))?;
    writeln!(out, "  {:9} {}", "request", check.question)?;
    let (outputs, reject) = match &check.demand {
        Demand::Yield(output) => (std::slice::from_ref(output), None),
        Demand::YieldOneOf(outputs) => (outputs.as_slice(), None),
        Demand::Reject(fault) => (&[][..], Some(format!("a rejection ({fault})"))),
        Demand::Record(open) => return question(open, out),
    };
    for output in outputs {
        writeln!(out, "  {:9} {output}", "demanded")?;
    }
    reject.map_or(Ok(()), |reject| writeln!(out, "  {:9} {reject}", "demanded"))
}

/// A question that the documents leave open, and the ways that are foreseen.
fn question(open: &Unspecified, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "  {:9} {}", "recorded", open.question)?;
    for way in &open.ways {
        writeln!(out, "  {:9} {}: {}", "", way.name, way.output)?;
    }
    writeln!(out, "  {:9} or a rejection", "")
}

/// A requirement in words, and who says so.
fn statement(level: Level, statement: &Statement, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "  {level:9} {}", statement.text)?;
    writeln!(out, "  {:9} {DIM}{}{DIM:#}", "says who", statement.place())
}

/// A line a requirement: how its checks came out.
fn requirements(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    let width = report.requirements.iter().map(|row| row.id.len()).max().unwrap_or(0);
    for row in &report.requirements {
        writeln!(out, "  {:width$}  {}", row.id, counts(&row.totals))?;
    }
    Ok(())
}

fn group(group: &Group<'_>, out: &mut dyn Write) -> io::Result<()> {
    let Group { verdict, requirement, results } = group;
    let style = style(*verdict);
    let word = verdict.to_string().to_uppercase().replace('-', " ");
    writeln!(out)?;
    write!(out, "{style}{word}{style:#} {BOLD}{}{BOLD:#}", requirement.id)?;
    match results.len() {
        1 => writeln!(out)?,
        many => writeln!(out, "  {many} of {} checks, the smallest first", requirement.checks())?,
    }
    if let Some(words) = &requirement.statement {
        statement(requirement.level, words, out)?;
    }
    let shown = group.shown(WHOLE, NAMED);
    for result in shown.whole {
        self::result(result, out)?;
    }
    if !shown.named.is_empty() {
        let more = shown.named.len() + shown.beyond;
        writeln!(out, "  … and {more} more; --report json=FILE has them all:")?;
    }
    for result in shown.named {
        writeln!(out, "            {}", result.outcome.id)?;
    }
    if shown.beyond > 0 {
        writeln!(out, "            … and {} more", shown.beyond)?;
    }
    Ok(())
}

fn result(result: &CheckResult, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "  {:9} {BOLD}{}{BOLD:#}", "check", result.outcome.id)?;
    for (label, text) in result.evidence() {
        writeln!(out, "  {label:9} {text}")?;
    }
    Ok(())
}

/// Whoever mixes implementations on a bus may want to know.
fn profile(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    if report.profile.is_empty() {
        return Ok(());
    }
    let many = words::count(report.profile.len(), "question");
    let rest = "that the documents leave open: --report html=FILE shows what it does there";
    writeln!(out, "\n{DIM}{many} {rest}{DIM:#}")
}

/// What the adapter logged, where something went wrong with the adapter itself.
fn log(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    if report.log.is_empty() || !report.adapter_broke() {
        return Ok(());
    }
    writeln!(out, "\nThe adapter's standard error ends with:")?;
    for line in report.log.lines() {
        writeln!(out, "  {line}")?;
    }
    Ok(())
}

fn summary(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    let color = match report.exit_status() {
        0 => AnsiColor::Green,
        1 => AnsiColor::Red,
        _ => AnsiColor::Yellow,
    };
    let style = color.on_default().bold();
    writeln!(out, "\n{style}{}{style:#}  {}", report.word(), counts(&report.totals))
}

/// `12 pass  3 fail`, without the verdicts that did not come out.
pub(super) fn counts(totals: &Totals) -> String {
    let count = |(verdict, count)| {
        let style = style(verdict);
        format!("{style}{count} {verdict}{style:#}")
    };
    totals.counts().map(count).collect::<Vec<_>>().join("  ")
}

pub(super) const fn style(verdict: Verdict) -> Style {
    match verdict {
        Verdict::Pass => AnsiColor::Green.on_default(),
        Verdict::Fail | Verdict::UnexpectedPass => AnsiColor::Red.on_default().bold(),
        Verdict::Skip => DIM,
        _ => AnsiColor::Yellow.on_default(),
    }
}
