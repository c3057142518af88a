//! Runs the program against a device with a fault, and looks at what it finds.

use std::process::Command;

use serde_json::Value;

use super::fault::Fault;

/// All that a run may do.
const ALL: &str = "write-ram,eeprom,reboot,reset,motion";

/// The verdicts of a run by check, and its exit status.
pub(crate) struct Run {
    pub(crate) status: Option<i32>,
    pub(crate) verdicts: Vec<(String, String)>,
    pub(crate) text: String,
}

/// Checks a device at a port, or as a command. Everything is allowed.
pub(crate) fn run(arguments: &[&str]) -> Run {
    let folder = tempfile::tempdir().unwrap();
    let journal = folder.path().join("journal");
    let mut command = Command::new(env!("CARGO_BIN_EXE_actucheck"));
    command.args(["device", "--report", "jsonl=-", "--allow", ALL, "--journal"]).arg(&journal);
    let output = command.args(arguments).output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let lines = text.lines().filter_map(|line| serde_json::from_str::<Value>(line).ok());
    let verdict = |line: Value| {
        let field = |name: &str| line[name].as_str().map(str::to_owned);
        Some((field("id")?, field("verdict")?))
    };
    let verdicts = lines.filter_map(verdict).collect();
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    Run { status: output.status.code(), verdicts, text: errors }
}

/// What is wrong about the run against the firmware with this fault; empty if it is found.
pub(crate) fn wrong(fault: &Fault) -> String {
    let wire = fault.wire();
    let found_by = format!("{wire}.device.{}", fault.found_by);
    let own = std::env::current_exe().unwrap();
    let own = own.to_str().unwrap();
    let (device, _) = fault.devices.split_once('@').unwrap();
    let known = if wire == "innfos" { ["--wire", wire] } else { ["--device", device] };
    let has_neighbour = fault.devices.contains(' ');
    let neighbour = if has_neighbour { &["--neighbour", "2"][..] } else { &[] };
    let select = |id: &str, name: &str| {
        let firmware = ["--", own, "firmware", fault.devices, name];
        run(&[&known[..], neighbour, &["--select", id], &firmware].concat())
    };
    let verdict = |run: &Run| run.verdicts.first().map(|(_, verdict)| verdict.clone());
    let right = select(&found_by, "none");
    if verdict(&right).as_deref() != Some("pass") {
        return format!("without a fault {found_by} is {:?}\n{}", verdict(&right), right.text);
    }
    let faulty = select(&found_by, fault.name);
    match verdict(&faulty).as_deref() {
        Some("fail") if faulty.status == Some(1) => String::new(),
        other => format!("{found_by} is {other:?}, {:?}\n{}", faulty.status, faulty.text),
    }
}
