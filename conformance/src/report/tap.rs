//! The report as test points of the Test Anything Protocol, version 14: one per requirement.

use std::io::{self, Write};

use indexmap::IndexMap;

use super::model::{CheckResult, Report, RequirementResult};
use super::words;
use crate::verdict::Verdict;

/// Writes a test point per requirement, with the smallest of its checks that did not pass. Expected failures
/// are TODO, as readers of this protocol count them for no failures.
///
/// # Errors
/// If it can't be written.
pub fn write(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "TAP version 14\n1..{}", report.requirements.len())?;
    if let Some(part) = report.part() {
        writeln!(out, "# {part}")?;
    }
    for (place, requirement) in report.requirements.iter().enumerate() {
        point(report, place + 1, requirement, out)?;
    }
    match report.cut_short() {
        Some(sentence) => writeln!(out, "Bail out! {}", line(&sentence)),
        None => out.flush(),
    }
}

/// Writes the error that ended a run before its first check.
///
/// # Errors
/// If it can't be written.
pub fn write_not_started(sentence: &str, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "TAP version 14\nBail out! {}", line(sentence))
}

fn point(
    report: &Report,
    number: usize,
    requirement: &RequirementResult,
    out: &mut dyn Write,
) -> io::Result<()> {
    let RequirementResult { id, verdict, totals, .. } = requirement;
    let word = match verdict {
        Verdict::Pass | Verdict::Recorded | Verdict::Warn | Verdict::Skip => "ok",
        _ => "not ok",
    };
    let checks = words::count(requirement.checks(), "check");
    let share = format!("{} of {checks}: {verdict}", words::thousands(totals.count(*verdict)));
    let directive = match verdict {
        Verdict::Skip => format!(" # SKIP {share}"),
        Verdict::ExpectedFailure => format!(" # TODO {share}"),
        _ => String::new(),
    };
    writeln!(out, "{word} {number} - {id}{directive}")?;
    let mut rows = report.not_passed.iter();
    let own = rows.find(|row| row.requirement == *id && row.verdict == *verdict);
    match own.and_then(|own| own.smallest.first()) {
        Some(smallest) => diagnostics(requirement, &share, smallest, out),
        None => Ok(()),
    }
}

/// A block of YAML: the sentence, and the evidence of a check. Strings of JSON are YAML too.
fn diagnostics(
    requirement: &RequirementResult,
    share: &str,
    smallest: &CheckResult,
    out: &mut dyn Write,
) -> io::Result<()> {
    let statement = requirement.statement.as_ref();
    let statement = statement.map(|it| (it.text.clone(), it.place())).unwrap_or_default();
    let head = [
        ("message", share.to_owned()),
        ("sentence", statement.0),
        ("source", statement.1),
        ("check", smallest.outcome.id.clone()),
    ];
    // The lines of a log have a label only once, and a key of YAML must be there once.
    let evidence = smallest.evidence().into_iter().map(|(label, text)| (label, text.to_string()));
    let mut rows: IndexMap<&str, Vec<String>> = IndexMap::new();
    let mut last = "";
    for (label, text) in head.into_iter().chain(evidence) {
        last = if label.is_empty() { last } else { label };
        rows.entry(last).or_default().push(text);
    }
    writeln!(out, "  ---")?;
    for (label, lines) in rows {
        let text = serde_json::to_string(&lines.join("\n"))?;
        writeln!(out, "  {}: {text}", label.replace(' ', "-"))?;
    }
    writeln!(out, "  ...")
}

/// A text in one line.
fn line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
