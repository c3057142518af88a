//! Requests that are generated find faults, and find nothing on right devices. The devices are in this process,
//! and no time passes on their line.

mod changes;

use std::collections::VecDeque;
use std::fmt;
use std::io;
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::process::Command;
use std::sync::Arc;
use std::time::Duration;

use actucheck::adapter::{Permission, Permissions, Question, Wire};
use actucheck::blackbox::{Asks, Fuzzed, Options, checks, fuzz};
use actucheck::journal::{Journal, Layout, Snapshot, VERSION};
use actucheck::port::{Bytes, Place};
use actucheck::subject::Subject;
use actucheck::subject::device::{Device, Keeper, Kept, Line};
use actucheck::suite::check::Check;
use actucheck::suite::device::{Target, hello, kept};
use actucheck_spec::Spec;
use actucheck_spec::wire::dynamixel2::WIRE;
use actucheck_spec::wire::innfos::{self, Operation};

use super::every;
use super::firmware::Firmware;
use super::right::{ACTUATORS, Bus};

/// A test, which returns what is wrong.
type Test = fn() -> String;

pub(crate) const TESTS: [(&str, Test); 13] = [
    ("right_devices_pass", || right(&Permissions::READ)),
    ("right_devices_pass_and_are_restored", || right(&ram())),
    ("faults_are_found", || faults(&FOUND, &Permissions::READ)),
    ("faults_of_writing_are_found", || faults(&changes::FOUND, &ram())),
    ("nothing_is_written", only_reads),
    ("little_is_written", changes::writes_little),
    ("it_is_restored", changes::restored),
    ("it_is_restored_by_a_signal", changes::interrupted),
    ("boards_are_only_read", boards_only_read),
    ("boards_are_written_to_little", changes::boards_written_little),
    ("as_a_program", || {
        as_a_program(&["--table", "ja40"], &["--device", "ja40"], "ja40@1", "done-is-1")
    }),
    ("a_board_at_a_port", at_a_port),
    ("a_board_as_a_program", || {
        let board = ["--wire", "innfos", "--id", "6"];
        as_a_program(&board, &board, "dd-6010@6 dd-6010@7", "never-ready")
    }),
];

/// In so many conversations each of [`FOUND`] is found.
const CASES: u64 = 300;
const SEED: u64 = 1;

/// Faults that requests which only read can show.
const FOUND: [&str; 47] = [
    "alarm-bit-0",
    "answers-every-id",
    "broadcast-ping-silent",
    "bulk-read-silent",
    "crc-not-checked",
    "data-backwards",
    "done-is-1",
    "drive-mode-bits",
    "end-is-range-error",
    "error-bit-6",
    "fast-crc-of-all",
    "gaps-are-zero",
    "length-high-first",
    "noise-confuses",
    "pattern-restarts",
    "ping-wants-data",
    "read-limited",
    "reads-twice",
    // Boards and actuators.
    "alarms-long",
    "answers-a-byte",
    "answers-every-address",
    "answers-for-the-board",
    "answers-twice",
    "crc-always",
    "crc-high-first",
    "crc-missing",
    "crc-of-a-byte",
    "current-in-amperes",
    "end-not-awaited",
    "end-not-checked",
    "gain-short",
    "greeted-with-no",
    "header-not-checked",
    "length-ignored",
    "length-low-first",
    "length-low-only",
    "limit-in-percent",
    "limit-unsigned",
    "looks-into-data",
    "mac-short",
    "mode-from-zero",
    "never-ready",
    "on-is-ff",
    "other-command",
    "query-silent",
    "speed-short",
    "state-silent",
];

/// A virtual device as a port.
struct Played {
    firmware: Firmware,
    now: Duration,
    coming: VecDeque<u8>,
}

impl fmt::Debug for Played {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Played")
    }
}

impl Bytes for Played {
    fn send(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.now += Duration::from_micros(100);
        self.coming.extend(self.firmware.hear(bytes, self.now));
        Ok(())
    }

    fn receive(&mut self, buffer: &mut [u8], limit: Duration) -> io::Result<usize> {
        if self.coming.is_empty() && !limit.is_zero() {
            self.now += limit;
            if limit > Duration::from_millis(50) {
                self.coming.extend(self.firmware.quiet(self.now));
            }
        }
        let count = self.coming.len().min(buffer.len());
        for (slot, byte) in buffer.iter_mut().zip(self.coming.drain(..count)) {
            *slot = byte;
        }
        Ok(count)
    }

    fn takes_time(&self) -> bool {
        false
    }
}

/// The wire of devices.
fn wire_of(devices: &str) -> Wire {
    if devices.starts_with("dd-") { innfos::WIRE } else { WIRE }
}

