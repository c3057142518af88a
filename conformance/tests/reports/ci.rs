//! What CI servers and pages read: TAP, annotations, badges.

use std::collections::BTreeMap;

use actucheck::report::{Format, Report};
use actucheck::verdict::Verdict;
use serde_json::{Value, json};

use super::sample::{self, written};

/// A test point: whether it is `ok`, its name, its directive, and the block of YAML after it.
type Point = (bool, String, Option<String>, BTreeMap<String, String>);

/// A reader of TAP that shares nothing with what writes it.
fn points(text: &str) -> Vec<Point> {
    let mut lines = text.lines().peekable();
    assert_eq!(lines.next(), Some("TAP version 14"));
    let plan: usize = lines.next().unwrap().strip_prefix("1..").unwrap().parse().unwrap();
    let mut points = Vec::new();
    while let Some(line) = lines.next().filter(|line| !line.starts_with("Bail out!")) {
        let (is_ok, rest) = match line.strip_prefix("not ok ") {
            Some(rest) => (false, rest),
            None => (true, line.strip_prefix("ok ").unwrap()),
        };
        let (number, rest) = rest.split_once(" - ").unwrap();
        assert_eq!(number.parse(), Ok(points.len() + 1));
        let (id, directive) = match rest.split_once(" # ") {
            Some((id, directive)) => (id, Some(directive.to_owned())),
            None => (rest, None),
        };
        let mut block = String::new();
        if lines.next_if_eq(&"  ---").is_some() {
            block = lines
                .by_ref()
                .take_while(|line| *line != "  ...")
                .fold(block, |all, line| all + line + "\n");
        }
        let block =
            if block.is_empty() { BTreeMap::new() } else { serde_yaml::from_str(&block).unwrap() };
        points.push((is_ok, id.to_owned(), directive, block));
    }
    assert_eq!(points.len(), plan);
    points
}

#[test]
fn tap_has_a_point_for_each_requirement_with_its_smallest_case() {
    let report = sample::every_verdict();
    let points = points(&written(Format::Tap, &report));
    for ((is_ok, id, directive, block), requirement) in points.iter().zip(&report.requirements) {
        assert_eq!(*id, requirement.id);
        let own = |word: &str| directive.as_ref().is_some_and(|text| text.starts_with(word));
        let (expected_ok, expected_directive) = match requirement.verdict {
            Verdict::Pass | Verdict::Recorded | Verdict::Warn => (true, directive.is_none()),
            Verdict::Skip => (true, own("SKIP ")),
            Verdict::ExpectedFailure => (false, own("TODO ")),
            _ => (false, directive.is_none()),
        };
        assert_eq!((*is_ok, true), (expected_ok, expected_directive), "{id}");
        let statement = requirement.statement.as_ref();
        if let Some(sentence) = block.get("sentence") {
            assert_eq!(Some(sentence), statement.map(|it| &it.text));
        }
        let verdict = requirement.verdict;
        let has_case = verdict.is_wrong() || verdict == Verdict::Warn;
        assert_eq!(block.contains_key("check"), has_case, "{id}");
    }
}

#[test]
fn tap_says_that_a_run_is_not_whole() {
    let text = written(Format::Tap, &sample::interrupted());
    insta::assert_snapshot!(text.lines().last().unwrap(), @"Bail out! interrupted: 7 checks not asked");
}

#[test]
fn annotations_name_what_is_at_fault_in_one_line_each() {
    let text = written(Format::Github, &sample::small());
    assert_eq!(text.lines().count(), 1);
    let lines: Vec<_> = text.trim_end().split("%0A").collect();
    let title = "fail%3A dynamixel2.stuffing.transmit%2C 1 of 2 checks";
    assert!(lines[0].starts_with(&format!("::error title={title}::A sender adds FD")), "{text}");
    assert_eq!(lines[4], "differs   byte 5, in the length");
    let replay = "replay    actucheck replay dynamixel2.stuffing.goal-position/encode --";
    assert!(lines.last().unwrap().starts_with(replay), "{text}");
    assert_eq!(written(Format::Github, &sample::right()), "");
}

#[test]
fn an_annotation_cannot_be_ended_by_what_it_tells() {
    let text = written(Format::Github, &sample::every_verdict());
    let all =
        text.lines().filter(|line| line.starts_with("::error ") || line.starts_with("::warning "));
    assert_eq!(all.count(), text.lines().count());
    assert!(text.lines().count() > 3, "{text}");
}

#[test]
fn an_annotation_tells_of_no_more_than_is_shown() {
    let text = written(Format::Github, &sample::left_in_whole());
    let count = |kind: &str| text.lines().filter(|line| line.starts_with(kind)).count();
    assert!(count("::error ") <= 10 && count("::warning ") <= 10);
}

#[test]
fn a_badge_has_the_fields_of_its_format() {
    let badge =
        |report: &Report| serde_json::from_str::<Value>(&written(Format::Badge, report)).unwrap();
    let right = sample::small_right();
    let passed = right.summary.totals.count(Verdict::Pass);
    assert!(passed < 1000, "{passed} is written with a comma");
    let passed = format!("{passed} checks passed");
    let label = "dynamixel2";
    assert_eq!(
        badge(&right),
        json!({"schemaVersion": 1, "label": label, "message": passed, "color": "brightgreen", "isError": false})
    );
    assert_eq!(
        badge(&sample::small()),
        json!({"schemaVersion": 1, "label": label, "message": "1 requirement failed", "color": "red", "isError": true})
    );
    let interrupted = badge(&Report { requirements: Vec::new(), ..sample::interrupted() });
    assert!(interrupted["message"] != passed, "{interrupted}");
}

#[test]
fn what_did_not_start_is_told_where_a_server_looks() {
    let told = |format: Format| {
        let text = format.not_started("no such\nprogram: 100%").map(Result::unwrap);
        text.map(|text| String::from_utf8(text).unwrap())
    };
    assert_eq!(told(Format::Tap).unwrap(), "TAP version 14\nBail out! no such program: 100%\n");
    assert_eq!(
        told(Format::Github).unwrap(),
        "::error title=not started::no such%0Aprogram: 100%25\n"
    );
    assert!(told(Format::Junit).unwrap().contains("<error"));
    assert!(told(Format::Json).is_none());
}
