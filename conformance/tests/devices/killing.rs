//! Runs the program against a device with a fault, and looks at what it finds.

use std::collections::{BTreeMap, BTreeSet};
use std::process::Command;
use std::sync::{Arc, Mutex, OnceLock};

use serde_json::Value;

use super::every;
use super::fault::Fault;

/// All that a run may do.
const ALL: &str = "write-ram,eeprom,reboot,reset,backup,motion";

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
    let found_by = fault.check();
    if verdicts_without_fault(fault.devices).get(&found_by).map(String::as_str) != Some("pass") {
        // The machine may have been busy.
        let right = select(fault, &[&found_by], "none");
        let verdict = right.verdicts.first().map(|(_, verdict)| verdict.as_str());
        if verdict != Some("pass") {
            return format!("without a fault {found_by} is {verdict:?}\n{}", right.text);
        }
    }
    let faulty = select(fault, &[&found_by], fault.name);
    match faulty.verdicts.first().map(|(_, verdict)| verdict.as_str()) {
        Some("fail") if faulty.status == Some(1) => String::new(),
        other => format!("{found_by} is {other:?}, {:?}\n{}", faulty.status, faulty.text),
    }
}

/// Asks these checks of the devices of a fault, with the fault of this name.
fn select(fault: &Fault, ids: &[&str], name: &str) -> Run {
    let own = std::env::current_exe().unwrap();
    let (device, _) = fault.devices.split_once('@').unwrap();
    let wire = fault.wire();
    let known = if wire == "innfos" { ["--wire", wire] } else { ["--device", device] };
    let has_neighbour = fault.devices.contains(' ');
    let neighbour = if has_neighbour { &["--neighbour", "2"][..] } else { &[] };
    let ids: Vec<_> = ids.iter().flat_map(|id| ["--select", id]).collect();
    let firmware = ["--", own.to_str().unwrap(), "firmware", fault.devices, name];
    run(&[&known[..], neighbour, &ids, &firmware].concat())
}

/// The verdicts of all checks that find faults of these devices, without a fault. They are asked once.
fn verdicts_without_fault(devices: &'static str) -> Arc<BTreeMap<String, String>> {
    type Verdicts = OnceLock<Arc<BTreeMap<String, String>>>;
    static ASKED: Mutex<BTreeMap<&str, Arc<Verdicts>>> = Mutex::new(BTreeMap::new());
    let asked = Arc::clone(ASKED.lock().unwrap().entry(devices).or_default());
    let ask = || {
        let faults: Vec<_> = every().filter(|fault| fault.devices == devices).collect();
        let ids: BTreeSet<_> = faults.iter().map(|fault| fault.check()).collect();
        let ids: Vec<_> = ids.iter().map(String::as_str).collect();
        let run = faults.first().map(|fault| select(fault, &ids, "none"));
        Arc::new(run.into_iter().flat_map(|run| run.verdicts).collect())
    };
    Arc::clone(asked.get_or_init(ask))
}
