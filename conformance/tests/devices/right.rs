//! Right devices, which no check may fail, at every kind of port.

use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::io::{BufRead as _, BufReader};
use std::process::{Child, Command, Stdio};

use actucheck::adapter::{Question, Wire};
use actucheck::suite;
use actucheck::suite::device::Target;
use actucheck_spec::Spec;
use actucheck_spec::model::Role;
use actucheck_spec::wire::dynamixel2::Packet;
use actucheck_spec::wire::dynamixel2::reference::packets;

use serde_json::Value;

use super::killing::run;

/// A test by its name.
pub(crate) type Test = (&'static str, fn() -> String);

/// The tests. Each returns what is wrong.
pub(crate) const TESTS: [Test; 18] = [
    ("scan_of_a_socket", || scan(&["--tcp", "0"], "tcp://", "ID 2: JA40, model 5210, firmware 0")),
    ("scan_of_a_terminal", || {
        scan(&["--pty"], "", "ID 1 at 57600 bit/s: JA40, model 5210, firmware 0")
    }),
    ("ja40", || program("ja40")),
    ("ja_variant", || program("ja-variant")),
    ("xm430", || program("xm430-w210")),
    ("xl330", || program("xl330-m288")),
    ("scan_of_a_board", || {
        scan_of(
            &ACTUATORS,
            &["--udp", "0"],
            "udp://",
            "ID 6: a device that does not tell its model",
        )
    }),
    ("innfos_program", || {
        let own = std::env::current_exe().unwrap();
        judged(
            &[
                &INNFOS[..],
                &["--", own.to_str().unwrap(), "firmware", "dd-6010@6 dd-6010@7", "none"],
            ]
            .concat(),
            80,
        )
    }),
    ("innfos_silent_for_all", || {
        board(&["--udp", "0", "--readings", "broadcast=silent"], "udp://")
    }),
    ("another_model_beside", || another_beside("xm430-w210@1 xl330-m288@2", "xm430-w210", 2)),
    ("another_table_beside", || another_beside("ja40@1 xl330-m288@2", "ja40", 0)),
    ("what_is_written_beside", written_beside),
    ("an_unknown_model_beside", unknown_beside),
    ("response_time", response_time),
    ("with_an_alarm", || port(&["--tcp", "0", "--fault", "overheating#1"], "tcp://")),
    ("innfos_with_an_alarm", || board(&["--udp", "0", "--fault", "overheating#1"], "udp://")),
    ("echo", || port(&["--tcp", "0", "--echo"], "tcp://")),
    ("crc_error", || port(&["--tcp", "0", "--readings", "crc-error=answer"], "tcp://")),
];

pub(crate) const SERVOS: [&str; 2] = ["ja40@1", "ja40@2"];
pub(crate) const ACTUATORS: [&str; 2] = ["dd-6010@7", "dd-6010@6"];
const INNFOS: [&str; 6] = ["--wire", "innfos", "--id", "6", "--neighbour", "7"];

/// The ports of a virtual bus: its option, and how the address that it tells begins for a run.
const PORTS: [(&str, &[&str], &str); 3] = [
    ("pseudo_terminal", &["--pty"], ""),
    ("tcp", &["--tcp", "0"], "tcp://"),
    ("udp", &["--udp", "0"], "udp://"),
];
/// How answers come.
const ANSWERS: [(&str, &[&str]); 2] =
    [("late_and_split", &["--fault", "late=3ms", "--fault", "split"]), ("at_once", &[])];

/// Each device at each port, with answers that come at once and those that come late and in pieces.
pub(crate) fn everywhere() -> Vec<(String, Box<dyn Fn() -> String + Send>)> {
    let servos = ["ja40", "ja-variant", "xm430-w210", "xl330-m288"];
    let mut tests: Vec<(String, Box<dyn Fn() -> String + Send>)> = Vec::new();
    for (answers, fault) in ANSWERS {
        for (port, options, before) in PORTS {
            let options = [options, fault].concat();
            for device in servos {
                let options = options.clone();
                let name = format!("{device}::{port}::{answers}");
                tests.push((name, Box::new(move || servo(device, &options, before))));
            }
            // A board has no line of its own.
            if port != "pseudo_terminal" {
                let name = format!("dd-6010::{port}::{answers}");
                tests.push((name, Box::new(move || board(&options, before))));
            }
        }
    }
    tests
}

/// The checks that name no requirement of a device, or have an id that another has.
pub(crate) fn requirements() -> String {
    let spec = Spec::embedded().unwrap();
    let mut wrong = Vec::new();
    let wires = Wire::ALL.map(|wire| wire.id().to_owned());
    let mut checked = BTreeSet::new();
    for check in suite::every_device_plan(&spec, &Wire::ALL).checks() {
        let row = spec.requirement(&check.requirement);
        if !row.is_some_and(|row| row.binds.contains(&Role::Device)) {
            wrong.push(format!("{} {}", check.id, check.requirement));
        }
        checked.insert(check.id.split('.').next().unwrap().to_owned());
    }
    assert!(wires.iter().all(|wire| checked.contains(wire)), "{checked:?}");
    for file in &spec.devices {
        let device = &file.content;
        let target = Target::alone(Some(device)).with_neighbour(2, Some(device));
        let mut ids = BTreeSet::new();
        for check in suite::device_plan(&spec, &[device.wire], &target).checks() {
            let row = spec.requirement(&check.requirement);
            if !row.is_some_and(|row| row.binds.contains(&Role::Device))
                || !ids.insert(check.id.clone())
            {
                wrong.push(format!("{}: {} {}", device.device, check.id, check.requirement));
            }
        }
        assert!(ids.len() > 100, "{} checks of {}", ids.len(), device.device);
    }
    wrong.join("\n")
}

/// The checks that switch torque on without having set the goal to where the shaft is.
pub(crate) fn torque_without_a_goal() -> String {
    let spec = Spec::embedded().unwrap();
    let (mut wrong, mut right) = (Vec::new(), 0);
    for file in spec.devices.iter().filter(|file| file.content.register("Torque Enable").is_some())
    {
        let device = &file.content;
        let torque = device.register("Torque Enable").unwrap().address;
        let on = [&torque.to_le_bytes()[..], &[1]].concat();
        let target = Target::alone(Some(device));
        for check in suite::device_plan(&spec, &[device.wire], &target).checks() {
            let Question::Device { steps, .. } = &check.question else { continue };
            let mut is_here = false;
            for step in steps {
                is_here |=
                    step.sum.as_ref().is_some_and(|sum| sum.by == 0) && step.only_if.is_some();
                let bytes: Vec<u8> = step.send.iter().flat_map(|it| it.bytes.0.clone()).collect();
                let writes = |packet: &Packet| matches!(packet, Packet::Instruction { instruction: 3, params, .. } if params.0 == on);
                if packets(&bytes).iter().any(writes) {
                    if is_here {
                        right += 1;
                    } else {
                        wrong.push(format!("{} {}", device.device, check.id));
                    }
                }
            }
        }
    }
    if wrong.is_empty() && right == 0 {
        return "no check switches torque on".to_owned();
    }
    wrong.join("\n")
}

/// Firmware of this machine.
fn program(device: &str) -> String {
    let own = std::env::current_exe().unwrap();
    let devices = format!("{device}@1 {device}@2");
    let neighbour = ["--neighbour", "2", "--"];
    let options = ["--device", device, neighbour[0], neighbour[1], neighbour[2]];
    judged(&[&options[..], &[own.to_str().unwrap(), "firmware", &devices, "none"]].concat(), 100)
}

/// A virtual bus behind a port.
fn port(options: &[&str], before: &str) -> String {
    servo("ja40", options, before)
}

/// A virtual bus with two of these devices behind a port.
fn servo(device: &str, options: &[&str], before: &str) -> String {
    let bus = Bus::start(&[1, 2].map(|id| format!("{device}@{id}")), options);
    let port = format!("{before}{}", bus.address);
    judged(&[&port, "--device", device, "--neighbour", "2"], 100)
}

/// A virtual board behind a port.
fn board(options: &[&str], before: &str) -> String {
    let bus = Bus::start(&ACTUATORS, options);
    let port = format!("{before}{}", bus.address);
    judged(&[&[port.as_str()][..], &INNFOS].concat(), 80)
}

/// What is written to the neighbour is told before, also by the plan, and both are restored.
fn written_beside() -> String {
    let sentence = "the neighbour, a JA40 with ID 2, is written to as well while its torque is off, and restored: \
                    Feedforward 1st Gain";
    let mut plan = Command::new(env!("CARGO_BIN_EXE_actucheck"));
    plan.args(["device", "--device", "ja40", "--neighbour", "2", "--dry-run", "--allow"]);
    let planned = |allowed: &str| {
        let output = Command::new(plan.get_program()).args(plan.get_args()).arg(allowed).output();
        String::from_utf8_lossy(&output.unwrap().stdout).contains(sentence)
    };
    let checks = ["--select", "*.first-of-two/data", "--device", "ja40", "--neighbour", "2", "--"];
    let run = run(&[&checks[..], &[&own(), "firmware", "ja40@1 ja40@2", "none"]].concat());
    let is_told = run.text.contains(sentence) && run.text.contains("holds what it held before");
    let is_planned = planned("write-ram") && !planned("read");
    let is_right = run.status == Some(0) && run.verdicts.len() == 2;
    if is_told && is_planned && is_right {
        String::new()
    } else {
        format!("{is_planned}, {}", run.text)
    }
}

/// A neighbour of another model, whatever was chosen for all: of what one packet writes to both, so many instructions
/// are checked in both orders.
fn another_beside(devices: &str, device: &str, count: usize) -> String {
    let checks = ["--select", "*.{several,sentence,written}.*", "--neighbour", "2", "--device"];
    let run = run(&[&checks[..], &[device, "--", &own(), "firmware", devices, "none"]].concat());
    let wrong: Vec<_> = run.verdicts.iter().filter(|(_, verdict)| verdict == "fail").collect();
    let is_of_both = |id: &str| id.contains(".written.") && id.ends_with("-of-two/data");
    let of_both = run.verdicts.iter().filter(|(id, verdict)| is_of_both(id) && verdict == "pass");
    let is_right = run.status == Some(0) && of_both.count() == count * 2;
    if is_right { String::new() } else { format!("{wrong:?}\n{}", run.text) }
}

/// A neighbour of a model without a control table is not written to, and that is told.
fn unknown_beside() -> String {
    let checks = ["--select", "*.basic.ping/answer", "--device", "ja40", "--neighbour", "2", "--"];
    let firmware = [&own(), "firmware", "ja40@1 ja40@2", "model-high-byte-first"];
    let run = run(&[&checks[..], &firmware].concat());
    let is_told = run.text.contains("the neighbour with ID 2 is not written to");
    if run.status == Some(0) && is_told { String::new() } else { run.text }
}

/// This program, which is the firmware too.
fn own() -> String {
    std::env::current_exe().unwrap().to_str().unwrap().to_owned()
}

/// What is sent is counted, and how long answers take is told by instruction. They are made late; half of that may
/// have passed before a busy machine lets the program note when it had sent.
fn response_time() -> String {
    let bus = Bus::start(&SERVOS, &["--tcp", "0", "--fault", "late=40ms"]);
    let mut command = Command::new(env!("CARGO_BIN_EXE_actucheck"));
    command.args(["device", &format!("tcp://{}", bus.address), "--device", "ja40"]);
    command.args(["--select", "*.basic.{ping,read}/answer", "--report", "json=-"]);
    let output = command.output().unwrap();
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    let traffic = &report["traffic"];
    let times = &traffic["response"];
    let us = |name: &str| times[name].as_u64().unwrap();
    let of = |place: usize| {
        let row = &traffic["by_instruction"][place];
        (row["instruction"].as_str().unwrap(), row["count"].as_u64().unwrap())
    };
    // One Ping to find the device, one to all, and the two packets of the checks.
    let is_counted = traffic["pieces"] == 4 && (of(0), of(1)) == (("ping", 1), ("read", 1));
    let is_timed = us("least_us") >= 20_000 && us("most_us") < 2_000_000 && us("count") == 2;
    if is_counted && is_timed { String::new() } else { format!("{traffic}") }
}

/// The devices of a port are found.
fn scan(options: &[&str], before: &str, line: &str) -> String {
    scan_of(&SERVOS, options, before, line)
}

fn scan_of(devices: &[&str], options: &[&str], before: &str, line: &str) -> String {
    let bus = Bus::start(devices, options);
    let mut command = Command::new(env!("CARGO_BIN_EXE_actucheck"));
    let output = command.args(["scan", &format!("{before}{}", bus.address)]).output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout);
    let is_found = text.lines().any(|found| found == line);
    if output.status.success() && is_found { String::new() } else { format!("{line}: {output:?}") }
}

