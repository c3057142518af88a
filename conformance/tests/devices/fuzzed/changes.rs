//! Requests that write where that is allowed: what they find, that they write little, and that it is restored.

use std::path::PathBuf;
use std::process::{Command, Stdio};

use actucheck::adapter::Question;
use actucheck::blackbox::{Asks, Options, checks};
use actucheck::subject::Subject as _;
use actucheck::suite::check::Check;
use actucheck::suite::device::Target;
use actucheck_spec::Spec;
use actucheck_spec::model::Area;
use actucheck_spec::wire::dynamixel2::WIRE;
use actucheck_spec::wire::innfos::{self, Operation};

use super::super::programs::{held, interrupt, writing};
use super::super::right::Bus;
use super::{SEED, device, ram};

/// Faults that requests which write can show, and those that only read can't.
pub(super) const FOUND: [&str; 25] = [
    "action-of-nothing",
    "broadcast-write-ignored",
    "bulk-write-ignored",
    "fast-sync-write-crc",
    "fast-sync-write-low-byte",
    "gain-high-byte-lost",
    "range-clamped",
    "read-only-without-error",
    "reg-write-at-once",
    "short-is-filled",
    "short-without-error",
    "sync-write-first-only",
    "sync-write-for-all",
    "sync-write-ignored",
    "sync-write-last-only",
    "write-echoes-data",
    "writes-for-others",
    // Actuators.
    "crc-of-a-byte-refused",
    "done-is-2",
    "energy-read-only",
    "flag-stays-off",
    "gain-positive",
    "output-limit-positive",
    "profile-16-bits",
    "whole-hertz",
];

/// Behind every header there is an instruction that reads, or one that writes a register of the RAM area which does
/// nothing by itself, or what can't be written; whatever its CRC is.
pub(super) fn writes_little() -> String {
    const CHANGES: [u8; 11] = [3, 4, 5, 6, 8, 0x10, 0x20, 0x83, 0x8B, 0x93, 0x9B];
    const NEVER: [&str; 5] =
        ["Torque Enable", "Status Return Level", "Bus Watchdog", "Operating Mode", "Shutdown"];
    let spec = Spec::embedded().unwrap();
    let table = spec.device("xm430-w210").unwrap();
    let target = Target::alone(Some(table));
    let allowed = ram();
    let options = Options {
        wire: WIRE,
        seed: SEED,
        cases: 3_000,
        asks: Asks::Device(&target, &allowed),
        part: None,
    };
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
pub(super) fn restored() -> String {
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

/// In no datagram, and behind no header in one, is a command that no read or write of a value has, or that gives the
/// motor power or another mode.
pub(super) fn boards_written_little() -> String {
    let spec = Spec::embedded().unwrap();
    let (target, allowed) = (Target::alone(None), ram());
    let asks = Asks::Device(&target, &allowed);
    let options = Options { wire: innfos::WIRE, seed: SEED, cases: 3_000, asks, part: None };
    let device = device("dd-6010@1", "none", &allowed, PathBuf::new());
    let checks = checks(&spec, &options, device.hello());
    let commands = &spec.wires.innfos.content.commands;
    let may_be_sent = |code: u8| {
        commands.iter().any(|row| {
            let is_value = row.request > 0 && row.reply == [1];
            let is_quiet = is_value && !["Mode", "Power state"].contains(&row.name.as_str());
            row.code == code && (row.operation == Operation::Read || is_quiet)
        })
    };
    let is_wrong = |check: &&Check| {
        let Question::Device { steps, .. } = &check.question else { return true };
        let mut datagrams = steps.iter().flat_map(|step| &step.send).map(|piece| &piece.bytes.0);
        let changes = |datagram: &Vec<u8>| {
            let mut frames = datagram.windows(3).enumerate();
            frames.any(|(at, bytes)| (at == 0 || bytes[0] == 0xEE) && !may_be_sent(bytes[2]))
        };
        datagrams.any(changes) || steps[0].only_if.is_none()
    };
    let writes = |check: &&Check| matches!(&check.question, Question::Device { needs, .. } if *needs == allowed);
    let (wrong, writing) = (checks.iter().find(is_wrong), checks.iter().filter(writes).count());
    match (writing, wrong) {
        (1_000.., None) => String::new(),
        (count, wrong) => format!("{count} checks write, {wrong:#?}"),
    }
}

/// Ctrl-C in the middle: the device holds what it held, that was read back, and nothing is left to do.
pub(super) fn interrupted() -> String {
    let spec = Spec::embedded().unwrap();
    let table = spec.device("ja40").unwrap();
    // It answers late, so that a run takes long.
    let bus = Bus::start(
        &["ja40@1:position-p-gain=5,goal-velocity=100"],
        &["--tcp", "0", "--fault", "late=3ms"],
    );
    let (folder, port) = (tempfile::tempdir().unwrap(), format!("tcp://{}", bus.address));
    let (journal, found) = (folder.path().join("journal"), folder.path().join("findings.yaml"));
    let before = held(&port, table, [1]);
    let mut run = Command::new(env!("CARGO_BIN_EXE_actucheck"));
    run.args(["fuzz", "--device", &port, "--table", "ja40", "--allow", "write-ram", "--seed", "1"]);
    run.arg("--journal").arg(&journal).arg("--out").arg(&found);
    run.stdout(Stdio::piped()).stderr(Stdio::piped());
    let output = interrupt(writing(&mut run, &journal, 50));
    let said = format!("{output:?}");
    let is_told = said.contains("the device holds what it held before; that was read back");
    let words = String::from_utf8_lossy(&output.stdout).into_owned();
    let count = words.split(' ').next().and_then(|count| count.parse::<u64>().ok());
    let is_early = count.is_some_and(|count| count < 1_000);
    let is_held = held(&port, table, [1]) == before;
    let is_right = output.status.success() && !journal.exists() && is_held;
    if is_told && is_early && is_right { String::new() } else { said }
}
