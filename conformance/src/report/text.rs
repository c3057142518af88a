//! The report for a person at a terminal.

use std::io::{self, Write};

use actucheck_spec::Spec;
use actucheck_spec::model::Level;
use anstyle::{AnsiColor, Style};

use super::model::{CheckResult, Report, Statement};
use super::view::Group;
use super::words;
use crate::adapter::Implementation;
use crate::suite::check::{Check, Demand, Unspecified};
use crate::verdict::{Totals, Verdict};

pub(super) const BOLD: Style = Style::new().bold();
pub(super) const DIM: Style = Style::new().dimmed();

/// The heading of the adapter's log.
pub(super) const LOG: &str = "The adapter's standard error ends with:";

/// Writes the report with ANSI colours, which the writer may take out.
///
/// # Errors
/// If it can't be written.
pub fn write(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "{}", header(report))?;
    causes(report, out)?;
    requirements(report, out)?;
    // The most urgent part is last, at the end of the terminal.
    for verdict in Report::URGENT.into_iter().rev() {
        match verdict {
            Verdict::ExpectedFailure => excused(report, out)?,
            verdict => {
                report.groups(verdict).iter().try_for_each(|group| self::group(group, out))?;
            }
        }
    }
    if let Some(profile) = profile(report) {
        writeln!(out, "\n{DIM}{profile}{DIM:#}")?;
    }
    log(report, out)?;
    for (place, line) in report.passed().iter().enumerate() {
        let before = if place == 0 { "\n" } else { "" };
        writeln!(out, "{before}{line}")?;
    }
    if let Some(sentence) = report.cut_short() {
        writeln!(out, "\n{sentence}")?;
    }
    writeln!(out, "\n{}", summary(report))
}

/// Who was checked, on which wires, with how many checks.
pub(super) fn header(report: &Report) -> String {
    let who = &report.header.implementation;
    let wires = words::wires(&report.header.wires);
    let checks = words::count(report.summary.totals.sum(), "check");
    let Implementation { name, version, language, .. } = who;
    let part = report.part().map(|part| format!("  {part}")).unwrap_or_default();
    format!("{BOLD}{name} {version}{BOLD:#} ({language})  {wires}  {checks}{part}")
}

/// The verdict and the requirement of some checks.
pub(super) fn title(group: &Group<'_>) -> String {
    let style = style(group.checks.verdict);
    let word = group.checks.verdict.to_string().to_uppercase().replace('-', " ");
    format!("{style}{word}{style:#} {BOLD}{}{BOLD:#}", group.requirement.id)
}

/// Writes one check: its question, the right answer, and the sentence of a document that requires
/// it.
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
        Demand::Yield(output) | Demand::Near { output, .. } => (std::slice::from_ref(output), None),
        Demand::YieldOneOf(outputs) => (outputs.as_slice(), None),
        Demand::Reject(fault) => (&[][..], Some(format!("a rejection ({fault})"))),
        Demand::Send => (&[][..], Some("the packet of the last call, and nothing else".to_owned())),
        Demand::Withhold => (&[][..], Some("not the packet of the last call".to_owned())),
        Demand::Return(due) => (&[][..], Some(due.to_string())),
        Demand::Answer(wanted) => {
            let steps: Vec<_> = wanted.iter().map(ToString::to_string).collect();
            (&[][..], Some(steps.join(", and then ")))
        }
        Demand::Record(unspecified) => return question(unspecified, out),
    };
    for output in outputs {
        writeln!(out, "  {:9} {output}", "demanded")?;
    }
    reject.map_or(Ok(()), |reject| writeln!(out, "  {:9} {reject}", "demanded"))
}

/// A question that the documents leave unspecified, and the foreseen behaviours.
fn question(unspecified: &Unspecified, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "  {:9} {}", "recorded", unspecified.question)?;
    for way in &unspecified.ways {
        writeln!(out, "  {:9} {}: {}", "", way.name, way.output)?;
    }
    writeln!(out, "  {:9} or a rejection", "")
}

/// The text of a requirement, and its source.
fn statement(level: Level, statement: &Statement, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "  {level:9} {}", statement.text)?;
    writeln!(out, "  {:9} {DIM}{}{DIM:#}", "source", statement.place())
}

/// What is at fault, before everything that follows from it.
fn causes(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    if report.causes.is_empty() {
        return Ok(());
    }
    writeln!(out)?;
    for line in report.explained(usize::MAX) {
        writeln!(out, "{line}")?;
    }
    writeln!(out, "{BOLD}At fault{BOLD:#}, the most basic first:")?;
    let width = report.causes.iter().map(|cause| cause.requirement.len()).max().unwrap_or(0);
    for cause in &report.causes {
        writeln!(out, "  {:width$}  {}", cause.requirement, cause.effect())?;
        writeln!(out, "  {:width$}  {DIM}first {}{DIM:#}", "", cause.check)?;
    }
    writeln!(out)
}

/// One line per requirement, with the counts of its verdicts.
fn requirements(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    let width = report.requirements.iter().map(|row| row.id.len()).max().unwrap_or(0);
    for row in &report.requirements {
        writeln!(out, "  {:width$}  {}", row.id, counts(&row.totals))?;
    }
    Ok(())
}

fn group(group: &Group<'_>, out: &mut dyn Write) -> io::Result<()> {
    let Group { requirement, checks } = group;
    write!(out, "\n{}", title(group))?;
    if let Some(origin) = group.origin() {
        return writeln!(out, "  {}, all because of {origin}", group.share());
    }
    match checks.count {
        1 => writeln!(out)?,
        _ => writeln!(out, "  {}, the smallest first", group.share())?,
    }
    if let Some(words) = &requirement.statement {
        statement(requirement.level, words, out)?;
    }
    for result in &checks.smallest {
        self::result(result, out)?;
    }
    match group.more() {
        0 => Ok(()),
        more => writeln!(out, "  … and {} more like it", words::thousands(more)),
    }
}

fn result(result: &CheckResult, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "  {:9} {BOLD}{}{BOLD:#}", "check", result.outcome.id)?;
    for (label, text) in result.evidence() {
        writeln!(out, "  {label:9} {text}")?;
    }
    Ok(())
}

/// Expected failures need no evidence.
fn excused(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    for (place, line) in report.excused(usize::MAX).iter().enumerate() {
        let before = if place == 0 { "\n" } else { "" };
        writeln!(out, "{before}{line}")?;
    }
    Ok(())
}

/// Differences in unspecified behaviour matter to users who mix implementations on a bus.
pub(super) fn profile(report: &Report) -> Option<String> {
    let many = words::count(report.profile.len(), "unspecified question");
    let line = format!("{many}: --report html=FILE shows what it does there");
    (!report.profile.is_empty()).then_some(line)
}

/// The adapter's log, if the adapter itself had a problem.
fn log(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    if report.log.is_empty() || !report.adapter_broke() {
        return Ok(());
    }
    writeln!(out, "\n{LOG}")?;
    for line in report.log.lines() {
        writeln!(out, "  {line}")?;
    }
    Ok(())
}

/// The result of the run, and the counts of the verdicts.
pub(super) fn summary(report: &Report) -> String {
    let color = match report.exit_status() {
        0 => AnsiColor::Green,
        1 => AnsiColor::Red,
        _ => AnsiColor::Yellow,
    };
    let style = color.on_default().bold();
    format!("{style}{}{style:#}  {}", report.word(), counts(&report.summary.totals))
}

/// The counts of the verdicts that occurred: `12 pass  3 fail`.
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