fn judged(arguments: &[&str], least: usize) -> String {
    let run = run(arguments);
    let is_wrong = |verdict: &str| !["pass", "recorded", "skip"].contains(&verdict);
    let wrong: Vec<_> = run.verdicts.iter().filter(|(_, verdict)| is_wrong(verdict)).collect();
    if run.status == Some(0) && wrong.is_empty() && run.verdicts.len() > least {
        return String::new();
    }
    format!("{:?}, {} checks, {wrong:?}\n{}", run.status, run.verdicts.len(), run.text)
}

/// A running virtual bus.
pub(crate) struct Bus {
    child: Child,
    pub(crate) address: String,
}

impl Bus {
    pub(crate) fn start(devices: &[impl AsRef<OsStr>], options: &[&str]) -> Self {
        let mut command = Command::new(env!("CARGO_BIN_EXE_actucheck"));
        command.arg("bus").args(devices).args(options);
        let mut child = command.stdout(Stdio::piped()).stderr(Stdio::null()).spawn().unwrap();
        let mut line = String::new();
        BufReader::new(child.stdout.take().unwrap()).read_line(&mut line).unwrap();
        let address = line.split_whitespace().nth(1).unwrap().to_owned();
        Self { child, address }
    }
}

impl Drop for Bus {
    fn drop(&mut self) {
        self.child.kill().unwrap();
        self.child.wait().unwrap();
    }
}
