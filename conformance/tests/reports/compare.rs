use actucheck::report::compare::{Cell, Comparison, Standing};
use actucheck::report::model::Header;
use actucheck::report::{Format, Report};
use actucheck::verdict::Verdict;

use super::sample;
use actucheck_spec::wire::innfos;

fn compared() -> Comparison {
    Comparison::of(sample::right(), vec![sample::every_verdict()]).unwrap()
}

fn verdicts(
    comparison: &Comparison,
    standing: Standing,
) -> impl Iterator<Item = Vec<Option<Verdict>>> {
    let rows = comparison.rows(standing);
    rows.map(|row| row.cells.iter().map(|cell| cell.as_ref().map(|cell| cell.verdict)).collect())
}

#[test]
fn each_requirement_is_wrong_somewhere_or_different_or_alike() {
    let comparison = compared();
    let standings = [Standing::Wrong, Standing::Different, Standing::Alike];
    let counts = standings.map(|standing| comparison.rows(standing).count());
    assert!(counts.iter().all(|count| *count > 0), "{counts:?}");
    assert_eq!(counts.iter().sum::<usize>(), comparison.requirements.len());

    let wrong = |cells: &Vec<Option<Verdict>>| cells.iter().flatten().any(|it| it.is_wrong());
    assert!(verdicts(&comparison, Standing::Wrong).all(|cells| wrong(&cells)));
    for cells in verdicts(&comparison, Standing::Different) {
        assert!(!wrong(&cells) && cells[0] != cells[1], "{cells:?}");
    }
    for cells in verdicts(&comparison, Standing::Alike) {
        assert!(!wrong(&cells) && cells[0] == cells[1], "{cells:?}");
    }
}

#[test]
fn a_cell_has_the_smallest_check_that_is_wrong() {
    let comparison = compared();
    let row = comparison.requirements.iter().find(|row| row.id == "dynamixel2.stuffing.transmit");
    let [Some(right), Some(odd)] = row.unwrap().cells.as_slice() else {
        panic!("both were asked");
    };
    assert_eq!((right.verdict, &right.smallest), (Verdict::Pass, &None));
    let Cell { verdict: Verdict::Fail, smallest: Some(smallest), .. } = odd else {
        panic!("{odd:?}");
    };
    let report = sample::every_verdict();
    let own = report.not_passed.iter().find(|row| {
        row.requirement == "dynamixel2.stuffing.transmit" && row.verdict == Verdict::Fail
    });
    assert_eq!(smallest, &own.unwrap().smallest[0]);
}

#[test]
fn a_cell_counts_what_could_have_come_out_otherwise() {
    let comparison = compared();
    let shares = |id: &str| {
        let row = comparison.requirements.iter().find(|row| row.id == id).unwrap();
        row.cells.iter().flatten().map(|cell| cell.share().is_some()).collect::<Vec<_>>()
    };
    assert_eq!(shares("dynamixel2.stuffing.transmit"), [false, true], "some failed");
    assert_eq!(shares("dynamixel2.sync-write.parameters"), [false, false], "one is recorded");
    assert_eq!(shares("dynamixel2.bulk-read.no-repeat"), [false, false], "all are recorded");
}

#[test]
fn open_questions_are_answered_alike_or_not() {
    let comparison = compared();
    let alike = |question: &str| {
        let mut all = comparison.profile.iter();
        all.find(|answers| answers.question.starts_with(question)).unwrap().alike()
    };
    assert!(!alike("What is FF FF FD in a received body"));
    assert!(alike("Is a status packet with ID 254 read"));
}

#[test]
fn a_comparison_says_whether_it_is_fair() {
    assert!(compared().asked_alike());
    let less = Comparison::of(sample::right(), vec![sample::small()]).unwrap();
    assert!(!less.asked_alike());
    let small = sample::small();
    let seed = Report { header: Header { seed: 2, ..small.header.clone() }, ..small };
    assert!(!Comparison::of(sample::small(), vec![seed]).unwrap().asked_alike());
    assert!(!Comparison::of(sample::small(), vec![sample::interrupted()]).unwrap().asked_alike());
}

#[test]
fn what_only_one_was_asked_stands_there_for_both() {
    let comparison = Comparison::of(sample::small(), vec![sample::right()]).unwrap();
    let whole = Comparison::of(sample::right(), vec![sample::small()]).unwrap();
    let ids = |comparison: &Comparison| {
        comparison.requirements.iter().map(|row| row.id.clone()).collect::<Vec<_>>()
    };
    assert_eq!(ids(&comparison), ids(&whole), "the order of the documents");
    assert!(comparison.requirements.iter().any(|row| row.cells[0].is_none()));
    assert!(comparison.requirements.iter().all(|row| row.cells[1].is_some()));
}

#[test]
fn reports_without_a_common_wire_are_refused() {
    let right = sample::right();
    let innfos =
        Report { header: Header { wires: vec![innfos::WIRE], ..right.header.clone() }, ..right };
    let error = Comparison::of(sample::small(), vec![innfos]).unwrap_err();
    assert_eq!(
        error.to_string(),
        "unstuffed was checked on wire dynamixel2, right on wire innfos; \
         compare reports with a common wire"
    );
}

#[test]
fn what_differs_in_how_long_answers_take_stands_side_by_side() {
    let slow = sample::of_device();
    let mut quick = sample::of_device();
    let traffic = quick.summary.traffic.as_mut().unwrap();
    let read = traffic.by_instruction.pop().unwrap();
    traffic.by_instruction = vec![read];
    traffic.by_instruction[0].spread.median_us = 250;
    traffic.by_instruction[0].spread.most_us = 1_700;
    let comparison = Comparison::of(slow, vec![quick, sample::small()]).unwrap();
    let write = |format: Format| {
        let mut text = Vec::new();
        format.write_comparison(&comparison, &mut text).unwrap();
        String::from_utf8(text).unwrap()
    };
    let lines = [
        "Answers begin after: half of them, and the longest      1               2              3",
        "    ping                                                0.52, 0.54 ms   -              -",
        "    read                                                0.80, 20.00 ms  0.25, 1.70 ms  -",
    ];
    let text = write(Format::Text);
    let shown: Vec<_> =
        text.lines().skip_while(|line| !line.starts_with("Answers begin")).collect();
    assert_eq!(shown[..3], lines, "{text}");
    let page = write(Format::Markdown);
    assert!(page.contains("| <code>read</code> | 0.80, 20.00 ms | 0.25, 1.70 ms | - |"), "{page}");
    let page = write(Format::Html);
    assert!(page.contains("0.25, 1.70 ms"), "{page}");
    let again: Comparison = serde_json::from_str(&write(Format::Json)).unwrap();
    assert_eq!(again, comparison);
    let none = Comparison::of(sample::small(), vec![sample::right()]).unwrap();
    assert!(none.response.is_empty());
}
