//! The parts of a run, merged, are the whole run.

use std::collections::BTreeSet;
use std::fs;
use std::num::NonZeroU32;
use std::ops::ControlFlow;
use std::path::Path;
use std::process::Command;
use std::sync::atomic::AtomicBool;

use actucheck::adapter::Question;
use actucheck::report::merge::{MergeError, merge};
use actucheck::report::model::Part;
use actucheck::report::{Collector, End, Format, Report, Run, Stopped, read};
use actucheck::run;
use actucheck::subject::{Answer, Subject};
use actucheck::suite;
use actucheck::suite::expect::Expectations;
use actucheck::suite::partition::Partition;
use actucheck::suite::plan::Outline;
use actucheck::verdict::{Totals, Verdict};
use actucheck_spec::model::Level;
use serde_json::Value;
use tempfile::TempDir;

use super::json::{faults, validator};
use super::sample::{OPTIONS, Odd, SPEC, WIRES, expectations, odd, unstuffed, written};

/// Skips of many kinds, so that texts are many.
fn verbose(op: &Question, answer: Answer) -> Answer {
    match op {
        Question::Crc { bytes, .. } => Answer::Skipped(format!("no CRC of {bytes:?}")),
        _ => answer,
    }
}

fn right(_: &Question, answer: Answer) -> Answer {
    answer
}

/// Ids that several parts have, and that fail in one of them only; that pass in one part, and in
/// several; and that no run has.
const EXPECTED: &str = "[{ids: ['dynamixel2.crc.*', 'dynamixel2.seed-1.*.status/decode'], reason: one}, \
     {ids: ['dynamixel2.stuffing.*/encode', 'ja40.*/encode', ja40.ping.instruction/encode], reason: two}, \
     {ids: ['dynamixel2.seed-2.*', dynamixel2.seed-1.1.status/decode], reason: three}, \
     {ids: ['*.stuffing.*/decode'], reason: four, flaky: true}]";

/// Checks of many kinds, but not so many.
const SOME: &str = "dynamixel2.{basic,crc,open,seed-1,stuffing.[a-z]*-*}*";

/// The report of a run, or of a part of one; and what there is to know of the file.
fn report(
    bend: fn(&Question, Answer) -> Answer,
    rows: Option<&str>,
    partition: Option<Partition>,
) -> (Report, Vec<String>) {
    selected(SOME, bend, rows, partition)
}

fn selected(
    only: &str,
    bend: fn(&Question, Answer) -> Answer,
    rows: Option<&str>,
    partition: Option<Partition>,
) -> (Report, Vec<String>) {
    let mut plan = suite::plan(&SPEC, &WIRES, &OPTIONS.with_bodies(1));
    let mut expected = rows.map_or_else(Expectations::default, |rows| expectations(rows, &plan));
    plan.restrict(&[only.to_owned()], &[], Level::May).unwrap();
    let part = partition.map(|partition| {
        let Outline { checks, ids } = plan.outline();
        plan.take_part(partition);
        Part { partition, checks, ids, settings: vec!["--repeat 1".to_owned()] }
    });
    let subject = Odd::new("odd", bend);
    let implementation = subject.hello().implementation.clone();
    let run = Run { part, ..super::sample::run(&implementation) };
    let mut collector = Collector::new(&run);
    let never = AtomicBool::new(false);
    let asked =
        run::run(&mut [Box::new(subject)], &plan, NonZeroU32::MIN, &never, &mut |mut outcome| {
            assert_eq!(outcome.number.is_some(), partition.is_some());
            expected.apply(&mut outcome);
            collector.add(outcome);
            ControlFlow::Continue(())
        });
    assert_eq!(asked, plan.size());
    let audit = expected.audit();
    audit.unexpected().into_iter().for_each(|passes| collector.revise(passes));
    let end = End {
        seconds: partition.map_or(0.5, |part| 0.5 / f64::from(part.of.get())),
        expectations: partition.filter(|_| audit.is_of_file()).map(|_| audit.clone()),
        ..End::default()
    };
    (collector.finish(end), audit.remarks())
}

fn parts(of: u32) -> impl Iterator<Item = Partition> {
    (1..=of).map(move |number| format!("{number}/{of}").parse().unwrap())
}

fn named(reports: Vec<Report>) -> Vec<(String, Report)> {
    (1..).zip(reports).map(|(number, report)| (format!("{number}.json"), report)).collect()
}

/// A report as it comes out of a file.
fn kept(report: &Report) -> Report {
    read::parse("part.json", &written(Format::Json, report)).unwrap()
}

