//! The adapter protocol in words and as schemas: both say what is really exchanged.

use std::collections::BTreeSet;
use std::process::Command;

use actucheck::adapter::{Question, Request, VERSIONS, Wire, schema};
use actucheck::subject::{Answer, Builtin, Subject as _};
use actucheck::suite::{self, Options};
use actucheck_spec::Spec;
use actucheck_spec::wire::Packet;
use jsonschema::Validator;
use serde_json::{Value, json};

use super::WELL_BEHAVED;

const GUIDE: &str = include_str!("../../adapters/GUIDE.md");

fn validator(schema: &str) -> Validator {
    jsonschema::validator_for(&serde_json::from_str(schema).unwrap()).unwrap()
}

fn assert_fits(validator: &Validator, line: &str) {
    let value: Value = serde_json::from_str(line).unwrap();
    let faults: Vec<_> = validator.iter_errors(&value).map(|fault| fault.to_string()).collect();
    assert!(faults.is_empty(), "{line}\n{}", faults.join("\n"));
}

#[test]
fn what_is_exchanged_fits_the_schemas() {
    let folder = tempfile::tempdir().unwrap();
    let trace = folder.path().join("trace");
    let script = WELL_BEHAVED.replace(r#""protocol":1"#, r#""protocol":2,"roles":["host"]"#);
    let answer = r#"printf '{"id":%s,"err":{"class":"unspecified","detail":"no"}}\n' "$id""#;
    Command::new(env!("CARGO_BIN_EXE_actucheck"))
        .args(["codec", "--select", "ja40.*/*", "--trace", trace.to_str().unwrap()])
        .args(["--", "sh", "-c", &script.replace("ANSWER", answer)])
        .output()
        .unwrap();
    let trace = std::fs::read_to_string(trace).unwrap();
    let (request, reply) = (validator(&schema::request()), validator(&schema::reply()));
    let mut counts = (0, 0);
    for line in trace.lines() {
        if let Some(line) = line.strip_prefix("1> ") {
            assert_fits(&request, line);
            counts.0 += 1;
        } else if let Some(line) = line.strip_prefix("1< ") {
            assert_fits(&reply, line);
            counts.1 += 1;
        }
    }
    assert!(counts.0 > 50 && counts.1 == counts.0 - 1, "{counts:?}: bye has no reply");
}

#[test]
fn every_kind_of_question_and_answer_fits_the_schemas() {
    let (request, reply) = (validator(&schema::request()), validator(&schema::reply()));
    let spec = Spec::embedded().unwrap();
    let plan =
        suite::plan(&spec, &Wire::ALL, &Options { cases: 10, ..Options::new() }.with_bodies(0));
    let (mut builtin, mut ops) = (Builtin::default(), BTreeSet::new());
    for (number, check) in plan.checks().enumerate().filter(|(number, _)| number % 17 == 0) {
        let question = &check.question;
        let text = Request::Ask(question).in_version(3);
        assert_fits(&request, &format!("{{\"id\":{number},{}", text.strip_prefix('{').unwrap()));
        if let Answer::Ok(output) = builtin.ask(question) {
            assert_fits(&reply, &json!({ "id": number, "ok": output }).to_string());
            ops.insert(question.name());
        }
    }
    let all = builtin.hello().ops.iter().map(String::as_str).collect();
    assert_eq!(ops, all);
    for line in [
        r#"{"id":1,"ok":{"crc":1},"skip":{"reason":"no"}}"#,
        r#"{"id":1,"ok":{"crc":"89ca"}}"#,
        r#"{"id":1,"ok":{"bytes":"0g"}}"#,
        r#"{"id":1,"err":{"class":"bad"}}"#,
        r#"{"id":1,"skip":{}}"#,
        r#"{"ok":{"crc":1}}"#,
        r#"{"id":1}"#,
    ] {
        let value = serde_json::from_str(line).unwrap();
        assert!(!reply.is_valid(&value), "{line}");
    }
}

/// The lines of the JSON examples in the guide that have this field.
fn with(field: &'static str) -> impl Iterator<Item = Value> {
    let blocks = GUIDE.split("```json\n").skip(1).filter_map(|rest| rest.split("```").next());
    let lines = blocks.flat_map(str::lines);
    let values = lines.map(|line| serde_json::from_str::<Value>(line).unwrap());
    values.filter(move |line| !line[field].is_null())
}

#[test]
fn the_guide_is_printed() {
    let output = Command::new(env!("CARGO_BIN_EXE_actucheck")).args(["adapter", "guide"]).output();
    assert_eq!(String::from_utf8(output.unwrap().stdout).unwrap(), GUIDE);
}

#[test]
fn the_guides_examples_are_right() {
    let (request, reply) = (validator(&schema::request()), validator(&schema::reply()));
    let replies: Vec<_> = with("ok").chain(with("err")).chain(with("skip")).collect();
    for line in with("op") {
        assert_fits(&request, &line.to_string());
        let of_a_library = ["hello", "open", "call", "exchange", "close", "device", "bye"];
        if of_a_library.iter().any(|op| line["op"] == *op) {
            continue;
        }
        let question: Question = serde_json::from_value(line.clone()).unwrap();
        let said = replies.iter().find(|reply| reply["id"] == line["id"]).unwrap();
        match Builtin::default().ask(&question) {
            Answer::Ok(output) if said["skip"].is_null() => assert_eq!(json!(output), said["ok"]),
            Answer::Rejected(rejection) => {
                assert_eq!(json!(rejection.class), said["err"]["class"]);
            }
            _ => assert!(!said["skip"].is_null(), "{said}"),
        }
    }
    let hello = with("op").find(|line| line["op"] == "hello").unwrap();
    assert_eq!(hello["protocol"], json!(VERSIONS));
    for line in &replies {
        assert_fits(&reply, &line.to_string());
    }

    let misfit = json!({ "kind": "instruction", "id": 1, "instruction": 3, "params": "34" });
    let general: Vec<_> = with("kind")
        .chain([misfit])
        .map(|packet| serde_json::from_value::<Packet>(packet).unwrap())
        .filter_map(|packet| packet.wire().call(&packet).filter(|call| call.is_general))
        .map(|call| json!(call))
        .collect();
    let calls: Vec<_> = with("name").collect();
    assert_eq!(calls.len(), 5);
    assert!(calls.iter().all(|call| general.contains(call)), "{general:?}");
}

#[test]
fn the_guide_names_every_op_and_every_error_class() {
    let reply: Value = serde_json::from_str(&schema::reply()).unwrap();
    let ops = reply.pointer("/$defs/Greeting/properties/ops/items/enum").unwrap();
    for op in ops.as_array().unwrap() {
        assert!(GUIDE.contains(&format!("| `{}` |", op.as_str().unwrap())), "{op}");
    }
    let classes = ["Fault", "Trouble"].map(|kind| reply.pointer(&format!("/$defs/{kind}/oneOf")));
    for class in classes.iter().flat_map(|classes| classes.unwrap().as_array().unwrap()) {
        assert!(GUIDE.contains(&format!("`{}`", class["const"].as_str().unwrap())), "{class}");
    }
    for wire in Wire::ALL {
        assert!(GUIDE.contains(&format!("`{wire}`")), "{wire}");
    }
}
