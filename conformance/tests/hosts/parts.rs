//! The parts of a run on a host, merged, are the whole run; so are those of a seed's conversations.

use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

/// How many parts there are.
const PARTS: u32 = 4;

/// A right host, and one whose failures are charged to basic checks.
pub(crate) const SHARED: [&str; 2] = ["none", "no-stuffing"];

/// Runs the program in a folder, with the adapter of a host on a port in memory.
fn run(folder: &Path, fault: &str, arguments: &[&str]) -> (Option<i32>, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_actucheck"))
        .current_dir(folder)
        .args(arguments)
        .arg("--")
        .arg(std::env::current_exe().unwrap())
        .args(["adapter", fault, "30", "memory"])
        .output()
        .unwrap();
    (output.status.code(), String::from_utf8_lossy(&output.stdout).into_owned())
}

/// A report without what is by nature another one.
fn timeless(path: &Path) -> Value {
    let mut report: Value = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
    for field in ["seconds", "date", "command_line"] {
        report[field].take();
    }
    report
}

/// What is wrong with the parts of a run on the host with a fault; empty if nothing is.
pub(crate) fn wrong(fault: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    let host = ["host", "--wire", "dynamixel2", "-q", "--report"];
    let (status, _) = run(path, fault, &[&host[..], &["json=whole"]].concat());
    let mut parts = Vec::new();
    for number in 1..=PARTS {
        let (part, file) = (format!("{number}/{PARTS}"), format!("part-{number}"));
        let report = format!("json={file}");
        run(path, fault, &[&host[..], &[&report, "--partition", &part]].concat());
        parts.push(file);
    }
    let merged = Command::new(env!("CARGO_BIN_EXE_actucheck"))
        .current_dir(path)
        .args(["report", "merge", "-q", "--report=json=merged"])
        .args(parts)
        .output()
        .unwrap();
    let is_failed = status == Some(i32::from(fault != "none"));
    if !is_failed || merged.status.code() != status {
        return format!("{status:?}, {merged:?}");
    }
    let [merged, whole] = ["merged", "whole"].map(|name| timeless(&path.join(name)));
    if merged == whole { String::new() } else { format!("{merged:#}\n---\n{whole:#}") }
}

/// What is wrong with the parts of a seed's conversations; empty if nothing is.
pub(crate) fn wrong_conversations() -> String {
    let folder = tempfile::tempdir().unwrap();
    let fuzz = ["fuzz", "--host", "--seed=3", "--cases=96", "-q"];
    let asked = |part: &[&str]| {
        let (status, text) = run(folder.path(), "none", &[&fuzz[..], part].concat());
        let count = text.split(' ').next().and_then(|count| count.parse::<u32>().ok());
        count.filter(|_| status == Some(0)).ok_or(text)
    };
    let parts = ["1/2", "2/2"].map(|part| asked(&["--partition", part]));
    match (asked(&[]), parts) {
        (Ok(96), [Ok(one), Ok(other)]) if one + other == 96 && one.min(other) > 20 => String::new(),
        other => format!("{other:?}"),
    }
}
