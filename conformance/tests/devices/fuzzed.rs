//! Requests that are generated find faults, and find nothing on right devices. The devices are in this process,
//! and no time passes on their line.

use std::collections::VecDeque;
use std::fmt;
use std::io;
use std::ops::ControlFlow;
use std::process::Command;
use std::sync::Arc;
use std::time::Duration;

use actucheck::adapter::{Permissions, Question};
use actucheck::blackbox::{Asks, Fuzzed, Options, checks, fuzz};
use actucheck::port::{Bytes, Place};
use actucheck::subject::Subject as _;
use actucheck::subject::device::{Device, Line};
use actucheck::suite::check::Check;
use actucheck::suite::device::{Target, hello};
use actucheck_spec::Spec;
use actucheck_spec::wire::dynamixel2::WIRE;

use super::every;
use super::firmware::Firmware;

/// A test, which returns what is wrong.
type Test = fn() -> String;

pub(crate) const TESTS: [(&str, Test); 4] = [
    ("right_devices_pass", right),
    ("faults_are_found", faults),
    ("nothing_is_written", only_reads),
    ("as_a_program", as_a_program),
];

/// In so many conversations each of [`FOUND`] is found.
const CASES: u64 = 300;
const SEED: u64 = 1;

/// Faults that requests which only read can show.
const FOUND: [&str; 18] = [
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

/// A device with this fault on its line.
fn device(devices: &str, fault: &str) -> Device {
    let firmware = Firmware::new(devices, fault);
    let port = Played { firmware, now: Duration::ZERO, coming: VecDeque::new() };
    let (place, limit) = (Place::Program(Vec::new()), Duration::from_millis(100));
    let mut line = Line::on(WIRE, &place, Box::new(port), limit, Arc::default());
    line.exchange(&hello(WIRE, 1).unwrap(), limit, 1).unwrap();
    Device::new(devices.to_owned(), String::new(), line, Permissions::READ)
}

/// What is found on it.
fn fuzzed(devices: &str, fault: &str, cases: u64) -> Fuzzed {
    let spec = Spec::embedded().unwrap();
    let (model, _) = devices.split_once('@').unwrap();
    let target = Target::alone(Some(spec.device(model).unwrap()));
    let target = if devices.contains(' ') { target.with_neighbour(2) } else { target };
    let options = Options { wire: WIRE, seed: SEED, cases, asks: Asks::Device(&target) };
    let device = device(devices, fault);
    fuzz(&spec, &options, &mut [Box::new(device)], &|_, _| ControlFlow::Continue(()))
}

/// How many requests a question has, without the Pings after it that are not judged.
fn requests(question: &Question) -> usize {
    let Question::Device { steps, .. } = question else { return 0 };
    steps.iter().filter(|step| step.again == 0).count()
}

fn right() -> String {
    let models = ["ja40", "ja-variant", "xm430-w210", "xl330-m288"];
    let wrong = models.map(|model| {
        let Fuzzed { asked, findings, passing, given_up, .. } =
            fuzzed(&format!("{model}@1"), "none", CASES);
        let is_right = asked == CASES && findings.is_empty() && passing.is_empty();
        if is_right && given_up.is_none() {
            return String::new();
        }
        format!("{model}: {asked} asked, {given_up:?}, {findings:#?} {passing:#?}\n")
    });
    wrong.concat()
}

/// Behind every header, also one that is damaged in its fourth byte, there is no instruction that changes
/// something. Of those that are drawn, not each can be judged.
fn only_reads() -> String {
    const READS: [u8; 5] = [0x01, 0x02, 0x82, 0x8A, 0x92];
    let spec = Spec::embedded().unwrap();
    let target = Target::alone(spec.device("ja40"));
    let options = Options { wire: WIRE, seed: SEED, cases: 3_000, asks: Asks::Device(&target) };
    let device = device("ja40@1", "none");
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

/// Each fault is found, and the fewest requests show it.
fn faults() -> String {
    let wrong = FOUND.map(|name| {
        let row = every().find(|row| row.name == name).unwrap();
        let found = fuzzed(row.devices, name, CASES).findings;
        let most = found.iter().map(|finding| requests(&finding.check.question)).max();
        match most {
            Some(1..=2) => String::new(),
            most => format!("{name}: {most:?} requests\n"),
        }
    });
    wrong.concat()
}

/// What the program finds is asked again by the program.
fn as_a_program() -> String {
    let folder = tempfile::tempdir().unwrap();
    let found = folder.path().join("findings.yaml");
    let own = std::env::current_exe().unwrap();
    let run = |arguments: &[&str], fault: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_actucheck"));
        command.args(arguments).arg(&found).arg("--").arg(&own);
        let output = command.args(["firmware", "ja40@1", fault]).output().unwrap();
        (output.status.code(), String::from_utf8_lossy(&output.stdout).into_owned())
    };
    let fuzz =
        ["fuzz", "--device", "--answer-within", "100", "--seed", "1", "--cases", "10", "--out"];
    let replay = ["device", "--device", "ja40", "--replay"];
    let told = [
        run(&fuzz, "done-is-1"),
        run(&replay, "done-is-1"),
        run(&replay, "none"),
        run(&fuzz, "none"),
    ];
    let statuses = told.each_ref().map(|(status, _)| *status);
    if statuses == [Some(1), Some(1), Some(0), Some(0)] {
        String::new()
    } else {
        format!("{told:#?}")
    }
}
