use actucheck::report::compare::Comparison;
use actucheck::report::{Format, Report};
use actucheck::verdict::Verdict;

use super::sample;

fn written(format: Format, report: &Report) -> String {
    let mut text = Vec::new();
    format.write(report, &mut text).unwrap();
    String::from_utf8(text).unwrap()
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
      because   the answer differs
      replay    actucheck replay dynamixel2.stuffing.goal-position/encode -- ./adapter 'two words'

    interrupted: 7 checks not asked

    FAILED  2 pass  1 fail
    "#);
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
fn a_summary_in_markdown_is_short() {
    insta::assert_snapshot!(written(Format::Markdown, &sample::interrupted()), @r#"
    ## FAILED: unstuffed 1.0 (C)

    3 checks of 2 requirements, wire dynamixel2, seed 1

    **interrupted: 7 checks not asked**

    | verdict | checks |
    |---|---:|
    | ✓ pass | 2 |
    | ✗ fail | 1 |

    ### At fault, the most basic first

    1. `dynamixel2.stuffing.transmit`: 1 check failed

    ### ✗ fail

    #### `dynamixel2.stuffing.transmit`: 1 of 2 checks

    > **must** A sender adds FD after every FF FF FD between the instruction and the last parameter, then sets the length and computes the CRC. (DYNAMIXEL Protocol 2.0, Packet 처리 (packet handling))

        check     dynamixel2.stuffing.goal-position/encode
        request   {"op":"encode","wire":"dynamixel2","packet":{"kind":"instruction","id":1,"instruction":3,"params":"3402fffffdff","call":{"name":"write","address":564,"data":"fffffdff"}}}
        expected  ff ff fd 00 01 [0a] 00 03 34 02 ff ff fd [fd] ff [23 51]
        got       ff ff fd 00 01 [09] 00 03 34 02 ff ff fd ff [7f 05]
        differs   byte 5, in the length
        because   the answer differs
        replay    actucheck replay dynamixel2.stuffing.goal-position/encode -- ./adapter 'two words'
    "#);
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
    | `dynamixel2.stuffing.transmit`<br>DYNAMIXEL Protocol 2.0, Packet 처리 (packet handling) | ✗ fail 1/2 | ✓ pass |

    All alike: 1 requirement.
    ");
}