/// The IDs of devices; the first is asked.
fn ids(devices: &str) -> Vec<u8> {
    let id = |device: &str| device.split_once('@').unwrap().1.parse().unwrap();
    devices.split(' ').map(id).collect()
}

/// A device with this fault on its line.
fn device(devices: &str, fault: &str, allowed: &Permissions, journal: PathBuf) -> Device {
    let (wire, id) = (wire_of(devices), ids(devices)[0]);
    let firmware = Firmware::new(devices, fault);
    let port = Played { firmware, now: Duration::ZERO, coming: VecDeque::new() };
    let (place, limit) = (Place::Program(Vec::new()), Duration::from_millis(100));
    let mut line = Line::on(wire, &place, Box::new(port), limit, Arc::default());
    line.greet(limit).unwrap();
    line.exchange(&hello(wire, id).unwrap(), limit, 1).unwrap();
    let device = Device::new(devices.to_owned(), String::new(), line, allowed.clone());
    let spec = Spec::embedded().unwrap();
    let table = model(&spec, devices);
    let values = || Layout::of_values(kept(wire, &spec).unwrap());
    let journal_of = Journal {
        version: VERSION,
        date: String::new(),
        wire,
        device: devices.to_owned(),
        model_number: table.and_then(|table| table.model_number),
        id,
        port: None,
        baud: 57_600,
        allowed: allowed.clone(),
        layout: table.map_or_else(values, Layout::of),
        held: Snapshot::default(),
        neighbour: None,
    };
    device.kept_by(Keeper::new(journal_of, journal))
}

/// The control table of the first of these devices.
fn model<'s>(spec: &'s Spec, devices: &str) -> Option<&'s actucheck_spec::model::Device> {
    spec.device(devices.split_once('@').unwrap().0)
}

