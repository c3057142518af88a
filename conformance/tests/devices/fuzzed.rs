//! Requests that are generated find faults, and find nothing on right devices. The devices are in this process,
//! and no time passes on their line.

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
use actucheck::suite::device::{Target, hello};
use actucheck_spec::Spec;
use actucheck_spec::model::Area;
use actucheck_spec::wire::dynamixel2::WIRE;
use actucheck_spec::wire::innfos::{self, Operation};

use super::every;
use super::firmware::Firmware;
use super::right::{ACTUATORS, Bus};

/// A test, which returns what is wrong.
type Test = fn() -> String;

pub(crate) const TESTS: [(&str, Test); 11] = [
    ("right_devices_pass", || right(&Permissions::READ)),
    ("right_devices_pass_and_are_restored", || right(&ram())),
    ("faults_are_found", || faults(&FOUND, &Permissions::READ)),
    ("faults_of_writing_are_found", || faults(&FOUND_BY_WRITING, &ram())),
    ("nothing_is_written", only_reads),
    ("little_is_written", writes_little),
    ("it_is_restored", restored),
    ("boards_are_only_read", boards_only_read),
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

/// Faults that requests which write can show, and those that only read can't.
const FOUND_BY_WRITING: [&str; 13] = [
    "action-of-nothing",
    "broadcast-write-ignored",
    "bulk-write-ignored",
    "fast-sync-write-crc",
    "gain-high-byte-lost",
    "range-clamped",
    "read-only-without-error",
    "reg-write-at-once",
    "short-without-error",
    "sync-write-first-only",
    "sync-write-ignored",
    "write-echoes-data",
    "writes-for-others",
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
    let Some(table) = model(&spec, devices) else { return device };
    let journal_of = Journal {
        version: VERSION,
        date: String::new(),
        wire,
        device: devices.to_owned(),
        model_number: table.model_number,
        id,
        port: None,
        baud: 57_600,
        allowed: allowed.clone(),
        layout: Layout::of(table),
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
    let options = Options { wire, seed: SEED, cases: CASES, asks: Asks::Device(&target, allowed) };
    let folder = tempfile::tempdir().unwrap();
    let device = device(devices, fault, allowed, folder.path().join("journal"));
    let mut asked: [Box<dyn Subject + Send>; 1] = [Box::new(device.clone())];
    let fuzzed = fuzz(&spec, &options, &mut asked, &|_, _| ControlFlow::Continue(()));
    (fuzzed, device.end())
}

fn ram() -> Permissions {
    [Permission::WriteRam].into()
}

/// How many requests a question has, without the Pings after it that are not judged.
fn requests(question: &Question) -> usize {
    let Question::Device { steps, .. } = question else { return 0 };
    steps.iter().filter(|step| step.again == 0).count()
}

fn right(allowed: &Permissions) -> String {
    let is_kept = |devices: &str| !allowed.only_read() && wire_of(devices) == WIRE;
    let devices = ["ja40@1", "ja-variant@1", "xm430-w210@1", "xl330-m288@1", "dd-6010@6 dd-6010@7"];
    let wrong = devices.map(|devices| {
        let (fuzzed, kept) = fuzzed(devices, "none", allowed);
        let Fuzzed { asked, findings, passing, given_up, .. } = fuzzed;
        let is_right = asked == CASES && findings.is_empty() && passing.is_empty();
        if is_right && given_up.is_none() && kept == is_kept(devices).then_some(Kept::Restored) {
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

/// Behind every header there is an instruction that reads, or one that writes a register of the RAM area which does
/// nothing by itself, or what can't be written; whatever its CRC is.
fn writes_little() -> String {
    const CHANGES: [u8; 11] = [3, 4, 5, 6, 8, 0x10, 0x20, 0x83, 0x8B, 0x93, 0x9B];
    const NEVER: [&str; 5] =
        ["Torque Enable", "Status Return Level", "Bus Watchdog", "Operating Mode", "Shutdown"];
    let spec = Spec::embedded().unwrap();
    let table = spec.device("xm430-w210").unwrap();
    let target = Target::alone(Some(table));
    let allowed = ram();
    let options =
        Options { wire: WIRE, seed: SEED, cases: 3_000, asks: Asks::Device(&target, &allowed) };
    let device = device("xm430-w210@1", "none", &allowed, PathBuf::new());
    let checks = checks(&spec, &options, device.hello());
    let may_be_written = |address: u16| {
        let register = table.registers.iter().find(|register| register.address == address);
        register.map_or(address == u16::MAX, |register| {
            let name = register.name.as_str();
            register.area == Area::Ram && !NEVER.contains(&name) && !name.starts_with("Goal ")
        })
    };
    let word = |bytes: &[u8]| bytes.first_chunk().copied().map(u16::from_le_bytes);
    let is_harmless = |packet: &[u8]| match packet[7] {
        3 | 4 | 0x83 | 0x8B => packet.get(8..).and_then(word).is_some_and(may_be_written),
        5 => true,
        // The first of its blocks begins with an ID.
        0x93 => packet.get(9..).and_then(word).is_some_and(may_be_written),
        code => !CHANGES.contains(&code),
    };
    let sent = |check: &Check| -> Vec<u8> {
        let Question::Device { steps, .. } = &check.question else { return Vec::new() };
        let pieces = steps.iter().flat_map(|step| &step.send);
        pieces.flat_map(|piece| piece.bytes.0.clone()).collect()
    };
    let is_wrong = |check: &&Check| {
        let sent = sent(check);
        let mut starts = (0..sent.len()).map(|from| &sent[from..]);
        starts.any(|rest| {
            rest.starts_with(&[0xFF, 0xFF, 0xFD]) && rest.len() > 8 && !is_harmless(rest)
        })
    };
    let writes = |check: &&Check| matches!(&check.question, Question::Device { needs, .. } if *needs == ram());
    let (wrong, writing) = (checks.iter().find(is_wrong), checks.iter().filter(writes).count());
    match (writing, wrong) {
        (1_000.., None) => String::new(),
        (count, wrong) => format!("{count} checks write, {wrong:#?}"),
    }
}

/// The program removes its journal when the device holds what it held; other permissions are refused.
fn restored() -> String {
    let folder = tempfile::tempdir().unwrap();
    let (found, journal) = (folder.path().join("findings.yaml"), folder.path().join("journal"));
    let own = std::env::current_exe().unwrap();
    let run = |allowed: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_actucheck"));
        let options =
            ["--answer-within", "100", "--seed", "1", "--cases", "10", "--allow", allowed];
        command.args(["fuzz", "--device"]).args(options).arg("--out").arg(&found);
        command.arg("--journal").arg(&journal).arg("--").arg(&own);
        let output = command.args(["firmware", "ja40@1", "write-echoes-data"]).output().unwrap();
        (output.status.code(), format!("{output:?}"))
    };
    let ((status, said), (refused, why)) = (run("write-ram"), run("eeprom"));
    let is_kept = said.contains("holds what it held before") && said.contains("--allow write-ram");
    let is_right = status == Some(1) && is_kept && !journal.exists();
    let is_refused = refused == Some(2) && why.contains("give no other --allow than write-ram");
    if is_right && is_refused { String::new() } else { format!("{said}\n{why}") }
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

/// Each fault is found, and the fewest requests show it.
fn faults(names: &[&str], allowed: &Permissions) -> String {
    let wrong = names.iter().map(|name| {
        let row = every().find(|row| row.name == *name).unwrap();
        let found = fuzzed(row.devices, name, allowed).0.findings;
        let most = found.iter().map(|finding| requests(&finding.check.question)).max();
        match most {
            Some(1..=2) => String::new(),
            most => format!("{name}: {most:?} requests\n"),
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