#[test]
fn merged_parts_are_the_whole_byte_for_byte() {
    for (bend, rows, of) in [
        // The times of two or four parts have an exact sum.
        (unstuffed as fn(&Question, Answer) -> Answer, None, 2),
        (odd, Some(EXPECTED), 4),
        (odd, None, 1),
        (verbose, None, 2),
    ] {
        let (whole, remarks) = report(bend, rows, None);
        // They are given in any order.
        let mut files: Vec<_> =
            parts(of).map(|part| kept(&report(bend, rows, Some(part)).0)).collect();
        files.reverse();
        let (merged, audit) = merge(&SPEC, named(files)).unwrap();
        for format in Format::ALL.into_iter().filter(|format| *format != Format::Jsonl) {
            let [merged, whole] = [&merged, &whole].map(|report| written(format, report));
            assert!(merged == whole, "{format:?}\n{merged}\n---\n{whole}");
        }
        assert_eq!(merged.exit_status(), whole.exit_status());
        assert_eq!(audit.is_some(), rows.is_some());
        assert_eq!(
            audit.map_or_else(Vec::new, |audit| audit.remarks()),
            if rows.is_some() { remarks } else { Vec::new() }
        );
    }
}

#[test]
fn what_is_outdated_is_known_when_all_parts_were_asked() {
    let rows = Some("[{ids: ['dynamixel2.seed-1.*'], reason: old}]");
    let unexpected = |report: &Report| report.summary.totals.count(Verdict::UnexpectedPass);
    let (whole, _) = report(right, rows, None);
    assert!(unexpected(&whole) > 50 && whole.exit_status() == 1);
    let parts: Vec<_> = parts(4).map(|part| report(right, rows, Some(part)).0).collect();
    for part in &parts {
        assert_eq!((unexpected(part), part.exit_status()), (0, 0));
    }
    let (merged, _) = merge(&SPEC, named(parts)).unwrap();
    assert_eq!(merged, Report { summary: whole.summary.clone(), ..whole });
}

#[test]
fn a_failure_is_charged_to_a_check_of_another_part() {
    // One check of its own accuses the requirement.
    let only = "dynamixel2.{basic.stuffing.instruction,crc.behind-fffffd.*.write}/encode";
    let report = |part| selected(only, unstuffed, None, Some(part)).0;
    let parts: Vec<_> = parts(3).map(report).collect();
    for part in &parts {
        let failed = part.summary.totals.count(Verdict::Fail) > 0;
        assert_eq!(part.exit_status() == 1, failed);
        assert_eq!(part.findings().is_empty(), !failed, "nothing shows why it failed");
    }
    let stuffing = "dynamixel2.stuffing.transmit";
    let follows = |part: &&Report| {
        part.causes.iter().any(|cause| cause.requirement == stuffing && cause.failed == 0)
    };
    let alone: Vec<_> = parts.iter().filter(follows).collect();
    assert!((1..parts.len()).contains(&alone.len()), "{} parts", alone.len());
    let text = written(Format::Text, alone[0]);
    assert!(text.contains("no new failures of its own in this part, but "), "{text}");
}

#[test]
fn a_part_says_which_it_is() {
    let (part, _) = report(odd, None, Some("2/4".parse().unwrap()));
    for format in
        [Format::Text, Format::Junit, Format::Tap, Format::Markdown, Format::Html, Format::Badge]
    {
        let text = written(format, &part);
        assert!(text.contains("part 2 of 4"), "{format:?}: {text}");
    }
    let json: Value = serde_json::from_str(&written(Format::Json, &part)).unwrap();
    assert_eq!((&json["part"]["number"], &json["part"]["of"]), (&2.into(), &4.into()));
    let (part, _) = report(odd, Some(EXPECTED), Some("1/2".parse().unwrap()));
    let json = serde_json::from_str(&written(Format::Json, &part)).unwrap();
    assert_eq!(faults(&validator("report"), &json), Vec::<String>::new());
}

#[test]
fn a_part_of_nothing_but_skips_is_no_failure() {
    let (part, _) = report(right, None, Some("1/4".parse().unwrap()));
    let mut nothing = part.clone();
    nothing.summary.totals = Totals::default();
    assert_eq!(nothing.exit_status(), 0);
    nothing.summary.stopped = Some(Stopped::Interrupted);
    assert_eq!(nothing.exit_status(), 3);
    let whole = report(right, None, None).0;
    let mut nothing = whole;
    nothing.summary.totals = Totals::default();
    assert_eq!(nothing.exit_status(), 3);
}

