use actucheck::adapter::Question;
use actucheck::report::compare::Comparison;
use actucheck::report::model::{CheckResult, NotPassed, Tally};
use actucheck::report::{Format, Report};
use actucheck::verdict::{Outcome, Verdict};
use anstream::adapter::strip_bytes;
use textwrap::core::display_width;

use actucheck::report::screen::{self, Detail, Terminal};

use super::sample::{self, written};

pub(crate) fn on_terminal(report: &Report, detail: Detail, width: usize) -> String {
    let mut text = Vec::new();
    let terminal = Terminal { detail, width, next: Some("Next: look at the page.") };
    screen::write(report, &terminal, &mut text).unwrap();
    String::from_utf8(strip_bytes(&text).into_vec()).unwrap()
}

#[test]
fn a_terminal_shows_the_worst_last() {
    insta::assert_snapshot!(written(Format::Text, &sample::interrupted()), @r#"
    unstuffed 1.0 (C)  wire dynamixel2  3 checks

    At fault, the most basic first:
      dynamixel2.stuffing.transmit  1 check failed
                                    first dynamixel2.stuffing.goal-position/encode

      dynamixel2.stuffing.transmit  1 pass  1 fail
      dynamixel2.stuffing.receive   1 pass

    FAIL dynamixel2.stuffing.transmit
      must      A sender adds FD after every FF FF FD between the instruction and the last parameter, then sets the length and computes the CRC.
      source    DYNAMIXEL Protocol 2.0, Packet 처리 (packet handling)
      check     dynamixel2.stuffing.goal-position/encode
      request   {"op":"encode","wire":"dynamixel2","packet":{"kind":"instruction","id":1,"instruction":3,"params":"3402fffffdff","call":{"name":"write","address":564,"data":"fffffdff"}}}
      expected  ff ff fd 00 01 [0a] 00 03 34 02 ff ff fd [fd] ff [23 51]
      got       ff ff fd 00 01 [09] 00 03 34 02 ff ff fd ff [7f 05]
      differs   byte 5, in the length
      mistake   fits if the sender left out byte stuffing (1 byte FD)
      because   the answer differs
      replay    actucheck replay dynamixel2.stuffing.goal-position/encode -- ./adapter 'two words'

    interrupted: 7 checks not asked

    FAILED  2 pass  1 fail
    "#);
}

#[test]
fn a_failing_run_fits_a_screen() {
    insta::assert_snapshot!(on_terminal(&sample::interrupted(), Detail::Screen, 80), @r"
    unstuffed 1.0 (C)  wire dynamixel2  3 checks

    At fault, the most basic first:

    FAIL dynamixel2.stuffing.transmit  1 of 2 checks
      must      A sender adds FD after every FF FF FD between the instruction and
                the last parameter, then sets the length and computes the CRC.
      source    DYNAMIXEL Protocol 2.0, Packet 처리 (packet handling)
      request   encode kind: instruction, id: 1, instruction: 3, params:
                3402fffffdff
      expected  ff ff fd 00 01 [0a] 00 03 34 02 ff ff fd [fd] ff [23 51]
      got       ff ff fd 00 01 [09] 00 03 34 02 ff ff fd ff [7f 05]
      differs   byte 5, in the length
      mistake   fits if the sender left out byte stuffing (1 byte FD)
      replay    actucheck replay dynamixel2.stuffing.goal-position/encode -- ./adapter 'two words'

    interrupted: 7 checks not asked

    Next: look at the page.

    FAILED  2 pass  1 fail
    ");
    for report in [sample::every_verdict(), sample::unstuffed_whole(), sample::left_in_whole()] {
        for width in [80, 120] {
            let text = on_terminal(&report, Detail::Screen, width);
            let rows = |line: &str| display_width(line).div_ceil(width).max(1);
            let filled: usize = text.lines().map(rows).sum();
            assert!((12..=40).contains(&filled), "{filled} of {width}:\n{text}");
            let is_evidence = |line: &str| line.starts_with("  ") && !line.starts_with("  replay ");
            let long = |line: &&str| display_width(line) > width && is_evidence(line);
            assert_eq!(text.lines().find(long), None, "{width}");
        }
    }
}

#[test]
fn what_follows_from_a_requirement_is_counted_once() {
    let mut report = sample::unstuffed_whole();
    let failed =
        report.not_passed.iter().find(|row| row.requirement == report.causes[0].requirement);
    let failed = failed.unwrap().clone();
    for verdict in [Verdict::Crash, Verdict::Flaky] {
        report.not_passed.push(NotPassed { verdict, count: 1, ..failed.clone() });
    }
    let text = on_terminal(&report, Detail::Screen, 80);
    let told: Vec<_> = text.lines().filter(|line| line.contains(" others follow")).collect();
    assert!(matches!(told.as_slice(), [line] if line.starts_with("CRASH ")), "{text}");
}

#[test]
fn failures_that_fit_one_mistake_are_told_before_the_list() {
    let report = sample::unstuffed_whole();
    let told = report.mistakes.iter().map(|tally| (tally.text.as_str(), tally.count));
    let told: Vec<_> = told.collect();
    let [("no byte stuffing", count)] = *told else { panic!("{told:?}") };
    // Every packet that is sent, and is not the right one, fits it.
    let sent = |result: &&CheckResult| {
        let Outcome { request, expected, .. } = &result.outcome;
        matches!(request, Some(Question::Encode { .. })) && expected.is_some()
    };
    let failed = report.not_passed.iter().filter(|row| row.verdict == Verdict::Fail);
    let kept: Vec<_> = failed.flat_map(|row| &row.smallest).filter(sent).collect();
    assert!(!kept.is_empty() && kept.iter().all(|result| result.mistake.is_some()), "{kept:#?}");
    assert!(count > kept.len(), "{count}");
    for text in [written(Format::Text, &report), on_terminal(&report, Detail::Screen, 100)] {
        let (before, after) = text.split_once("At fault").unwrap();
        assert!(before.contains(" wrong answers fit the mistake no byte stuffing; "), "{text}");
        let row = "  mistake   fits if the sender left out byte stuffing (1 byte FD)";
        assert!(after.contains(row), "{text}");
    }
    assert_eq!(sample::right().mistakes, []);
}

#[test]
fn each_mistake_has_a_line_of_its_own() {
    let mut report = sample::unstuffed_whole();
    let other = Tally { text: "other CRC".to_owned(), ..report.mistakes[0].clone() };
    report.mistakes.push(other);
    let text = written(Format::Markdown, &report);
    let lines = text.lines().filter(|line| line.contains(" fit the mistake "));
    assert_eq!(lines.filter(|line| line.starts_with("- ")).count(), 2, "{text}");
}

#[test]
fn a_mistake_that_fits_by_chance_is_not_told() {
    let report = sample::unknown_crc_whole();
    assert!(report.mistakes.iter().any(|tally| tally.count > 1), "{:#?}", report.mistakes);
    for text in [written(Format::Text, &report), on_terminal(&report, Detail::Screen, 100)] {
        let (before, _) = text.split_once("At fault").unwrap();
        assert!(!before.contains(" fit "), "{before}");
    }
}

#[test]
fn of_many_earlier_requests_a_few_are_named() {
    let text = written(Format::Text, &sample::every_verdict());
    let after: Vec<_> = text.lines().filter(|line| line.starts_with("  after ")).collect();
    assert!(after.iter().any(|line| line.contains(" more and ")), "{after:?}");
    assert!(after.iter().all(|line| line.matches(", ").count() < 3), "{after:?}");
}

#[test]
fn a_passing_run_takes_a_few_lines_and_a_quiet_one_a_single_line() {
    insta::assert_snapshot!(on_terminal(&sample::small_right(), Detail::Screen, 80), @r"
    right 1.0 (C)  wire dynamixel2  3 checks

    passed  3 pass
    ");
    let last = on_terminal(&sample::interrupted(), Detail::Least, 80);
    assert_eq!(last, "FAILED  2 pass  1 fail\n");
    let all = written(Format::Text, &sample::every_verdict());
    assert_eq!(on_terminal(&sample::every_verdict(), Detail::Most, 80), all);
}

#[test]
fn a_script_in_the_replay_line_is_left_out_of_the_screen() {
    let mut report = sample::small();
    let replay = &mut report.not_passed[0].smallest[0].replay;
    *replay = replay.take().map(|line| format!("{line} 'a\nb'"));
    let text = on_terminal(&report, Detail::Screen, 80);
    let line = text.lines().find(|line| line.starts_with("  replay ")).unwrap();
    assert!(line.ends_with("stuffing.goal-position/encode -- …"), "{text}");
}

#[test]
fn an_expected_failure_is_told_by_its_reason() {
    let report = sample::every_verdict();
    for detail in [Detail::Screen, Detail::Most] {
        let text = on_terminal(&report, detail, 80);
        assert!(text.contains("\n1 expected failure: <i>known</i>\n"), "{text}");
        assert!(!text.contains("EXPECTED FAILURE"), "{text}");
    }
}

#[test]
fn what_follows_from_another_failure_is_told_in_a_line() {
    let report = sample::unstuffed_whole();
    let first = &report.causes[0];
    assert_eq!(first.requirement, "dynamixel2.stuffing.transmit");
    assert!(first.failed > 100 && first.follow > 10, "{first:?}");
    let groups = report.groups(Verdict::Fail);
    assert_eq!(
        (groups[0].requirement.id.as_str(), groups[0].origin()),
        (&*first.requirement, None)
    );
    let told = written(Format::Text, &report);
    let followers = groups.iter().filter(|group| group.origin().is_some());
    assert!(followers.clone().count() > 1);
    for group in followers {
        let beginning = format!("FAIL {} ", group.requirement.id);
        let line = told.lines().find(|line| line.starts_with(&beginning)).unwrap();
        assert!(line.ends_with(", all because of dynamixel2.stuffing.transmit"), "{line}");
    }
}

#[test]
fn a_summary_in_markdown_begins_with_the_causes_and_folds_the_rest() {
    insta::assert_snapshot!(written(Format::Markdown, &sample::interrupted()), @r#"
    ## FAILED: unstuffed 1.0 (C)

    3 checks of 2 requirements, wire dynamixel2, seed 1, 2026-11-27T11:00:00Z

    **interrupted: 7 checks not asked**

    ### At fault, the most basic first

    1. <code>dynamixel2.stuffing.transmit</code>: 1 check failed

    | verdict | checks |
    |---|---:|
    | ✓ pass | 2 |
    | ✗ fail | 1 |

    ### Findings

    <details open><summary>✗ fail <code>dynamixel2.stuffing.transmit</code>: 1 of 2 checks</summary>

    > **must** A sender adds FD after every FF FF FD between the instruction and the last parameter, then sets the length and computes the CRC. (DYNAMIXEL Protocol 2.0, Packet 처리 (packet handling))

        check     dynamixel2.stuffing.goal-position/encode
        request   {"op":"encode","wire":"dynamixel2","packet":{"kind":"instruction","id":1,"instruction":3,"params":"3402fffffdff","call":{"name":"write","address":564,"data":"fffffdff"}}}
        expected  ff ff fd 00 01 [0a] 00 03 34 02 ff ff fd [fd] ff [23 51]
        got       ff ff fd 00 01 [09] 00 03 34 02 ff ff fd ff [7f 05]
        differs   byte 5, in the length
        mistake   fits if the sender left out byte stuffing (1 byte FD)
        because   the answer differs
        replay    actucheck replay dynamixel2.stuffing.goal-position/encode -- ./adapter 'two words'

    </details>
    "#);
}

#[test]
fn markdown_has_a_limit() {
    let mut report = sample::every_verdict();
    let group = report.not_passed.iter_mut().find(|row| row.verdict == Verdict::Fail).unwrap();
    group.smallest[0].outcome.detail = "long ".repeat(200_000);
    let text = written(Format::Markdown, &report);
    assert!(text.len() < 500_000, "{} bytes", text.len());
    assert!(text.contains(" more findings; a report in html or json has them\n"), "{text}");
    let short = written(Format::Markdown, &sample::every_verdict());
    assert!(!short.contains("more findings"), "{short}");
    assert_eq!(short.matches("<details").count(), short.matches("</details>").count());
}

#[test]
fn markdown_takes_what_an_implementation_says_as_text() {
    let text = written(Format::Markdown, &sample::every_verdict());
    let name = r"\<script\>alert('odd')\</script\> \& \|co\|";
    assert!(text.starts_with(&format!("## FAILED: {name} 1.0 (C)\n")), "{text}");
    let code = text.lines().filter(|line| line.contains("<b>said"));
    assert!(
        code.clone().count() > 0 && code.clone().all(|line| line.starts_with("    ")),
        "{text}"
    );
}

#[test]
fn markdown_takes_an_id_as_text() {
    let odd = |text: String| text.replace("dynamixel2.stuffing.transmit", "`a|<b>*b*`");
    let text = serde_json::to_string(&sample::unstuffed_whole()).unwrap();
    let report: Report = serde_json::from_str(&odd(text)).unwrap();
    let mut plain = report.clone();
    plain.requirements.iter_mut().for_each(|row| row.statement = None);
    let comparison = Comparison::of(plain, vec![sample::right()]).unwrap();
    let mut compared = Vec::new();
    Format::Markdown.write_comparison(&comparison, &mut compared).unwrap();
    let compared = String::from_utf8(compared).unwrap();
    assert!(compared.contains("\n| <code>\\`a\\|\\<b\\>\\*b\\*\\`</code> | "), "{compared}");
    for text in [written(Format::Markdown, &report), compared] {
        assert!(text.contains(r"<code>\`a\|\<b\>\*b\*\`</code>"), "{text}");
        let prose = text.lines().filter(|line| !line.starts_with("    "));
        assert_eq!(prose.clone().find(|line| line.contains("|<b>*")), None);
    }
}

#[test]
fn a_comparison_shows_first_who_gets_what_wrong() {
    let comparison = Comparison::of(sample::small(), vec![sample::small_right()]).unwrap();
    let mut text = Vec::new();
    Format::Text.write_comparison(&comparison, &mut text).unwrap();
    insta::assert_snapshot!(String::from_utf8(text).unwrap(), @r"
    wire dynamixel2
      1  unstuffed 1.0 (C)  2 pass  1 fail
      2  right 1.0 (C)  3 pass

    Somebody gets it wrong            1         2
      DYNAMIXEL Protocol 2.0, Packet 처리 (packet handling)
        dynamixel2.stuffing.transmit  fail 1/2  pass

    All alike: 1 requirement
    ");
    let mut text = Vec::new();
    Format::Markdown.write_comparison(&comparison, &mut text).unwrap();
    insta::assert_snapshot!(String::from_utf8(text).unwrap(), @r"
    ## 2 implementations on wire dynamixel2

    ### Somebody gets it wrong

    | requirement | unstuffed 1.0 | right 1.0 |
    |---|---|---|
    | <code>dynamixel2.stuffing.transmit</code><br>DYNAMIXEL Protocol 2.0, Packet 처리 (packet handling) | ✗ fail 1/2 | ✓ pass |

    All alike: 1 requirement.
    ");
}