/// What is found on it, and what became of it.
fn fuzzed(devices: &str, fault: &str, allowed: &Permissions) -> (Fuzzed, Option<Kept>) {
    let spec = Spec::embedded().unwrap();
    let (wire, present) = (wire_of(devices), ids(devices));
    let target = Target { id: present[0], present, ..Target::alone(model(&spec, devices)) };
    let options = Options {
        wire,
        seed: SEED,
        cases: CASES,
        asks: Asks::Device(&target, allowed),
        part: None,
    };
    let folder = tempfile::tempdir().unwrap();
    let device = device(devices, fault, allowed, folder.path().join("journal"));
    let mut asked: [Box<dyn Subject + Send>; 1] = [Box::new(device.clone())];
    // Of a fault one finding is enough.
    let watch = |_, found| {
        let is_over = fault != "none" && found > 0;
        if is_over { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let fuzzed = fuzz(&spec, &options, &mut asked, &watch);
    (fuzzed, device.end())
}

fn ram() -> Permissions {
    [Permission::WriteRam].into()
}

/// How many requests a question has, without the Pings after it that are not judged, and what is looked at before it.
fn requests(question: &Question) -> usize {
    let Question::Device { steps, .. } = question else { return 0 };
    steps.iter().filter(|step| step.again == 0 && step.only_if.is_none()).count()
}

fn right(allowed: &Permissions) -> String {
    let devices = ["ja40@1", "ja-variant@1", "xm430-w210@1", "xl330-m288@1", "dd-6010@6 dd-6010@7"];
    let wrong = devices.map(|devices| {
        let (fuzzed, kept) = fuzzed(devices, "none", allowed);
        let Fuzzed { asked, findings, passing, given_up, .. } = fuzzed;
        let is_right = asked == CASES && findings.is_empty() && passing.is_empty();
        if is_right
            && given_up.is_none()
            && kept == (!allowed.only_read()).then_some(Kept::Restored)
        {
            return String::new();
        }
        format!("{devices}: {asked} asked, {given_up:?}, {kept:?}, {findings:#?} {passing:#?}\n")
    });
    wrong.concat()
}

/// Behind every header, also one that is damaged in its fourth byte, there is no instruction that changes
/// something. Of those that are drawn, not each can be judged.
fn only_reads() -> String {
    const READS: [u8; 5] = [0x01, 0x02, 0x82, 0x8A, 0x92];
    let spec = Spec::embedded().unwrap();
    let target = Target::alone(spec.device("ja40"));
    let options = Options {
        wire: WIRE,
        seed: SEED,
        cases: 3_000,
        asks: Asks::Device(&target, &Permissions::READ),
        part: None,
    };
    let device = device("ja40@1", "none", &Permissions::READ, PathBuf::new());
    let checks = checks(&spec, &options, device.hello());
    let documented: Vec<_> =
        spec.wires.dynamixel2.content.instructions.iter().map(|row| row.code).collect();
    let is_wrong = |check: &&Check| {
        let Question::Device { needs, steps, .. } = &check.question else { return true };
        let pieces = steps.iter().flat_map(|step| &step.send);
        let sent: Vec<u8> = pieces.flat_map(|piece| piece.bytes.0.clone()).collect();
        let mut headers = sent.windows(8).filter(|bytes| bytes.starts_with(&[0xFF, 0xFF, 0xFD]));
        let changes = |bytes: &[u8]| documented.contains(&bytes[7]) && !READS.contains(&bytes[7]);
        !needs.only_read() || headers.any(changes)
    };
    let wrong = checks.iter().find(is_wrong);
    match (checks.len(), wrong) {
        (2_000.., None) => String::new(),
        (count, wrong) => format!("{count} checks, {wrong:#?}"),
    }
}

/// In no datagram, and behind no header in one, is a command that writes or that there is not.
fn boards_only_read() -> String {
    let spec = Spec::embedded().unwrap();
    let target = Target::alone(None);
    let options = Options {
        wire: innfos::WIRE,
        seed: SEED,
        cases: 3_000,
        asks: Asks::Device(&target, &Permissions::READ),
        part: None,
    };
    let device = device("dd-6010@1", "none", &Permissions::READ, PathBuf::new());
    let checks = checks(&spec, &options, device.hello());
    let commands = &spec.wires.innfos.content.commands;
    let reads =
        |code: u8| commands.iter().any(|row| row.code == code && row.operation == Operation::Read);
    let is_wrong = |check: &&Check| {
        let Question::Device { needs, steps, .. } = &check.question else { return true };
        let mut datagrams = steps.iter().flat_map(|step| &step.send).map(|piece| &piece.bytes.0);
        let changes = |datagram: &Vec<u8>| {
            let mut frames = datagram.windows(3).enumerate();
            frames.any(|(at, bytes)| (at == 0 || bytes[0] == 0xEE) && !reads(bytes[2]))
        };
        !needs.only_read() || datagrams.any(changes)
    };
    let wrong = checks.iter().find(is_wrong);
    match (checks.len(), wrong) {
        (2_000.., None) => String::new(),
        (count, wrong) => format!("{count} checks, {wrong:#?}"),
    }
}

/// Each fault is found, and the fewest requests show it: where they write, what is held before may count too.
fn faults(names: &[&str], allowed: &Permissions) -> String {
    let wrong = names.iter().map(|name| {
        let row = every().find(|row| row.name == *name).unwrap();
        let found = fuzzed(row.devices, name, allowed).0.findings;
        let first = found.first().map(|finding| requests(&finding.check.question));
        let few = if allowed.only_read() { 1..=2 } else { 1..=3 };
        match first {
            Some(count) if few.contains(&count) => String::new(),
            first => format!("{name}: {first:?} requests\n"),
        }
    });
    wrong.collect()
}

/// A right board behind a UDP port.
fn at_a_port() -> String {
    let bus = Bus::start(&ACTUATORS, &["--udp", "0"]);
    let port = format!("udp://{}", bus.address);
    let mut command = Command::new(env!("CARGO_BIN_EXE_actucheck"));
    let options =
        ["--wire", "innfos", "--id", "6", "--seed", "1", "--cases", "40", "--device", &port];
    let output = command.arg("fuzz").args(options).output().unwrap();
    let said = String::from_utf8_lossy(&output.stdout);
    let is_right = output.status.success() && said.contains("40 conversations");
    if is_right && said.contains("nothing found") { String::new() } else { format!("{output:?}") }
}

/// What the program finds is asked again by the program.
fn as_a_program(fuzzed: &[&str], checked: &[&str], devices: &str, fault: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    let found = folder.path().join("findings.yaml");
    let own = std::env::current_exe().unwrap();
    let run = |arguments: &[&str], fault: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_actucheck"));
        command.args(arguments).arg(&found).arg("--").arg(&own);
        let output = command.args(["firmware", devices, fault]).output().unwrap();
        (output.status.code(), String::from_utf8_lossy(&output.stdout).into_owned())
    };
    let fuzz = ["fuzz", "--device", "--answer-within", "100", "--seed", "1", "--cases", "10"];
    let fuzz = [&fuzz[..], fuzzed, &["--out"]].concat();
    let replay = [&["device"][..], checked, &["--replay"]].concat();
    let told = [run(&fuzz, fault), run(&replay, fault), run(&replay, "none"), run(&fuzz, "none")];
    let statuses = told.each_ref().map(|(status, _)| *status);
    if statuses == [Some(1), Some(1), Some(0), Some(0)] {
        String::new()
    } else {
        format!("{told:#?}")
    }
}
