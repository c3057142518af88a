//! The report as workflow commands of GitHub Actions, which become annotations of the job.

use std::io::{self, Write};

use super::model::{CheckResult, NotPassed, Report};
use super::view::Group;
use crate::verdict::Verdict;

/// How many annotations of a kind the job's page shows of a step.
const SHOWN: usize = 10;

/// Writes an error for each requirement that failed, the most basic first, and a warning for each that is
/// recommended and not done. The rest is in the other formats.
///
/// # Errors
/// If it can't be written.
pub fn write(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    let is_new = |group: &Group<'_>| group.checks.verdict != Verdict::ExpectedFailure;
    let errors: Vec<_> = report.findings().into_iter().filter(is_new).collect();
    annotations("error", &errors, out)?;
    annotations("warning", &report.groups(Verdict::Warn), out)?;
    if let Some(sentence) = report.cut_short() {
        command("error", "the run is not whole", &sentence, out)?;
    }
    out.flush()
}

/// Writes the error that ended a run before its first check.
///
/// # Errors
/// If it can't be written.
pub fn write_not_started(sentence: &str, out: &mut dyn Write) -> io::Result<()> {
    command("error", "not started", sentence, out)
}

fn annotations(kind: &str, groups: &[Group<'_>], out: &mut dyn Write) -> io::Result<()> {
    for group in groups.iter().take(SHOWN) {
        command(kind, &title(group), &message(group), out)?;
    }
    Ok(())
}

/// `fail: dynamixel2.stuffing.transmit, 66 of 4,670 checks`.
fn title(group: &Group<'_>) -> String {
    format!("{}: {}, {}", group.checks.verdict, group.requirement.id, group.share())
}

/// The sentence, and the smallest case.
fn message(group: &Group<'_>) -> String {
    let statement = group.requirement.statement.as_ref();
    let mut lines: Vec<_> = statement
        .map(|statement| format!("{} ({})", statement.text, statement.place()))
        .into_iter()
        .collect();
    let NotPassed { smallest, .. } = group.checks;
    let evidence = smallest.first().map(CheckResult::evidence).unwrap_or_default();
    lines.extend(evidence.iter().map(|(label, text)| format!("{label:9} {text}")));
    lines.join("\n")
}

/// A workflow command: what would end it or its properties is escaped, as its reader expects.
fn command(kind: &str, title: &str, message: &str, out: &mut dyn Write) -> io::Result<()> {
    let data = |text: &str| text.replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A");
    let title = data(title).replace(':', "%3A").replace(',', "%2C");
    writeln!(out, "::{kind} title={title}::{}", data(message))
}
