//! Hosts on a line that plays a script: a right one, and some that are wrong in one way.

#![allow(clippy::unwrap_used, clippy::indexing_slicing)] // tests may stop at a surprise
#![cfg(unix)]

use std::process::{Command, Output};

use serde_json::Value;

const HOST: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/host/host.py");
const MEMORY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/host/memory.py");
const ON_KIT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/host/on_kit.py");
const KIT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/adapters/kit/python");

struct Run {
    output: Output,
    report: Value,
}

impl Run {
    fn total(&self, verdict: &str) -> u64 {
        self.report["totals"][verdict].as_u64().unwrap()
    }

    /// The ids of checks with this verdict, as far as the report names them.
    fn ids(&self, verdict: &str) -> Vec<&str> {
        let rows = self.report["not_passed"].as_array().unwrap().iter();
        let rows = rows.filter(|row| row["verdict"] == verdict);
        rows.flat_map(|row| row["smallest"].as_array().unwrap())
            .map(|check| check["id"].as_str().unwrap())
            .collect()
    }
}

/// Checks a host that is wrong in this way.
fn check(wrong: &str, options: &[&str]) -> Run {
    check_with(HOST, wrong, options)
}

/// The same with another adapter.
fn check_with(adapter: &str, wrong: &str, options: &[&str]) -> Run {
    let folder = tempfile::tempdir().unwrap();
    let report = folder.path().join("json");
    let output = asked(|program| {
        program.env("PYTHONPATH", KIT);
        program.args(["host", "--report", &format!("json={}", report.display())]);
        program.args(options).args(["--", "python3", adapter, wrong])
    });
    let report = std::fs::read_to_string(report).unwrap_or_default();
    Run { output, report: serde_json::from_str(&report).unwrap_or(Value::Null) }
}

/// Runs the program, again if a check could not be judged: a machine may be too busy for a host's limit,
/// but hardly so often.
fn asked(arguments: impl Fn(&mut Command) -> &mut Command) -> Output {
    const TRIES: usize = 4;
    let mut left = TRIES;
    loop {
        let mut program = Command::new(env!("CARGO_BIN_EXE_actucheck"));
        let run = arguments(&mut program).output().unwrap();
        left -= 1;
        if left == 0 || !String::from_utf8_lossy(&run.stdout).contains("not-run") {
            return run;
        }
    }
}

#[test]
fn a_right_host_passes() {
    for adapter in [HOST, ON_KIT] {
        let run = check_with(adapter, "right", &["--jobs", "2"]);
        let text = String::from_utf8_lossy(&run.output.stdout);
        assert_eq!(run.output.status.code(), Some(0), "{text}");
        assert!(run.total("pass") > 150, "{text}");
        assert_eq!(run.total("warn"), 0, "{text}");
        assert!(run.total("skip") > 10, "it has few calls: {text}");
    }
}

#[test]
fn a_wrong_host_is_found_by_a_check_of_its_fault() {
    for (wrong, id) in [
        ("no-stuffing", "dynamixel2.host.call.write.stuffed/sent"),
        ("no-crc", "dynamixel2.host.read.flip-13/result"),
        ("any-device", "dynamixel2.host.read.other-device/result"),
        ("no-drain", "dynamixel2.host.read.late/next"),
        ("waits-for-all", "dynamixel2.host.call.write.broadcast/result"),
    ] {
        for adapter in [HOST, ON_KIT] {
            let run = check_with(adapter, wrong, &["--select", id, "--select", "*.basic.*"]);
            assert_eq!(run.ids("fail"), [id], "{wrong}");
            assert_eq!(run.output.status.code(), Some(1), "{wrong}");
        }
    }
}

#[test]
fn the_port_in_memory_of_the_kit_keeps_its_time() {
    let test = concat!(env!("CARGO_MANIFEST_DIR"), "/adapters/kit/python/tests/test_memory.py");
    let output =
        Command::new("python3").env("PYTHONPATH", KIT).args(["-B", test]).output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && said.contains("Ran 5 tests"), "{said}");
}

/// One that asks again is right, but not one that does so without end.
#[test]
fn a_request_that_is_answered_is_not_sent_again_and_again() {
    let run = check("floods", &["--select", "*.basic.read/sent"]);
    assert_eq!(run.ids("fail"), ["dynamixel2.host.basic.read/sent"]);
}

/// A host that waits for ever is ended, and the run goes on.
#[test]
fn a_call_that_does_not_return_is_a_timeout() {
    let checks = ["--select", "*.read.cut-05/*", "--select", "*.basic.read/*"];
    let run = check("no-limit", &[&checks[..], &["--timeout", "0.5"]].concat());
    assert_eq!(run.total("timeout"), 2);
    assert_eq!(run.total("pass"), 2);
}

#[test]
fn an_adapter_without_a_port_is_no_host() {
    let run = check("no-port", &[]);
    assert_eq!(run.output.status.code(), Some(2));
    let said = String::from_utf8_lossy(&run.output.stderr);
    assert!(said.contains("no host to check"), "{said}");
    let run = check("opens-nothing", &["--select", "*.basic.read/*"]);
    assert_eq!((run.total("adapter-fault"), run.output.status.code()), (2, Some(3)));
}

