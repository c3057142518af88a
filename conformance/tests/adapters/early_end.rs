//! Runs that end early, and their reports.

use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::Value;

use super::{WELL_BEHAVED, check_with};

const WRONG: &str = r#"printf '{"id":%s,"ok":{"crc":1}}\n' "$id""#;

#[test]
fn a_run_ends_after_so_many_failures() {
    let run = check_with(&["--max-fail", "3"], &WELL_BEHAVED.replace("ANSWER", WRONG));
    assert_eq!((run.exit(), run.total("fail")), (1, 3));
    assert_eq!(run.report["stopped"], "max-fail");
    assert!(run.report["left"].as_u64().unwrap() > 0);
}

#[test]
fn expected_failures_do_not_count_towards_the_end() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("expected.yaml");
    std::fs::write(&file, "expected_failures: [{ids: ['*/crc'], reason: no CRC}]").unwrap();
    let options = ["--max-fail", "1", "--expect", file.to_str().unwrap()];
    let run = check_with(&options, &WELL_BEHAVED.replace("ANSWER", WRONG));
    assert_eq!((run.exit(), run.total("expected-failure")), (0, run.sum()));
    assert!(run.report["stopped"].is_null(), "{}", run.report["stopped"]);
}

/// Answers every CRC with that of a Ping to device 1, which is right for a few packets.
#[test]
fn two_rows_may_name_the_same_failures() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("expected.yaml");
    let row = "{ids: ['*/crc'], reason: no CRC}";
    std::fs::write(&file, format!("expected_failures: [{row}, {row}]")).unwrap();
    let constant = WRONG.replace(r#""crc":1"#, r#""crc":19993"#);
    let options = ["--expect", file.to_str().unwrap()];
    let run = check_with(&options, &WELL_BEHAVED.replace("ANSWER", &constant));
    assert!(run.total("pass") > 0 && run.total("expected-failure") > 0, "{:?}", run.report);
    assert_eq!((run.exit(), run.total("unexpected-pass")), (0, 0));
}

#[test]
fn ctrl_c_ends_a_run_with_a_report() {
    let folder = tempfile::tempdir().unwrap();
    let report = folder.path().join("report.json");
    let asked = folder.path().join("asked");
    let answer = format!("echo >>{}; sleep 0.1; {WRONG}", asked.display());
    let script = WELL_BEHAVED.replace("ANSWER", &answer);
    let child = Command::new(env!("CARGO_BIN_EXE_actucheck"))
        .args(["codec", "--select", "*/crc", "--report", &format!("json={}", report.display())])
        .args(["--", "sh", "-c", &script])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let patience = Instant::now() + Duration::from_secs(20);
    while std::fs::read(&asked).map_or(0, |lines| lines.len()) < 3 {
        assert!(Instant::now() < patience, "nothing was asked");
        std::thread::sleep(Duration::from_millis(20));
    }
    let interrupted = Instant::now();
    let pid = child.id().to_string();
    assert!(Command::new("kill").args(["-INT", &pid]).status().unwrap().success());
    let output = child.wait_with_output().unwrap();
    assert!(interrupted.elapsed() < Duration::from_secs(5), "{:?}", interrupted.elapsed());
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let report: Value = serde_json::from_str(&std::fs::read_to_string(report).unwrap()).unwrap();
    assert_eq!(report["stopped"], "interrupted", "{text}");
    assert!(report["totals"]["fail"].as_u64().unwrap() > 0, "{text}");
    assert_eq!(output.status.code(), Some(1), "what failed still counts");
}

#[test]
fn a_trace_has_every_line_in_both_directions() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("trace");
    let options = ["--trace", file.to_str().unwrap(), "--max-fail", "1"];
    check_with(&options, &WELL_BEHAVED.replace("ANSWER", WRONG));
    let trace = std::fs::read_to_string(file).unwrap();
    let starts: Vec<_> = trace.lines().map(|line| line.get(..11).unwrap()).collect();
    let expected = [
        r#"1> {"id":0,"#,
        r#"1< {"id":0,"#,
        r#"1> {"id":1,"#,
        r#"1< {"id":1,"#,
        r#"1> {"id":2,"#,
        r#"1< {"id":2,"#,
        // What failed is asked again in another process.
        r#"0> {"id":0,"#,
        r#"0< {"id":0,"#,
        r#"0> {"id":1,"#,
        r#"0< {"id":1,"#,
        r#"0> {"id":2,"#,
        r#"1> {"id":3,"#,
    ];
    assert_eq!(starts, expected);
    assert!(trace.ends_with("\"op\":\"bye\"}\n"), "{trace}");
}
