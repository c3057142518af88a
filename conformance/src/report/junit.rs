//! The report for tools that collect test results.

use std::io::{self, Write};
use std::time::Duration;

use chrono::DateTime;
use quick_junit::{NonSuccessKind, TestCase, TestCaseStatus, TestSuite};

use super::model::{CheckResult, NotPassed, Report, RequirementResult};
use super::view::Section;
use super::words;
use crate::verdict::Verdict;

/// Writes one test suite per section of a document. It has one test case per requirement, each
/// followed by one per kept check that did not pass.
///
/// # Errors
/// If it can't be written.
pub fn write(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    let who = &report.header.implementation;
    let part = report.part().map(|part| format!(", {part}")).unwrap_or_default();
    let mut junit = quick_junit::Report::new(format!("{} {}{part}", who.name, who.version));
    if let Ok(time) = Duration::try_from_secs_f64(report.summary.seconds) {
        junit.set_time(time);
    }
    let date = report.header.date.as_deref().map(DateTime::parse_from_rfc3339);
    if let Some(Ok(date)) = date {
        junit.set_timestamp(date);
    }
    junit.add_test_suites(report.sections().iter().map(|section| suite(report, section)));
    junit.add_test_suites(report.cut_short().as_deref().map(cut_short));
    serialize(&junit, out)
}

/// Writes the error that ended a run before its first check.
///
/// # Errors
/// If it can't be written.
pub fn write_not_started(sentence: &str, out: &mut dyn Write) -> io::Result<()> {
    let mut junit = quick_junit::Report::new("actucheck");
    junit.add_test_suite(error("started", "not-started", sentence));
    serialize(&junit, out)
}

/// A reader that is gone or a full disk is told by the error's kind, which the XML writer would hide.
fn serialize(junit: &quick_junit::Report, out: &mut dyn Write) -> io::Result<()> {
    out.write_all(junit.to_string().map_err(io::Error::other)?.as_bytes())
}

fn suite(report: &Report, section: &Section<'_>) -> TestSuite {
    let mut suite = TestSuite::new(section.title());
    for requirement in &section.requirements {
        suite.add_test_case(self::requirement(report, requirement));
        let own = report.not_passed.iter().filter(|row| row.requirement == requirement.id);
        let wrong = own.filter(|row| row.verdict.is_wrong()).flat_map(|row| &row.smallest);
        suite.add_test_cases(wrong.map(check));
    }
    suite
}

/// The text of a requirement, and the verdicts on its checks.
fn requirement(report: &Report, requirement: &RequirementResult) -> TestCase {
    let RequirementResult { id, level, verdict, totals, .. } = requirement;
    let share = words::count(requirement.checks(), "check");
    let share = format!("{} of {share}", words::thousands(totals.count(*verdict)));
    let mut rows = report.not_passed.iter();
    let own = rows.find(|row| row.requirement == *id && row.verdict == *verdict);
    let share = match own.and_then(NotPassed::origin) {
        Some(origin) => format!("{share}, all because of {origin}"),
        None => share,
    };
    let mut case = case(id, id, *verdict, &share, "");
    let mut lines = Vec::new();
    lines.extend(requirement.statement.as_ref().map(|statement| {
        format!("{:9} {} ({})", level.to_string(), statement.text, statement.place())
    }));
    // JUnit has no warnings, so they are written as output.
    let warnings = report.groups(Verdict::Warn);
    let own = warnings.iter().find(|group| group.requirement.id == *id);
    if let Some(smallest) = own.and_then(|group| group.checks.smallest.first()) {
        lines.push(format!("{:9} {}", Verdict::Warn, smallest.outcome.id));
        lines.extend(evidence(smallest));
    }
    case.set_system_out(lines.join("\n"));
    case
}

/// A check that did not pass, with its evidence.
fn check(result: &CheckResult) -> TestCase {
    let outcome = &result.outcome;
    let lines: Vec<_> = evidence(result).collect();
    let lines = lines.join("\n");
    let message = match &outcome.reason {
        Some(reason) => format!("{}; expected: {reason}", outcome.detail),
        None => outcome.detail.clone(),
    };
    case(&outcome.id, &outcome.requirement, outcome.verdict, &message, &lines)
}

fn evidence(result: &CheckResult) -> impl Iterator<Item = String> {
    result.evidence().into_iter().map(|(label, value)| format!("{label:9} {value}"))
}

fn case(name: &str, class: &str, verdict: Verdict, message: &str, evidence: &str) -> TestCase {
    let mut status = match verdict {
        Verdict::Pass | Verdict::Recorded | Verdict::Warn => TestCaseStatus::success(),
        Verdict::Skip | Verdict::ExpectedFailure => TestCaseStatus::skipped(),
        verdict => TestCaseStatus::non_success(kind(verdict)),
    };
    if !matches!(status, TestCaseStatus::Success { .. }) {
        status.set_type(verdict.to_string()).set_message(message).set_description(evidence);
    }
    let mut case = TestCase::new(name, status);
    case.set_classname(class);
    case
}

/// A failure of the implementation, or an error of the check.
const fn kind(verdict: Verdict) -> NonSuccessKind {
    match verdict {
        Verdict::Fail
        | Verdict::Flaky
        | Verdict::UnexpectedPass
        | Verdict::Crash
        | Verdict::Timeout => NonSuccessKind::Failure,
        _ => NonSuccessKind::Error,
    }
}

/// Checks that were not asked have no test cases, so an error says that they are missing.
fn cut_short(sentence: &str) -> TestSuite {
    error("complete", "not-run", sentence)
}

/// An error of the whole run.
fn error(name: &str, kind: &str, sentence: &str) -> TestSuite {
    let mut status = TestCaseStatus::non_success(NonSuccessKind::Error);
    status.set_type(kind).set_message(sentence);
    let mut suite = TestSuite::new("actucheck");
    suite.add_test_case(TestCase::new(name, status));
    suite
}
