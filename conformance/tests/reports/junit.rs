use std::collections::BTreeSet;

use actucheck::report::{Format, Report};
use actucheck::verdict::Verdict;
use roxmltree::{Document, Node};

use super::sample;

fn junit(report: &Report) -> String {
    sample::written(Format::Junit, report)
}

fn elements<'a>(document: &'a Document<'_>, name: &str) -> Vec<Node<'a, 'a>> {
    document.descendants().filter(|node| node.has_tag_name(name)).collect()
}

fn number(node: &Node<'_, '_>, attribute: &str) -> usize {
    node.attribute(attribute).unwrap().parse().unwrap()
}

#[test]
fn every_requirement_is_a_test_case_and_so_is_each_kept_failure() {
    let report = sample::every_verdict();
    let text = junit(&report);
    let document = Document::parse(&text).unwrap();
    let cases = elements(&document, "testcase");
    let names: BTreeSet<_> = cases.iter().filter_map(|case| case.attribute("name")).collect();
    let kept = || report.not_passed.iter().filter(|row| row.verdict.is_wrong());
    let kept: Vec<_> = kept().flat_map(|row| &row.smallest).collect();
    let expected = report.requirements.iter().map(|row| row.id.as_str());
    let expected = expected.chain(kept.iter().map(|result| result.outcome.id.as_str()));
    assert_eq!(names, expected.collect());
    assert_eq!(cases.len(), names.len());

    let verdicts = || {
        let requirements = report.requirements.iter().map(|row| row.verdict);
        requirements.chain(kept.iter().map(|result| result.outcome.verdict))
    };
    let count = |of: &[Verdict]| verdicts().filter(|verdict| of.contains(verdict)).count();
    let failed = [Verdict::Fail, Verdict::Flaky, Verdict::UnexpectedPass];
    let failures = count(&failed) + count(&[Verdict::Timeout, Verdict::Crash]);
    let errors = count(&[Verdict::AdapterFault, Verdict::NotRun]);
    let skipped = count(&[Verdict::Skip, Verdict::ExpectedFailure]);
    assert!(failures > 0 && errors > 0 && skipped > 0);
    let numbers = [cases.len(), failures, errors, skipped];
    for (name, number) in ["failure", "error", "skipped"].into_iter().zip(&numbers[1..]) {
        assert_eq!(elements(&document, name).len(), *number, "{name}");
    }
    let attributes = ["tests", "failures", "errors", "skipped"];
    let root = document.root_element();
    assert_eq!(attributes.map(|attribute| number(&root, attribute)), numbers);
    let suites = elements(&document, "testsuite");
    let sum = |attribute| suites.iter().map(|suite| number(suite, attribute)).sum::<usize>();
    assert_eq!(attributes.map(sum), numbers);
}

#[test]
fn a_requirement_says_what_it_demands_and_how_many_checks_it_fails() {
    let text = junit(&sample::small());
    let document = Document::parse(&text).unwrap();
    let cases = elements(&document, "testcase");
    let name = Some("dynamixel2.stuffing.transmit");
    let case = cases.iter().find(|case| case.attribute("name") == name).unwrap();
    let failure = case.children().find(|node| node.has_tag_name("failure")).unwrap();
    assert_eq!(failure.attribute("message"), Some("1 of 2 checks"));
    let said = case.children().find(|node| node.has_tag_name("system-out")).unwrap();
    assert!(said.text().unwrap().starts_with("must      A sender adds FD after every FF FF FD"));
}

#[test]
fn a_failure_has_its_evidence_and_an_expected_one_its_reason() {
    let case = |text: &str, id: &str| {
        let document = Document::parse(text).unwrap();
        let cases = elements(&document, "testcase");
        let case = cases.into_iter().find(|case| case.attribute("name") == Some(id)).unwrap();
        let said = case.first_element_child().unwrap();
        let attribute = |name| said.attribute(name).unwrap().to_owned();
        (attribute("type"), attribute("message"), said.text().unwrap_or_default().to_owned())
    };
    let failed = junit(&sample::small());
    let (kind, _, evidence) = case(&failed, "dynamixel2.stuffing.goal-position/encode");
    assert_eq!(kind, "fail");
    assert!(evidence.contains("[0a] 00 03 34 02 ff ff fd [fd] ff [23 51]"), "{evidence}");
    let expected = junit(&sample::every_verdict());
    let (kind, message, _) = case(&expected, "dynamixel2.stuffing.twice/encode");
    assert_eq!(kind, "expected-failure");
    assert!(message.ends_with("expected: <i>known</i>"), "{message}");
}

#[test]
fn a_run_that_was_cut_short_is_an_error() {
    let text = junit(&sample::interrupted());
    let document = Document::parse(&text).unwrap();
    let errors = elements(&document, "error");
    assert_eq!(errors.len(), 1);
    assert_eq!(errors[0].attribute("message"), Some("interrupted: 7 checks not asked"));
}
