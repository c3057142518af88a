use std::fs;
use std::path::Path;

use actucheck::adapter::{self, Output, Question, Wire};
use actucheck::compose;
use actucheck::journal;
use actucheck::report::compare::Comparison;
use actucheck::report::jsonl::Stream;
use actucheck::report::read::{self, ReadError};
use actucheck::report::{Collector, End, Format, Report, schema};
use actucheck::subject::{Builtin, Subject as _};
use actucheck::verdict::{Outcome, Verdict};
use actucheck_spec::model::Level;
use jsonschema::Validator;
use serde_json::{Value, json};

use super::sample;

fn written(report: &Report) -> String {
    sample::written(Format::Json, report)
}

fn value(report: &Report) -> Value {
    serde_json::from_str(&written(report)).unwrap()
}

pub(crate) fn validator(name: &str) -> Validator {
    let (_, text) = schema::all().into_iter().find(|(other, _)| *other == name).unwrap();
    jsonschema::validator_for(&serde_json::from_str(&text).unwrap()).unwrap()
}

pub(crate) fn faults(validator: &Validator, value: &Value) -> Vec<String> {
    let faults = validator.iter_errors(value);
    faults.map(|fault| format!("{}: {fault}", fault.instance_path())).collect()
}

#[test]
fn the_schemas_in_the_tree_are_fresh() {
    for (name, text) in schema::all()
        .into_iter()
        .chain(adapter::schema::all())
        .chain([compose::schema(), journal::schema()])
    {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("schema");
        let file = folder.join(format!("{name}.schema.json"));
        if std::env::var_os("ACCEPT").is_some() {
            fs::create_dir_all(folder).unwrap();
            fs::write(&file, &text).unwrap();
        }
        let there = fs::read_to_string(&file).unwrap_or_default();
        assert!(there == text, "{name}: ACCEPT=1 cargo test --workspace --test reports");
    }
}

#[test]
fn reports_fit_the_schema() {
    let validator = validator("report");
    for report in [sample::every_verdict(), sample::right(), sample::interrupted()] {
        assert_eq!(faults(&validator, &value(&report)), Vec::<String>::new());
    }
}

#[test]
fn what_is_broken_does_not_fit_the_schema() {
    let validator = validator("report");
    let small = value(&sample::small());
    assert_eq!(faults(&validator, &small), Vec::<String>::new());
    for key in small.as_object().unwrap().keys() {
        let mut broken = small.clone();
        broken.as_object_mut().unwrap().remove(key);
        assert!(!validator.is_valid(&broken), "without {key}");
    }
    let failed = "/not_passed/0/smallest/0";
    assert_eq!(small.pointer(failed).unwrap()["verdict"], "fail");
    for (place, wrong) in [
        ("/wires/0".to_owned(), json!("modbus")),
        ("/stopped".to_owned(), json!("bored")),
        ("/totals/fail".to_owned(), json!(-1)),
        ("/requirements/0/level".to_owned(), json!("shall")),
        (format!("{failed}/verdict"), json!("failed")),
        (format!("{failed}/request/op"), json!("guess")),
        (format!("{failed}/diff/expected/0"), json!({"equal": "ff"})),
        (format!("{failed}/expected/bytes"), json!("0g")),
    ] {
        let mut broken = small.clone();
        *broken.pointer_mut(&place).unwrap() = wrong;
        assert!(!validator.is_valid(&broken), "{place}");
    }
}

#[test]
fn comparisons_fit_their_schema() {
    let comparison = Comparison::of(sample::right(), vec![sample::every_verdict()]).unwrap();
    let mut text = Vec::new();
    Format::Json.write_comparison(&comparison, &mut text).unwrap();
    let mut value: Value = serde_json::from_slice(&text).unwrap();
    let validator = validator("comparison");
    assert_eq!(faults(&validator, &value), Vec::<String>::new());
    value["requirements"][0]["cells"][0] = json!("pass");
    assert!(!validator.is_valid(&value));
}

#[test]
fn what_did_not_pass_is_counted_and_the_smallest_few_are_kept() {
    let report = sample::every_verdict();
    let fine = [Verdict::Pass, Verdict::Recorded, Verdict::Skip];
    for verdict in Verdict::ALL {
        let count = report.summary.totals.count(verdict);
        assert!(count > 0, "the sample lacks {verdict}");
        let rows = || report.not_passed.iter().filter(|row| row.verdict == verdict);
        let counted: usize = rows().map(|row| row.count).sum();
        assert_eq!(counted, if fine.contains(&verdict) { 0 } else { count }, "{verdict}");
        for row in rows() {
            assert_eq!(row.smallest.len(), row.count.min(5), "{verdict}");
        }
    }
    assert!(report.not_passed.iter().any(|row| row.count > 5));
}

