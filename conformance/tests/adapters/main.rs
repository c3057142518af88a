//! Right and wrong behaviour of adapters, and the result of a run.

#![allow(clippy::unwrap_used, clippy::indexing_slicing)] // tests may stop at a surprise
#![cfg(unix)]

mod adapter_check;
mod again;
mod alike;
mod bounded;
mod contract;
mod early_end;
mod expected;
mod fuzzing;
mod hostile;
mod libraries;
mod misbehaving;
mod sanitizer;
mod several;
mod templates;

use std::process::{Command, Output};
use std::time::{Duration, Instant};

use serde_json::Value;

/// Answers `hello`, then runs `ANSWER` for every request, in which `$id` is the request's id. It
/// starts no other program, of which thousands would take long.
const WELL_BEHAVED: &str = r#"
while read -r line; do
    id=${line#'{"id":'} id=${id%%,*}
    case $line in
        *'"op":"hello"'*)
            printf '{"id":%s,"ok":{"protocol":1,"implementation":{"name":"fake","version":"1","language":"sh"},"wires":["dynamixel2"],"ops":["crc","decode"]}}\n' "$id" ;;
        *'"op":"no-such-op"'*) printf '{"id":%s,"skip":{"reason":"unknown"}}\n' "$id" ;;
        *'"op":"bye"'*) exit ;;
        *) ANSWER ;;
    esac
done
"#;

struct Run {
    output: Output,
    report: Value,
    /// Every outcome.
    outcomes: Vec<Value>,
    took: Duration,
}

impl Run {
    fn exit(&self) -> i32 {
        self.output.status.code().unwrap()
    }

    fn stderr(&self) -> String {
        String::from_utf8_lossy(&self.output.stderr).into_owned()
    }

    fn total(&self, verdict: &str) -> u64 {
        self.report["totals"][verdict].as_u64().unwrap()
    }

    /// All checks.
    fn sum(&self) -> u64 {
        self.report["totals"].as_object().unwrap().values().filter_map(Value::as_u64).sum()
    }

    fn requirements(&self) -> u64 {
        self.report["requirements"].as_array().unwrap().len().try_into().unwrap()
    }

    fn detail(&self, verdict: &str) -> String {
        let outcome = self.outcomes.iter().find(|outcome| outcome["verdict"] == verdict).unwrap();
        outcome["detail"].as_str().unwrap().to_owned()
    }
}

/// Runs the crc checks against a shell script.
fn check(script: &str) -> Run {
    check_with(&[], script)
}

/// The same with more options.
fn check_with(options: &[&str], script: &str) -> Run {
    let folder = tempfile::tempdir().unwrap();
    let (report, outcomes) = (folder.path().join("json"), folder.path().join("jsonl"));
    let started = Instant::now();
    let output = Command::new(env!("CARGO_BIN_EXE_actucheck"))
        .args(["codec", "--select", "ja40.*/crc", "--timeout", "0.3", "--start-timeout", "5"])
        .args(options)
        .arg(format!("--report=json={}", report.display()))
        .arg(format!("--report=jsonl={}", outcomes.display()))
        .args(["--", "sh", "-c", script])
        .output()
        .unwrap();
    let took = started.elapsed();
    let report = std::fs::read_to_string(report).unwrap_or_default();
    let report = serde_json::from_str(&report).unwrap_or(Value::Null);
    let lines = std::fs::read_to_string(outcomes).unwrap_or_default();
    let lines = lines.lines().map(|line| serde_json::from_str(line).unwrap());
    let outcomes = lines.filter(|line: &Value| line["line"] == "check").collect();
    Run { output, report, outcomes, took }
}

fn answering(answer: &str) -> Run {
    check(&WELL_BEHAVED.replace("ANSWER", answer))
}
