use std::collections::BTreeSet;

use actucheck::report::{Format, Report};
use actucheck::verdict::Verdict;
use roxmltree::{Document, Node};

use super::sample;

fn junit(report: &Report) -> String {
    let mut text = Vec::new();
    Format::Junit.write(report, &mut text).unwrap();
    String::from_utf8(text).unwrap()
}

fn elements<'a>(document: &'a Document<'_>, name: &str) -> Vec<Node<'a, 'a>> {
    document.descendants().filter(|node| node.has_tag_name(name)).collect()
}

fn number(node: &Node<'_, '_>, attribute: &str) -> usize {
    node.attribute(attribute).unwrap().parse().unwrap()
}

#[test]
fn every_check_is_a_test_case_with_its_verdict() {
    let report = sample::every_verdict();
    let text = junit(&report);
    let document = Document::parse(&text).unwrap();
    let cases = elements(&document, "testcase");
    let names: BTreeSet<_> = cases.iter().filter_map(|case| case.attribute("name")).collect();
    assert_eq!((cases.len(), names.len()), (report.results.len(), report.results.len()));

    let count = |verdicts: &[Verdict]| -> usize {
        verdicts.iter().map(|verdict| report.totals.count(*verdict)).sum()
    };
    let failures = count(&[Verdict::Fail, Verdict::UnexpectedPass]);
    let errors = count(&[Verdict::Timeout, Verdict::Crash, Verdict::AdapterFault, Verdict::NotRun]);
    let skipped = count(&[Verdict::Skip, Verdict::ExpectedFailure]);
    assert!(failures > 0 && errors > 0 && skipped > 0);
    assert_eq!(elements(&document, "failure").len(), failures);
    assert_eq!(elements(&document, "error").len(), errors);
    assert_eq!(elements(&document, "skipped").len(), skipped);

    let root = document.root_element();
    assert_eq!(number(&root, "tests"), report.results.len());
    assert_eq!((number(&root, "failures"), number(&root, "errors")), (failures, errors));
    let suites = elements(&document, "testsuite");
    assert_eq!(suites.len(), report.requirements.len());
    let sum = |attribute| suites.iter().map(|suite| number(suite, attribute)).sum::<usize>();
    assert_eq!(sum("tests"), report.results.len());
    assert_eq!(["failures", "errors"].map(sum), [failures, errors]);
}

#[test]
fn a_failure_has_its_evidence_and_an_expected_one_its_reason() {
    let text = junit(&sample::every_verdict());
    let document = Document::parse(&text).unwrap();
    let case = |id: &str| {
        let cases = elements(&document, "testcase");
        cases.into_iter().find(|case| case.attribute("name") == Some(id)).unwrap()
    };
    let failure = case("dynamixel2.stuffing.goal-position/encode").first_element_child().unwrap();
    assert_eq!(failure.attribute("type"), Some("fail"));
    assert!(failure.text().unwrap().contains("[0a] 00 03 34 02 ff ff fd [fd] ff [23 51]"));
    let expected = case("dynamixel2.stuffing.twice/encode").first_element_child().unwrap();
    assert!(expected.attribute("message").unwrap().ends_with("expected: <i>known</i>"));
}

#[test]
fn a_run_that_was_cut_short_is_an_error() {
    let text = junit(&sample::interrupted());
    let document = Document::parse(&text).unwrap();
    let errors = elements(&document, "error");
    assert_eq!(errors.len(), 1);
    assert_eq!(errors[0].attribute("message"), Some("interrupted: 7 checks not asked"));
}