/// An outcome with a request of `size` bytes.
fn failure(place: usize, size: usize, detail: &str) -> Outcome {
    Outcome {
        id: format!("dynamixel2.some.{place}/crc"),
        requirement: "dynamixel2.crc.value".to_owned(),
        level: Level::Must,
        verdict: Verdict::Fail,
        detail: detail.to_owned(),
        because: None,
        reason: None,
        request: Some(Question::Crc { wire: Wire::default(), bytes: vec![0; size].into() }),
        expected: Some(Output::Crc(0)),
        actual: Some(Output::Bytes(vec![1; size].into())),
        behaviour: None,
        after: None,
        log: None,
        number: None,
    }
}

#[test]
fn of_equal_failures_those_with_the_shortest_requests_are_kept_and_then_the_first() {
    let sizes = [9, 7, 8, 7, 9, 7, 1, 7];
    let outcomes = sizes.iter().enumerate().map(|(place, size)| failure(place, *size, ""));
    let report = collected(outcomes);
    let [row] = report.not_passed.as_slice() else { panic!("{:?}", report.not_passed) };
    let ids: Vec<_> = row.smallest.iter().map(|kept| kept.outcome.id.as_str()).collect();
    assert_eq!(ids, [6, 1, 3, 5, 7].map(|place| format!("dynamixel2.some.{place}/crc")));
    assert_eq!(row.count, sizes.len());
}

#[test]
fn a_report_is_small_whatever_an_implementation_says() {
    let long = "\u{7}".repeat(1_000_000);
    let failures = (0..20).map(|place| failure(place, 100_000, &long));
    let skips = (0..1000).map(|place| {
        let detail = format!("{place} {long}");
        Outcome { verdict: Verdict::Skip, request: None, ..failure(place, 0, &detail) }
    });
    let report = collected(failures.chain(skips));
    let kept = &report.not_passed[0].smallest[0];
    assert_eq!((&kept.outcome.request, &kept.outcome.actual), (&None, &None));
    assert!(kept.left_out.unwrap() > 400_000);
    assert!(kept.outcome.detail.ends_with("… (999808 bytes more)"), "{}", kept.outcome.detail);
    assert!(report.skips.len() <= 201);
    assert_eq!(report.skips.iter().map(|skip| skip.count).sum::<usize>(), 1000);
    let size = written(&report).len();
    assert!(size < 2_000_000, "{size}");
}

fn collected(outcomes: impl Iterator<Item = Outcome>) -> Report {
    let builtin = Builtin::default();
    let run = sample::run(&builtin.hello().implementation);
    let mut collector = Collector::new(&run);
    collector.extend(outcomes);
    collector.finish(End::default())
}

#[test]
fn lines_fit_their_schema_and_tell_of_every_check() {
    let builtin = Builtin::default();
    let run = sample::run(&builtin.hello().implementation);
    let mut text = Vec::new();
    let mut stream = Stream::begin(&mut text, run.header()).unwrap();
    let outcomes = [failure(0, 1, "no"), Outcome { verdict: Verdict::Pass, ..failure(1, 1, "") }];
    for outcome in outcomes.clone() {
        stream.check(run.result(outcome)).unwrap();
    }
    stream.end(collected(outcomes.into_iter()).summary).unwrap();
    let lines = String::from_utf8(text).unwrap();
    let lines: Vec<Value> = lines.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let validator = validator("line");
    for line in &lines {
        assert_eq!(faults(&validator, line), Vec::<String>::new());
        let mut broken = line.clone();
        broken.as_object_mut().unwrap().remove("line");
        assert!(!validator.is_valid(&broken), "{broken}");
    }
    let kinds: Vec<_> = lines.iter().map(|line| line["line"].as_str().unwrap()).collect();
    assert_eq!(kinds, ["header", "check", "check", "summary"]);
    assert_eq!((&lines[0]["version"], &lines[1]["verdict"]), (&json!(3), &json!("fail")));
    assert_eq!(lines[3]["totals"]["pass"], 1);
}

fn read(text: &str) -> Result<Report, ReadError> {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("report.json");
    fs::write(&file, text).unwrap();
    read::read(&file)
}

#[test]
fn a_report_can_be_read_back() {
    for report in [sample::every_verdict(), sample::right(), sample::interrupted()] {
        assert!(read(&written(&report)).unwrap() == report);
    }
}

/// A report of version 3, of an implementation that does not stuff.
const VERSION_3: &str = include_str!("version-3.json");

#[test]
fn a_report_of_version_3_can_be_read() {
    let report = read(VERSION_3).unwrap();
    assert_eq!(report.version, 6);
    let [row] = report.not_passed.as_slice() else { panic!("{:?}", report.not_passed) };
    assert_eq!((row.count, row.smallest.len()), (1, 1));
    assert_eq!(row.smallest[0].outcome.id, "dynamixel2.stuffing.goal-position/encode");
    assert!(row.smallest[0].diff.is_some() && row.smallest[0].replay.is_some());
    assert_eq!(report.skips.iter().map(|skip| skip.count).sum::<usize>(), 5);
    assert!(read(&written(&report)).unwrap() == report);
}