#[test]
fn what_ended_early_is_not_whole() {
    let mut files: Vec<_> = parts(2).map(|part| report(right, None, Some(part)).0).collect();
    let asked = files[0].requirements.pop().unwrap().totals;
    files[0].summary.left = asked.sum();
    // Counted anew: nothing failed, but some were not asked.
    files[0].summary.totals = Totals::default();
    for row in files[0].requirements.clone() {
        row.totals
            .counts()
            .for_each(|(verdict, count)| files[0].summary.totals.add(verdict, count));
    }
    files[0].summary.stopped = Some(Stopped::Interrupted);
    let (merged, _) = merge(&SPEC, named(files)).unwrap();
    assert_eq!((merged.exit_status(), merged.summary.left), (3, asked.sum()));
    assert_eq!(merged.summary.stopped, Some(Stopped::Interrupted));
}

fn part(report: &mut Report) -> &mut Part {
    report.header.part.as_mut().unwrap()
}

#[test]
fn what_are_not_all_parts_of_one_run_is_refused() {
    let parts = |of| parts(of).map(|part| report(right, Some(EXPECTED), Some(part)).0);
    let (two, three): (Vec<_>, Vec<_>) = (parts(2).collect(), parts(3).collect());
    let [one, other] = &two[..] else { panic!("{}", two.len()) };
    let other_by = |change: fn(&mut Report)| {
        let mut other = other.clone();
        change(&mut other);
        vec![one.clone(), other]
    };
    let refused = |reports: Vec<Report>| merge(&SPEC, named(reports)).unwrap_err().to_string();
    let differs = "2.json is not of the same run as 1.json: ";
    for (reports, sentence) in [
        (vec![], "no report of a part; give those of all parts of a run"),
        (vec![one.clone()], "part 2 of 2 is missing; give the reports of all parts"),
        (
            vec![three[1].clone()],
            "part 1 of 3 is missing, and 1 more; give the reports of all parts",
        ),
        (
            vec![one.clone(), one.clone(), other.clone()],
            "1.json and 2.json are both part 1 of 2; give each part once",
        ),
        (
            vec![one.clone(), three[1].clone()],
            &format!("{differs}the number of parts is 3, not 2; run all parts alike"),
        ),
        (
            other_by(|it| it.header.part = None),
            "2.json is about a whole run; only reports of runs with --partition can be merged",
        ),
        (
            other_by(|it| it.header.actucheck = "9.9.9".to_owned()),
            &format!(
                "{differs}the version of actucheck is 9.9.9, not {}; run all parts alike",
                env!("CARGO_PKG_VERSION")
            ),
        ),
        (
            other_by(|it| it.header.implementation.name = "even".to_owned()),
            &format!(
                "{differs}the implementation is even 1.0 (C), not odd 1.0 (C); run all parts alike"
            ),
        ),
        (
            other_by(|it| it.header.seed = 2),
            &format!("{differs}--seed is 2, not 1; run all parts alike"),
        ),
        (
            other_by(|it| it.header.cases = 11),
            &format!("{differs}--cases is 11, not 10; run all parts alike"),
        ),
        (
            other_by(|it| it.header.body_length = 3),
            &format!("{differs}--body-length is 3, not 4; run all parts alike"),
        ),
        (
            other_by(|it| it.header.command.push("-x".to_owned())),
            &format!(
                "{differs}the adapter's command is ./adapter two words -x, not ./adapter two words; run all parts alike"
            ),
        ),
        (
            other_by(|it| part(it).settings = vec!["--repeat 2".to_owned()]),
            &format!(
                "{differs}how it was asked is --repeat 2, not --repeat 1; run all parts alike"
            ),
        ),
        (
            other_by(|it| part(it).ids = "0".to_owned()),
            &format!("{differs}other checks were selected; run all parts alike"),
        ),
        (
            other_by(|it| it.expectations = None),
            &format!("{differs}the expected failures are others; run all parts alike"),
        ),
    ] {
        assert_eq!(refused(reports), sentence);
    }
    let others = report(right, Some("[]"), Some("2/2".parse().unwrap())).0;
    assert!(refused(vec![one.clone(), others]).contains("the expected failures are others"));
    let fewer = other_by(|it| it.requirements.truncate(1));
    let what = merge(&SPEC, named(fewer)).unwrap_err();
    assert!(matches!(what, MergeError::Contradiction { .. }), "{what}");
}