#[test]
fn calls_that_hello_does_not_name_are_not_asked() {
    let run = check("no-reboot", &["--select", "*.basic.reboot/*"]);
    assert_eq!(run.total("skip"), 2);
}

/// Whatever an adapter says of its port in memory, there is a verdict.
#[test]
fn a_port_in_memory_may_be_made_up() {
    for (wrong, verdict) in [
        ("right", "pass"),
        ("negative-ms", "adapter-fault"),
        ("negative-at", "adapter-fault"),
        ("sent-after-the-end", "adapter-fault"),
        ("sent-backwards", "adapter-fault"),
        ("both", "adapter-fault"),
        ("neither", "adapter-fault"),
        ("no-time", "adapter-fault"),
        ("no-list", "adapter-fault"),
        ("capitals", "adapter-fault"),
        ("long-line", "adapter-fault"),
        ("long-ok", "adapter-fault"),
        ("err-alone", "adapter-fault"),
        ("floods", "fail"),
        ("an-hour", "timeout"),
        ("ages", "timeout"),
        ("exception", "fail"),
    ] {
        let run = check_with(MEMORY, wrong, &["--select", "*.basic.read/sent"]);
        let text = String::from_utf8_lossy(&run.output.stdout);
        assert_eq!(run.total(verdict), 1, "{wrong}: {text}");
    }
}

/// The check of an adapter finds what is wrong with its ports before a run does.
#[test]
fn the_check_of_an_adapter_looks_at_its_ports() {
    for (wrong, point) in [
        ("right", ""),
        ("no-time", "makes a call through a port in memory"),
        ("takes-any-call", "skips a call that it does not know through a port in memory"),
        ("always-open", "opens and closes a port in memory as it is told"),
        ("closes-once", "opens and closes a port in memory as it is told"),
    ] {
        let output = Command::new(env!("CARGO_BIN_EXE_actucheck"))
            .args(["adapter", "check", "--", "python3", MEMORY, wrong])
            .output()
            .unwrap();
        let text = String::from_utf8_lossy(&output.stdout);
        let found = text.lines().find_map(|line| line.strip_prefix("  WRONG  "));
        let found = found.and_then(|line| line.split(':').next()).unwrap_or_default();
        assert_eq!(found, point, "{wrong}: {text}");
    }
}

/// The report shows the conversation, and the line that asks it again.
#[test]
fn a_conversation_is_shown_in_rows_and_can_be_replayed() {
    let id = "dynamixel2.host.read.late/next";
    let run = check("no-drain", &["--select", id, "-v"]);
    let text = String::from_utf8_lossy(&run.output.stdout).into_owned();
    for row in [
        "  call      read of device 1: address 132, length 4\n",
        "  sent      FF FF FD 00 01 07 00 02 84 00 04 00 1D 15 at ",
        "  returned  an error (timeout: ) after ",
        "  late      FF FF FD 00 01 08 00 55 00 A6 01 02 83 91 4F\n",
        "  call      read of device 1: address 140, length 4\n",
        "but must return device 1: data 1728394a\n",
    ] {
        assert!(text.contains(row), "{row:?} is not in\n{text}");
    }
    let replayed = asked(|program| program.args(["replay", id, "--", "python3", HOST, "no-drain"]));
    let text = String::from_utf8_lossy(&replayed.stdout).into_owned();
    assert_eq!(replayed.status.code(), Some(1), "{text}");
}

#[test]
fn a_host_may_open_its_port_over_tcp() {
    let checks = ["--select", "*.basic.*", "--select", "*.read.late/*", "--port", "tcp"];
    let run = check("right", &checks);
    assert_eq!(
        run.output.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&run.output.stdout)
    );
    assert!(run.total("pass") > 5);
    let run = check("no-drain", &checks);
    assert_eq!(run.ids("fail"), ["dynamixel2.host.read.late/next"]);
    let replay = "replay    actucheck replay dynamixel2.host.read.late/next --port tcp -- python3 ";
    let text = String::from_utf8_lossy(&run.output.stdout);
    assert!(text.contains(replay), "{text}");
}

/// The second reading of the document opens a UDP port.
#[test]
fn a_host_that_sends_datagrams_is_checked_too() {
    let adapter = concat!(env!("CARGO_MANIFEST_DIR"), "/adapters/innfos-python/run");
    let select = ["--select", "innfos.host.basic.*", "--select", "innfos.host.query.two/*"];
    let checked = [&["host", "--jobs", "2"], &select[..]].concat();
    for (arguments, says) in [
        (&["adapter", "check"][..], "ok     opens and closes a port as it is told"),
        (&checked, "passed  172 pass"),
    ] {
        let output = Command::new(env!("CARGO_BIN_EXE_actucheck"))
            .args(arguments)
            .args(["--", adapter])
            .output()
            .unwrap();
        let text = String::from_utf8_lossy(&output.stdout);
        assert_eq!(output.status.code(), Some(0), "{text}");
        assert!(text.contains(says), "{text}");
    }
}
