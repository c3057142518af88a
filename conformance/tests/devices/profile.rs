//! What is recorded of devices where the documents leave something unspecified: two that differ show it.

use std::process::Command;

use serde_json::Value;

use super::change::with_params;
use super::code::WRITE;
use super::fault::{Fault, hearing};
use super::right::Test;

/// The tests. Each returns what is wrong.
pub(crate) const TESTS: [Test; 3] = [
    ("of_a_write_of_several_registers", || {
        let all = "answers without an error; then holds what was written";
        of("ja40", "none", "length.*-registers", &[all, all])
    }),
    ("of_a_write_of_one_register", || {
        let part = |all| {
            format!(
                "answers without an error; then holds the first 2 of {all} bytes that were written"
            )
        };
        of("ja40", ONE_REGISTER, "length.*-registers", &[&part(4), &part(12)])
    }),
    ("of_a_second_reg_write", || {
        let last = "answers without an error; then holds what was written last";
        of("xm430-w210", "none", "registered.again", &[last])
    }),
];

const ONE_REGISTER: &str = "one-register-a-write";

/// Firmware that is not wrong where it differs.
pub(crate) const FAULTS: &[Fault] =
    &[hearing(ONE_REGISTER, "writes the first register of several", "", |heard| {
        with_params(heard, WRITE, |params| {
            if params.len() > 6 || params.len() == 6 && params[..2] == 522_u16.to_le_bytes() {
                params.truncate(4);
            }
        })
    })];

/// What these checks record of firmware.
fn of(device: &str, fault: &str, checks: &str, answers: &[&str]) -> String {
    let own = std::env::current_exe().unwrap();
    let folder = tempfile::tempdir().unwrap();
    let mut run = Command::new(env!("CARGO_BIN_EXE_actucheck"));
    run.args(["device", "--device", device, "--allow", "write-ram", "--report", "jsonl=-"]);
    run.arg("--journal").arg(folder.path().join("journal"));
    run.args(["--select", &format!("*.device.{checks}/answer"), "--"]);
    let output = run.arg(own).args(["firmware", &format!("{device}@1"), fault]).output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let lines = text.lines().filter_map(|line| serde_json::from_str::<Value>(line).ok());
    let told = lines.filter_map(|line| Some(line["behaviour"]["answer"].as_str()?.to_owned()));
    let told: Vec<_> = told.collect();
    if output.status.success() && told == answers {
        String::new()
    } else {
        format!("{told:?}: {output:?}")
    }
}