/// A run of the program in a folder: its exit status, and what it says.
fn actucheck(folder: &Path, arguments: &[&str]) -> (i32, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_actucheck"))
        .current_dir(folder)
        .args(arguments)
        .output()
        .unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

/// A report without what is by nature another one.
fn timeless(folder: &Path, name: &str) -> Value {
    let text = fs::read_to_string(folder.join(name)).unwrap();
    let mut report: Value = serde_json::from_str(&text).unwrap();
    for field in ["seconds", "date", "command_line"] {
        assert!(!report[field].take().is_null(), "{field}");
    }
    report
}

const FEW: [&str; 6] =
    ["codec", "--cases=20", "--body-length=1", "--wire=innfos", "-q", "--skip=innfos.open.*"];

fn run_parts(folder: &Path, of: u32) -> Vec<String> {
    let run = |number| {
        let file = format!("{number}.json");
        let (part, out) = (format!("--partition={number}/{of}"), format!("--report=json={file}"));
        let (status, _, stderr) = actucheck(folder, &[&FEW[..], &[&part, &out]].concat());
        assert_eq!((status, stderr.as_str()), (0, ""));
        file
    };
    (1..=of).map(run).collect()
}

#[test]
fn the_program_merges_what_it_ran() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    assert_eq!(actucheck(path, &[&FEW[..], &["--report=json=whole"]].concat()).0, 0);
    let files = run_parts(path, 4);
    let files: Vec<_> = files.iter().map(String::as_str).collect();
    let merged = [&["report", "merge"], &files[..], &["--report=json=merged"]].concat();
    let (status, stdout, stderr) = actucheck(path, &merged);
    assert_eq!((status, stderr.as_str()), (0, ""));
    assert!(stdout.contains("passed  "), "{stdout}");
    assert_eq!(timeless(path, "merged"), timeless(path, "whole"));
    // The command line is that of the whole, of which one could ask for it again.
    let text = fs::read_to_string(path.join("merged")).unwrap();
    assert!(!text.contains("partition"), "{text}");
    let json = actucheck(path, &[&["report", "merge"], &files[..], &["--report=json=-"]].concat());
    assert_eq!(json.1, text);
}

#[test]
fn files_that_are_no_parts_cost_a_sentence() {
    let folder: TempDir = tempfile::tempdir().unwrap();
    let path = folder.path();
    run_parts(path, 2);
    fs::write(path.join("text"), "no report").unwrap();
    let second = fs::read_to_string(path.join("2.json")).unwrap();
    fs::write(path.join("5-of-2"), second.replace("\"number\": 2,", "\"number\": 5,")).unwrap();
    fs::write(path.join("0-of-2"), second.replace("\"number\": 2,", "\"number\": 0,")).unwrap();
    for (arguments, sentence) in [
        (&["1.json"][..], "part 2 of 2 is missing"),
        (&["1.json", "1.json"], "1.json and 1.json are both part 1 of 2"),
        (&["1.json", "text"], "text is not a report that --report json=FILE wrote"),
        (&["1.json", "none"], "cannot read none"),
        (&["1.json", "5-of-2"], "5-of-2 contradicts itself: there is no part 5 of 2"),
        (&["1.json", "0-of-2"], "0-of-2 is not a report that --report json=FILE wrote"),
        (&["1.json", "2.json", "--report=jsonl=-"], "jsonl has every check of a run"),
        (&[], "required"),
    ] {
        let (status, stdout, stderr) = actucheck(path, &[&["report", "merge"], arguments].concat());
        assert_eq!((status, stdout.as_str()), (2, ""), "{stderr}");
        assert!(stderr.lines().count() == 1 && stderr.contains(sentence), "{stderr}");
    }
    for (arguments, sentence) in [
        (
            &["codec", "--partition=3/2"][..],
            "a part is written as K/N, with K from 1 to N, such as 2/4",
        ),
        (&["codec", "--partition=1/2", "--write-expect=e.yaml"], "cannot be used with"),
        (&["fuzz", "--partition=1/2"], "--seed"),
        (&["host", "--partition=half"], "a part is written as K/N"),
    ] {
        let (status, _, stderr) = actucheck(path, arguments);
        assert!(
            status == 2 && stderr.lines().count() == 1 && stderr.contains(sentence),
            "{stderr}"
        );
    }
}

/// A night's probes on several machines.
#[test]
fn the_parts_of_a_seed_are_all_its_probes() {
    let folder = tempfile::tempdir().unwrap();
    let asked = |options: &[&str]| {
        let fuzz = ["fuzz", "--seed=7", "--cases=700", "-q"];
        let (status, stdout, stderr) = actucheck(folder.path(), &[&fuzz[..], options].concat());
        assert_eq!((status, stderr.as_str()), (0, ""));
        stdout
    };
    let count = |said: &str| said.split(' ').next().unwrap().parse::<u32>().unwrap();
    let parts =
        ["--partition=1/3", "--partition=2/3", "--partition=3/3"].map(|part| asked(&[part]));
    assert!(parts[1].contains(", seed 7, part 2 of 3: nothing found"), "{}", parts[1]);
    let counts: Vec<_> = parts.iter().map(|said| count(said)).collect();
    assert_eq!(counts.iter().sum::<u32>(), count(&asked(&[])), "{counts:?}");
    assert!(counts.iter().all(|count| (150..320).contains(count)), "{counts:?}");
    let different: BTreeSet<_> = counts.iter().collect();
    assert!(different.len() > 1, "they are shared by a hash: {counts:?}");
}
