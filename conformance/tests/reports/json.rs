use std::fs;
use std::path::Path;

use actucheck::report::compare::Comparison;
use actucheck::report::read::{self, ReadError};
use actucheck::report::{Format, Report, schema};
use jsonschema::Validator;
use serde_json::{Value, json};

use super::sample;

fn written(report: &Report) -> String {
    let mut text = Vec::new();
    Format::Json.write(report, &mut text).unwrap();
    String::from_utf8(text).unwrap()
}

fn value(report: &Report) -> Value {
    serde_json::from_str(&written(report)).unwrap()
}

fn validator(name: &str) -> Validator {
    let (_, text) = schema::all().into_iter().find(|(other, _)| *other == name).unwrap();
    jsonschema::validator_for(&serde_json::from_str(&text).unwrap()).unwrap()
}

fn faults(validator: &Validator, value: &Value) -> Vec<String> {
    let faults = validator.iter_errors(value);
    faults.map(|fault| format!("{}: {fault}", fault.instance_path())).collect()
}

#[test]
fn the_schemas_in_the_tree_are_fresh() {
    for (name, text) in schema::all() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("schema");
        let file = folder.join(format!("{name}.schema.json"));
        if std::env::var_os("ACCEPT").is_some() {
            fs::create_dir_all(folder).unwrap();
            fs::write(&file, &text).unwrap();
        }
        let there = fs::read_to_string(&file).unwrap_or_default();
        assert!(there == text, "{name}: ACCEPT=1 cargo test -p actucheck --test reports");
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
    let results = small["results"].as_array().unwrap();
    let failed = results.iter().position(|result| result["verdict"] == "fail").unwrap();
    for (place, wrong) in [
        ("/wire".to_owned(), json!("modbus")),
        ("/stopped".to_owned(), json!("bored")),
        ("/totals/fail".to_owned(), json!(-1)),
        ("/requirements/0/level".to_owned(), json!("shall")),
        (format!("/results/{failed}/verdict"), json!("failed")),
        (format!("/results/{failed}/request/op"), json!("guess")),
        (format!("/results/{failed}/diff/expected/0"), json!({"equal": "ff"})),
        (format!("/results/{failed}/expected/bytes"), json!("0g")),
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
fn totals_count_the_results() {
    let value = value(&sample::every_verdict());
    let results = value["results"].as_array().unwrap();
    for (verdict, count) in value["totals"].as_object().unwrap() {
        let found = results.iter().filter(|result| result["verdict"] == verdict.as_str()).count();
        assert!(found > 0, "the sample lacks {verdict}");
        assert_eq!(json!(found), *count, "{verdict}");
    }
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

#[test]
fn what_is_no_report_or_one_of_another_version_is_refused() {
    let text = written(&sample::small());
    let other = text.replacen("\"version\": 3", "\"version\": 2", 1);
    let error = read(&other).unwrap_err().to_string();
    assert!(error.ends_with(
        "report.json is a report of version 2, this program reads 3; \
         run the checks again, or use the actucheck that wrote it"
    ));
    assert!(matches!(
        read(&text.replacen("\"fail\"", "\"failed\"", 1)),
        Err(ReadError::Parse { .. })
    ));
    assert!(matches!(read("{}"), Err(ReadError::Parse { .. })));
    assert!(matches!(read::read(Path::new("/no/such/file")), Err(ReadError::Read { .. })));
}
