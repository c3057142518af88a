//! The report for what collects the results of tests.

use std::io::{self, Write};
use std::time::Duration;

use quick_junit::{NonSuccessKind, TestCase, TestCaseStatus, TestSuite};

use super::model::{CheckResult, Report, RequirementResult};
use crate::verdict::Verdict;

/// Writes a test suite a requirement and a test case a check.
///
/// # Errors
/// If it can't be written.
pub fn write(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    let who = &report.implementation;
    let mut junit = quick_junit::Report::new(format!("{} {}", who.name, who.version));
    if let Ok(time) = Duration::try_from_secs_f64(report.seconds) {
        junit.set_time(time);
    }
    let suites = report.requirements.iter().map(|requirement| suite(report, requirement));
    junit.add_test_suites(suites);
    junit.add_test_suites(report.cut_short().map(cut_short));
    junit.serialize(out).map_err(io::Error::other)
}

fn suite(report: &Report, requirement: &RequirementResult) -> TestSuite {
    let mut suite = TestSuite::new(&requirement.id);
    suite.add_property(("level", requirement.level.to_string().as_str()));
    if let Some(statement) = &requirement.statement {
        suite.add_property(("statement", statement.text.as_str()));
        suite.add_property(("source", statement.place().as_str()));
    }
    let own = report.results.iter().filter(|result| result.outcome.requirement == requirement.id);
    suite.add_test_cases(own.map(case));
    suite
}

fn case(result: &CheckResult) -> TestCase {
    let outcome = &result.outcome;
    let evidence = result.evidence();
    let lines: Vec<_> =
        evidence.iter().map(|(label, value)| format!("{label:9} {value}")).collect();
    let (status, output) = match outcome.verdict {
        Verdict::Pass => (TestCaseStatus::success(), None),
        Verdict::Recorded => {
            let behaviour = outcome.behaviour.as_ref();
            let said = behaviour.map(|said| format!("{} {}", said.question, said.answer));
            (TestCaseStatus::success(), said)
        }
        // JUnit has no warnings; what it has is output that people look at.
        Verdict::Warn => (TestCaseStatus::success(), Some(lines.join("\n"))),
        Verdict::Skip | Verdict::ExpectedFailure => {
            let mut status = TestCaseStatus::skipped();
            status.set_message(&outcome.detail);
            (status, None)
        }
        verdict => {
            let mut status = TestCaseStatus::non_success(kind(verdict));
            status.set_type(verdict.to_string()).set_message(&outcome.detail);
            status.set_description(lines.join("\n"));
            (status, None)
        }
    };
    let mut case = TestCase::new(&outcome.id, status);
    case.set_classname(&outcome.requirement);
    if let Some(output) = output {
        case.set_system_out(output);
    }
    case
}

/// The implementation failed, or the check could not be made.
const fn kind(verdict: Verdict) -> NonSuccessKind {
    match verdict {
        Verdict::Fail | Verdict::UnexpectedPass => NonSuccessKind::Failure,
        _ => NonSuccessKind::Error,
    }
}

/// Checks that nobody asked have no ids here, but must not look as if all were well.
fn cut_short(sentence: String) -> TestSuite {
    let mut status = TestCaseStatus::non_success(NonSuccessKind::Error);
    status.set_type("not-run").set_message(sentence);
    let mut suite = TestSuite::new("actucheck");
    suite.add_test_case(TestCase::new("complete", status));
    suite
}
