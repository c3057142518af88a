//! A library's class of a device behind an adapter: a right one, and some that are wrong in one way.

#![allow(clippy::unwrap_used, clippy::indexing_slicing)] // tests may stop at a surprise
#![cfg(unix)]

use std::fs;
use std::process::{Command, Output};

use serde_json::{Value, json};

const SLAVE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/slave/slave.py");
const KEEPING: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/slave/keeping.py");
const TABLE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/slave/servo.yaml");
const KIT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/adapters/kit/python");

/// Runs the program on the adapter, which is wrong in this way.
fn run(arguments: &[&str], wrong: &str) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_actucheck"));
    command.env("PYTHONPATH", KIT).args(arguments).args(["--", "python3", SLAVE, wrong]);
    command.output().unwrap()
}

/// The exit status of a run, its report, and what it says on standard error.
fn check(wrong: &str, options: &[&str]) -> (Option<i32>, Value, String) {
    let json = ["device", "--adapter", "--report", "json=-"];
    let output = run(&[&json, options].concat(), wrong);
    let report = serde_json::from_slice(&output.stdout).unwrap_or(Value::Null);
    (output.status.code(), report, String::from_utf8_lossy(&output.stderr).into_owned())
}

#[test]
fn a_right_one_passes_and_no_time_is_awaited() {
    let (status, report, said) = check("right", &[]);
    assert_eq!(status, Some(0), "{report}\n{said}");
    assert!(report["totals"]["pass"].as_u64().unwrap() > 60, "{report}");
    assert_eq!(report["implementation"]["name"], "servo");
    // It is called, and answers at once: that is no time of a device.
    let traffic = &report["traffic"];
    assert!(
        traffic["pieces"].as_u64().unwrap() > 100 && traffic["response"].is_null(),
        "{traffic}"
    );
    assert!(report["seconds"].as_f64().unwrap() < 10.0, "{report}");
}

#[test]
fn a_wrong_one_is_found_by_a_check_of_its_fault() {
    for (wrong, id, verdict) in [
        ("takes-damaged", "dynamixel2.device.damaged.byte-9.bit-0/ignored", "fail"),
        ("hears-all", "dynamixel2.device.addressee.other-id.ping/silence", "fail"),
        ("impatient", "dynamixel2.device.stream.byte-by-byte/heard", "fail"),
        ("raises", "dynamixel2.device.refused.instruction-40/answer", "crash"),
    ] {
        let (_, right, _) = check("right", &["--select", id]);
        assert_eq!(right["totals"]["pass"], 1, "{id}: {right}");
        let (status, report, said) = check(wrong, &["--select", id]);
        assert_eq!(
            (status, &report["totals"][verdict]),
            (Some(1), &Value::from(1)),
            "{wrong}: {report}\n{said}"
        );
        let replay = report["not_passed"][0]["smallest"][0]["replay"].as_str().unwrap();
        assert!(
            replay.starts_with("actucheck device --adapter ") && replay.contains(id),
            "{replay}"
        );
    }
}

#[test]
fn one_that_does_not_answer_right_or_ends_is_told_in_a_sentence() {
    let (status, _, said) = check("big-endian-crc", &[]);
    assert!(status == Some(4) && said.contains("nothing answers"), "{said}");
    let (status, report, said) = check("ends", &[]);
    assert!(status == Some(4) && said.contains("it said `out of order`"), "{said}");
    assert!(report["totals"]["pass"].as_u64().unwrap() > 0, "{report}");
    let (status, _, said) = check("none", &[]);
    assert!(status == Some(2) && said.contains("plays no device"), "{said}");
}

#[test]
fn the_check_of_adapters_has_a_point_for_it() {
    let output = run(&["adapter", "check"], "right");
    let said = String::from_utf8_lossy(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{said}");
    assert!(said.contains("answers bytes as a device on dynamixel2"), "{said}");
    let raising = run(&["adapter", "check"], "raises");
    assert_eq!(raising.status.code(), Some(0), "a library's exception is no fault of the adapter");
}

/// Checks a device that is written to: the exit status, the report, and what is said. Whatever came of it, it holds at its end what it held.
fn written(wrong: &str, options: &[&str]) -> (Option<i32>, Value, String) {
    let folder = tempfile::tempdir().unwrap();
    let [table, journal] = ["table", "journal"].map(|name| folder.path().join(name));
    let mut command = Command::new(env!("CARGO_BIN_EXE_actucheck"));
    command.env("PYTHONPATH", KIT).args(["device", "--device", TABLE, "--allow", "write-ram"]);
    command.args(["--adapter", "--report", "json=-", "--journal"]).arg(&journal).args(options);
    let output = command.args(["--", "python3", KEEPING, wrong]).arg(&table).output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(said.contains("the device holds what it held before") && !journal.exists(), "{said}");
    let held: Value = serde_json::from_slice(&fs::read(table).unwrap()).unwrap();
    let before = json!({"0": 0x7777, "6": 3, "7": 1, "64": 0, "65": 1, "76": 1234, "78": 4321});
    assert_eq!(held, before, "{wrong} is not restored");
    (output.status.code(), serde_json::from_slice(&output.stdout).unwrap(), said)
}

#[test]
fn one_that_is_written_to_is_restored() {
    let (status, report, said) = written("right", &[]);
    assert_eq!(status, Some(0), "{report}\n{said}");
    let some = ["--select", "*.written.*", "--select", "*.range.*"];
    let (status, report, said) = written("right", &some);
    assert!(status == Some(0) && report["totals"]["pass"].as_u64().unwrap() >= 6, "{report}{said}");
    let (status, report, _) = written("clamps", &["--select", "*.written.p-gain/kept"]);
    assert_eq!((status, &report["totals"]["fail"]), (Some(1), &json!(1)), "{report}");
    // Its library fails in the middle of a check; the next one begins with what it held.
    let both = ["--select", "*.written.led/kept", "--select", "*.range.*"];
    let (status, report, _) = written("raises-at-0", &both);
    assert_eq!((status, &report["totals"]["crash"]), (Some(1), &json!(1)), "{report}");
    assert!(report["totals"]["pass"].as_u64().unwrap() > 0, "{report}");
}
