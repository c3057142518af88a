//! Random conversations find faults of the host, and none in the right one.

use std::process::Command;

use actucheck::adapter::Question;
use actucheck::suite::saved;

/// How long the right host waits, and how long the others do, in milliseconds.
const PATIENT: &str = "150";
const HASTY: &str = "30";
/// The most calls that are needed to show any of the faults.
const CALLS: usize = 2;

/// So many conversations find most faults.
const FEW: &str = "24";
/// So many find each.
const CASES: &str = "96";
/// The same on INNFOS, which has more commands.
const CASES_IN_DATAGRAMS: &str = "192";
/// So many find nothing in the right host on a port in memory, where nobody waits.
const MANY: &str = "10000";

/// Faults that are found.
pub(crate) const FOUND: [&str; 18] = [
    "no-stuffing",
    "action-to-all",
    "keeps-half",
    "no-drain",
    "late-answer-for-next",
    "chunks-not-joined",
    "gives-up-at-split",
    "ignores-crc",
    "no-unstuffing",
    "any-id",
    "echo-as-answer",
    "ignores-error",
    "cuts-to-length",
    "zero-on-timeout",
    "last-good-on-timeout",
    "sync-by-position",
    "missing-is-stale",
    "fast-unstuffs",
];

/// The same of the host on INNFOS.
pub(crate) const FOUND_IN_DATAGRAMS: [&str; 14] = [
    "sends-length-low-byte-first",
    "crc-high-byte-first",
    "no-crc-for-one-byte",
    "crc-without-data",
    "any-end",
    "fixed-size",
    "needs-no-crc",
    "any-address",
    "any-command",
    "silence-is-success",
    "cuts-to-size",
    "hands-on-low-byte-first",
    "last-good-on-timeout",
    "first-found",
];

/// What a run comes to: its exit status, what it says, and how many calls each finding has.
fn fuzz(fault: &str, limit: &str, port: &str, cases: &str) -> (Option<i32>, String, Vec<usize>) {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("findings.yaml");
    let output = Command::new(env!("CARGO_BIN_EXE_actucheck"))
        .args(["fuzz", "--host", "--timeout", "1", "--seed", "1", "--cases", cases])
        .args(["--wire", if port == "udp" { "innfos" } else { "dynamixel2" }])
        .arg("--out")
        .arg(&out)
        .arg("--")
        .arg(std::env::current_exe().unwrap())
        .args(["adapter", fault, limit, port])
        .output()
        .unwrap();
    let found = if out.is_file() { saved::read(&out).unwrap() } else { Vec::new() };
    let calls = found.iter().map(|check| match &check.question {
        Question::Converse { steps, .. } => steps.len(),
        other => panic!("{other}"),
    });
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    (output.status.code(), text, calls.collect())
}

/// What is wrong with the findings of a fault; empty if nothing is.
pub(crate) fn wrong(fault: &str, port: &str) -> String {
    let all = if port == "udp" { CASES_IN_DATAGRAMS } else { CASES };
    let mut wrong = String::new();
    for cases in [FEW, all] {
        let (status, text, calls) = fuzz(fault, HASTY, port, cases);
        if status == Some(1) && calls.iter().any(|calls| *calls <= CALLS) {
            return String::new();
        }
        wrong = format!("{status:?} {calls:?} {text}");
    }
    wrong
}

/// What is found in the right host on such a port; empty if nothing is.
pub(crate) fn right(port: &str) -> String {
    let cases = if port == "memory" { MANY } else { CASES };
    let (status, text, _) = fuzz("none", PATIENT, port, cases);
    if status == Some(0) && text.ends_with(": nothing found\n") { String::new() } else { text }
}