#[test]
fn a_report_of_version_3_keeps_the_smallest_of_what_it_had() {
    let mut old: Value = serde_json::from_str(VERSION_3).unwrap();
    let results = old["results"].as_array_mut().unwrap();
    let failed = results.iter().find(|result| result["verdict"] == "fail").unwrap().clone();
    results.extend(vec![failed; 7]);
    old["totals"]["fail"] = json!(8);
    let mut rows = old["requirements"].as_array_mut().unwrap().iter_mut();
    rows.find(|row| row["verdict"] == "fail").unwrap()["totals"]["fail"] = json!(8);
    let report = read(&old.to_string()).unwrap();
    assert_eq!((report.not_passed[0].count, report.not_passed[0].smallest.len()), (8, 5));
}

#[test]
fn a_report_of_version_4_has_one_wire() {
    let mut old = value(&sample::small());
    old["version"] = json!(4);
    old["wire"] = old["wires"][0].take();
    old.as_object_mut().unwrap().remove("wires");
    let report = read(&old.to_string()).unwrap();
    assert_eq!((report.version, report.header.wires.len()), (6, 1));
    assert_eq!(report, Report { version: 6, ..sample::small() });
}

#[test]
fn what_contradicts_itself_is_refused() {
    let [small, whole] = [sample::small(), sample::every_verdict()].map(|report| value(&report));
    for (place, wrong) in [
        ("/causes/0/failed", json!(0)),
        ("/causes/0/follow", json!(123)),
        ("/causes/0/requirement", json!("dynamixel2.stuffing.receive")),
        ("/skips", json!([])),
        ("/skips/0/count", json!(u64::MAX)),
        ("/profile/0/behaviours/0/count", json!(u64::MAX)),
        ("/expected_failures/0/count", json!(7)),
        ("/mistakes/0/count", json!(u64::MAX)),
        ("/not_passed", json!([])),
        ("/requirements/1", whole["requirements"][0].clone()),
        ("/totals/pass", json!(u64::MAX)),
        ("/requirements/0/totals/pass", json!(u64::MAX)),
    ] {
        let mut broken = whole.clone();
        *broken.pointer_mut(place).unwrap() = wrong;
        let error = read(&broken.to_string()).unwrap_err();
        assert!(matches!(error, ReadError::Contradiction { .. }), "{place}: {error}");
    }
    for (place, wrong) in [
        ("/totals/fail", json!(2)),
        ("/requirements/0/verdict", json!("pass")),
        ("/not_passed/0/count", json!(2)),
        ("/not_passed/0/requirement", json!("dynamixel2.stuffing.receive")),
        ("/not_passed/0/smallest/0/verdict", json!("crash")),
    ] {
        let mut broken = small.clone();
        *broken.pointer_mut(place).unwrap() = wrong;
        let error = read(&broken.to_string()).unwrap_err();
        assert!(matches!(error, ReadError::Contradiction { .. }), "{place}: {error}");
    }
}

/// Without causes, so that nothing else is wrong.
#[test]
fn rows_that_are_there_twice_or_not_at_all_are_refused() {
    let report = || Report { causes: Vec::new(), ..sample::every_verdict() };
    assert_eq!(read(&written(&report())).unwrap(), report());
    let is_refused = |report: &Report, what: &str| {
        let error = read(&written(report)).unwrap_err().to_string();
        assert!(error.contains(what), "{error}");
    };
    let mut twice = report();
    let row = twice.requirements.iter().find(|row| row.totals.sum() == 1).unwrap().clone();
    let (verdict, count) = row.totals.counts().next().unwrap();
    twice.summary.totals.add(verdict, count);
    twice.requirements.push(row);
    is_refused(&twice, " twice");
    let mut twice = report();
    twice.not_passed.push(twice.not_passed[0].clone());
    is_refused(&twice, " twice");
    let mut none = report();
    none.not_passed.remove(0);
    is_refused(&none, "it lacks the checks of ");
}

#[test]
fn more_checks_than_a_number_holds_are_refused() {
    let mut report = sample::every_verdict();
    report.causes.clear();
    let row = report.requirements.iter_mut().find(|row| row.totals.count(Verdict::Pass) > 0);
    row.unwrap().totals.add(Verdict::Pass, usize::MAX);
    report.summary.totals.add(Verdict::Pass, usize::MAX);
    let error = read(&written(&report)).unwrap_err();
    assert!(matches!(error, ReadError::Contradiction { .. }), "{error}");
}

#[test]
fn what_is_no_report_or_one_of_another_version_is_refused() {
    let text = written(&sample::small());
    let other = text.replacen("\"version\": 6", "\"version\": 2", 1);
    let error = read(&other).unwrap_err().to_string();
    assert!(error.ends_with(
        "report.json is a report of version 2, this program reads 3 to 6; \
         run the checks again, or use the actucheck that wrote it"
    ));
    assert!(matches!(
        read(&text.replacen("\"fail\"", "\"failed\"", 1)),
        Err(ReadError::Parse { .. })
    ));
    assert!(matches!(read("{}"), Err(ReadError::Parse { .. })));
    assert!(matches!(read::read(Path::new("/no/such/file")), Err(ReadError::Read(_))));
}
