//! Each fault is found by the check that its row names, and a right host by none.

use std::process::Command;

use serde_json::Value;

use super::faults::{Judged, Row};

/// How long the right host waits when all is asked of it, in milliseconds: so long that a busy machine
/// is no fault of it.
const PATIENT: &str = "150";
/// How long the others wait: what they get wrong may show only when they wait no longer.
const HASTY: &str = "30";

/// What a run comes to: its exit status, and the verdicts that are no pass.
struct Run {
    status: Option<i32>,
    verdicts: Vec<String>,
    text: String,
}

/// Checks the host with a fault by some checks.
fn run(port: &str, fault: &str, limit: &str, options: &[&str]) -> Run {
    let own = std::env::current_exe().unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_actucheck"))
        .args(["host", "--timeout", "1", "--report", "jsonl=-", "-q"])
        .args(options)
        .arg("--")
        .arg(own)
        .args(["adapter", fault, limit, port])
        .output()
        .unwrap();
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let lines = text.lines().filter_map(|line| serde_json::from_str::<Value>(line).ok());
    let verdicts = lines.filter_map(|line| Some(line["verdict"].as_str()?.to_owned()));
    let verdicts = verdicts.filter(|verdict| !["pass", "recorded"].contains(&verdict.as_str()));
    Run { status: output.status.code(), verdicts: verdicts.collect(), text }
}

/// What is wrong with the judgement of a fault of a host on such a port; empty if nothing is.
pub(crate) fn wrong<F>(wire: &str, port: &str, row: &Row<F>) -> String {
    let (check, expected, failures) = match row.judged {
        // On a busy machine a fault may show once: then it is found, and told as flaky.
        Judged::Fails(check) => (check, 1, &["fail", "timeout", "crash", "flaky"][..]),
        Judged::Warns(check) => (check, 0, &["warn"][..]),
        Judged::Unfit(point) => return unfit(port, row.name, point),
        Judged::Recorded | Judged::Passes => ("basic.*", 0, &[][..]),
    };
    let id = format!("{wire}.host.{check}");
    let run = run(port, row.name, HASTY, &["--select", &id]);
    let is_found = run.verdicts.iter().any(|verdict| failures.contains(&verdict.as_str()));
    let is_right = run.status == Some(expected) && (is_found || failures.is_empty());
    if is_right { String::new() } else { format!("{:?}: {}", run.status, run.text) }
}

/// What the check of adapters says of the host with a fault: whether it is well, and what it says.
fn check(port: &str, fault: &str) -> (bool, String) {
    let own = std::env::current_exe().unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_actucheck"))
        .args(["adapter", "check", "--"])
        .arg(own)
        .args(["adapter", fault, HASTY, port])
        .output()
        .unwrap();
    (output.status.success(), String::from_utf8_lossy(&output.stdout).into_owned())
}

/// What it says of the right host's; empty if it is well.
pub(crate) fn well(port: &str) -> String {
    let (is_well, text) = check(port, "none");
    if is_well { String::new() } else { text }
}

/// What it says if this point is not the only one that is wrong.
fn unfit(port: &str, fault: &str, point: &str) -> String {
    let (is_well, text) = check(port, fault);
    let mut wrong = text.lines().filter_map(|line| line.strip_prefix("  WRONG  "));
    let is_found = wrong.next().is_some_and(|line| line.starts_with(point));
    if !is_well && is_found && wrong.next().is_none() { String::new() } else { text }
}

/// What is said of the right host on such a port; empty if nothing is.
pub(crate) fn right(port: &str) -> String {
    // Most of the time is waited.
    let run = run(port, "none", PATIENT, &["--jobs", "6"]);
    let is_right = run.status == Some(0) && run.verdicts.is_empty();
    if is_right { String::new() } else { format!("{:?} {:?}", run.status, run.verdicts) }
}
