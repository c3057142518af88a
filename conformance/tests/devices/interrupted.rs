//! Runs that end at any packet, or are killed: the device is restored from the journal, bit for bit.

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Stdio};

use actucheck::journal::{Journal, OLDEST, VERSION, restore, snapshot};
use actucheck::subject::Subject as _;
use actucheck::subject::device::Kept;
use actucheck_spec::Spec;
use serde_json::Value;

use super::bench::{Bench, folder};
use super::programs::{held, interrupt, kill, writing};
use super::right::Bus;

/// A test by its name, which returns what is wrong.
type Test = (&'static str, fn() -> String);

/// The tests.
pub(crate) const TESTS: [Test; 14] = [
    ("ja40", || {
        ended("ja40", "velocity-i-gain=321,velocity-limit=1234,goal-velocity=100,goal-position=77")
    }),
    ("ja_variant", || ended("ja-variant", "position-p-gain=5,velocity-limit=99")),
    ("xm430", || {
        ended("xm430-w210", "led=1,velocity-limit=99,goal-velocity=50,profile-velocity=5")
    }),
    ("xl330", || {
        ended("xl330-m288", "led=1,velocity-limit=99,goal-velocity=50,profile-velocity=5")
    }),
    ("ja40_and_its_neighbour", || {
        with_neighbour("ja40", "position-p-gain=5", "goal-velocity=50,feedforward-1st-gain=7")
    }),
    ("xm430_and_its_neighbour", || {
        with_neighbour(
            "xm430-w210",
            "position-p-gain=5",
            "led=1,velocity-limit=98,goal-velocity=50",
        )
    }),
    ("a_neighbour_with_torque", neighbour_with_torque),
    ("an_old_journal", old_journal),
    ("innfos", || ended("dd-6010", "current-loop-p=0.5,speed-loop-output-lower-limit=-0.25")),
    ("killed", killed),
    ("killed_with_its_neighbour", killed_with_its_neighbour),
    ("torque", torque),
    ("by_a_signal", by_a_signal),
    ("restored_as_a_program", restored_as_a_program),
];

/// How many runs end early, for each device: more than 1,000 in all.
const RUNS: usize = 250;
/// Pieces that a check sends, with what keeps and restores the registers around it, and a few more.
const PIECES: u64 = 70;
/// Bytes of a packet that is cut.
const BYTES: u64 = 16;

/// Numbers that are the same each time.
struct Numbers(u64);

impl Numbers {
    const fn below(&mut self, end: u64) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0 % end
    }
}

fn ended(device: &str, registers: &str) -> String {
    let spec = Spec::embedded().unwrap();
    let folder = folder();
    let bench = Bench::new(&spec, device, registers, folder.path().join("journal"));
    assert!(bench.questions.len() > 30, "{} checks write", bench.questions.len());
    ended_on(&bench)
}

/// The same for what is written to two devices at once.
fn with_neighbour(device: &str, own: &str, beside: &str) -> String {
    let spec = Spec::embedded().unwrap();
    let folder = folder();
    let path = folder.path().join("journal");
    let bench = Bench::with_neighbour(&spec, device, (own, beside), path);
    assert!(bench.questions.len() > 3, "{} checks write to both", bench.questions.len());
    ended_on(&bench)
}

/// What a run leaves that ends at any packet.
fn ended_on(bench: &Bench) -> String {
    let before = bench.table();
    let mut numbers = Numbers(0x9E37_79B9_7F4A_7C15);
    let (mut early, mut whole) = (0, 0);
    for run in 0..RUNS {
        let count = u64::try_from(bench.questions.len()).unwrap();
        let question = &bench.questions[usize::try_from(numbers.below(count)).unwrap()];
        let (pieces, cut) = (numbers.below(PIECES), numbers.below(BYTES));
        let mut subject = bench.device(bench.line(pieces, usize::try_from(cut).unwrap()));
        let answer = subject.ask(question);
        // It ends here, and nobody restores the device.
        drop(subject);
        if bench.path.exists() {
            early += 1;
            let journal = Journal::read(&bench.path).unwrap();
            if let Err(error) = restore(&journal, &mut bench.line(u64::MAX, 0)) {
                return format!("run {run}, {pieces} pieces, {question:?}, {answer:?}: {error}");
            }
            Journal::remove(&bench.path).unwrap();
        }
        if bench.table() != before {
            return format!("run {run}, {pieces} pieces, {question:?}: the table differs");
        }
        // The same without an end.
        if run % 10 == 0 {
            whole += 1;
            let mut subject = bench.device(bench.line(u64::MAX, 0));
            subject.ask(question);
            let end = subject.end();
            if end != Some(Kept::Restored) || bench.table() != before || bench.path.exists() {
                return format!("run {run}, {question:?}: {end:?}, and the table may differ");
            }
        }
    }
    assert!(early > RUNS / 2 && whole > 0, "only {early} runs left a journal");
    String::new()
}

/// A program that is killed while it writes, and the command that restores the device.
fn killed() -> String {
    let bus = Bus::start(&["ja40@1"], &["--tcp", "0"]);
    let folder = folder();
    let path = folder.path().join("journal");
    let port = format!("tcp://{}", bus.address);
    let actucheck = || Command::new(env!("CARGO_BIN_EXE_actucheck"));
    let mut run = actucheck();
    run.args(["device", &port, "--device", "ja40", "--allow", "write-ram,eeprom", "--journal"]);
    run.arg(&path).stdout(Stdio::null()).stderr(Stdio::null());
    kill(writing(&mut run, &path, 20));
    if !path.exists() {
        return "the run left no journal".to_owned();
    }
    let text = fs::read_to_string(&path).unwrap();
    // A journal that is cut is not taken.
    fs::write(&path, &text[..text.len() / 2]).unwrap();
    let back = || actucheck().args(["device", "restore"]).arg(&path).output().unwrap();
    let cut = back();
    if cut.status.code() != Some(2)
        || !String::from_utf8_lossy(&cut.stderr).contains("is no journal")
    {
        return format!("a journal that is cut: {cut:?}");
    }
    fs::write(&path, &text).unwrap();
    let output = back();
    if !output.status.success() || path.exists() {
        return format!("{output:?}");
    }
    // Nothing is left to restore.
    fs::write(&path, &text).unwrap();
    let again = back();
    let said = String::from_utf8_lossy(&again.stdout).into_owned();
    if said.contains("held what it held before already") {
        String::new()
    } else {
        format!("{again:?}")
    }
}

/// The same while it writes to two devices: the command restores both, and says so.
fn killed_with_its_neighbour() -> String {
    let spec = Spec::embedded().unwrap();
    let device = spec.device("ja40").unwrap();
    let bus = Bus::start(
        &["ja40@1:position-p-gain=5", "ja40@2:feedforward-1st-gain=7"],
        &["--tcp", "0", "--fault", "late=3ms"],
    );
    let (folder, port) = (folder(), format!("tcp://{}", bus.address));
    let path = folder.path().join("journal");
    let before = held(&port, device, [1, 2]);
    let mut run = Command::new(env!("CARGO_BIN_EXE_actucheck"));
    run.args(["device", &port, "--device", "ja40", "--neighbour", "2", "--allow", "write-ram"]);
    run.args(["--select", "*.written.*-of-two/data", "--journal"]).arg(&path);
    kill(writing(run.stdout(Stdio::null()).stderr(Stdio::null()), &path, 25));
    let mut restore = Command::new(env!("CARGO_BIN_EXE_actucheck"));
    let output = restore.args(["device", "restore"]).arg(&path).output().unwrap();
    let said = String::from_utf8_lossy(&output.stdout);
    let is_told = said.contains("JA40 with ID 1, with its neighbour JA40 with ID 2,");
    let is_held = held(&port, device, [1, 2]) == before;
    let is_right = output.status.success() && is_held && !path.exists();
    if is_told && is_right { String::new() } else { format!("{output:?}") }
}

/// Ctrl-C in the middle: the report tells of it, the device holds what it held, and nothing is left to do.
fn by_a_signal() -> String {
    let spec = Spec::embedded().unwrap();
    let device = spec.device("ja40").unwrap();
    // It answers late, so that a run takes long.
    let bus = Bus::start(
        &["ja40@1:velocity-limit=1234,goal-velocity=100"],
        &["--tcp", "0", "--fault", "late=3ms"],
    );
    let (folder, port) = (folder(), format!("tcp://{}", bus.address));
    let (journal, report) = (folder.path().join("journal"), folder.path().join("report"));
    let before = held(&port, device, [1]);
    let mut run = Command::new(env!("CARGO_BIN_EXE_actucheck"));
    run.args(["device", &port, "--device", "ja40", "--allow", "write-ram,eeprom", "--journal"]);
    run.arg(&journal).arg("--report").arg(format!("json={}", report.display()));
    run.stdout(Stdio::null()).stderr(Stdio::piped());
    let output = interrupt(writing(&mut run, &journal, 30));
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    let report: Value = serde_json::from_str(&fs::read_to_string(&report).unwrap()).unwrap();
    let is_told = report["stopped"] == "interrupted"
        && report["left"].as_u64().unwrap() > 10
        && report["totals"]["pass"].as_u64().unwrap() > 0
        && said.contains("the device holds what it held before");
    let is_held = held(&port, device, [1]) == before;
    let is_right = output.status.code() == Some(3) && !journal.exists() && is_held;
    if is_told && is_right {
        return String::new();
    }
    let [stopped, left, totals] =
        ["stopped", "left", "totals"].map(|name| report[name].to_string());
    format!("{:?}: {said}, {stopped}, {left} left, {totals}", output.status)
}

/// Firmware of this machine, which is started again to be restored.
fn restored_as_a_program() -> String {
    let spec = Spec::embedded().unwrap();
    let folder = folder();
    let path = folder.path().join("journal");
    let held = "velocity-limit=1234,goal-velocity=100,position-p-gain=5";
    let mut bench = Bench::new(&spec, "ja40", held, path.clone());
    let Journal { wire, id, layout, .. } = bench.journal.clone();
    bench.journal.held = snapshot(wire, id, &layout, &mut bench.line(u64::MAX, 0)).unwrap();
    bench.journal.write(&path).unwrap();
    let restored = |command: &[&str]| {
        let mut restore = Command::new(env!("CARGO_BIN_EXE_actucheck"));
        restore.args(["device", "restore"]).arg(&path).args(command).output().unwrap()
    };
    let without = restored(&[]);
    if without.status.code() != Some(2) || !path.exists() {
        return format!("without a command: {without:?}");
    }
    let own = std::env::current_exe().unwrap();
    let output = restored(&["--", own.to_str().unwrap(), "firmware", "ja40@1", "none"]);
    let said = String::from_utf8_lossy(&output.stdout);
    let is_right = output.status.success() && said.contains("3 registers were written");
    if is_right && !path.exists() { String::new() } else { format!("{output:?}") }
}

/// A neighbour with torque on is not written to, but the device is.
fn neighbour_with_torque() -> String {
    let spec = Spec::embedded().unwrap();
    let folder = folder();
    let path = folder.path().join("journal");
    let bench =
        Bench::with_neighbour(&spec, "ja40", ("position-p-gain=5", "torque-enable=1"), path);
    let before = bench.table();
    let mut subject = bench.device(bench.line(u64::MAX, 0));
    for question in &bench.questions {
        let answer = format!("{:?}", subject.ask(question));
        if !answer.starts_with("Skipped")
            || !answer.contains("its neighbour with ID 2: torque is on")
        {
            return format!("{question:?}: {answer}");
        }
    }
    let alone = Bench::new(&spec, "ja40", "position-p-gain=5", PathBuf::new());
    let written = format!("{:?}", subject.ask(&alone.questions[0]));
    let end = subject.end();
    if end != Some(Kept::Restored) || !written.starts_with("Ok") || bench.table() != before {
        return format!("{written}, {end:?}, and a table may differ");
    }
    String::new()
}

/// What an earlier version wrote, without a neighbour, still restores its device.
fn old_journal() -> String {
    let spec = Spec::embedded().unwrap();
    let folder = folder();
    let bench = Bench::new(&spec, "ja40", "position-p-gain=5", folder.path().join("journal"));
    let before = bench.table();
    let mut subject = bench.device(bench.line(40, 0));
    let answers: Vec<_> = bench.questions.iter().map(|question| subject.ask(question)).collect();
    drop(subject);
    let text = fs::read_to_string(&bench.path).unwrap();
    let mut old: Value = serde_json::from_str(&text).unwrap();
    old["version"] = OLDEST.into();
    old.as_object_mut().unwrap().remove("neighbour").unwrap();
    let journal = Journal::parse("old", &old.to_string()).unwrap();
    let restored = restore(&journal, &mut bench.line(u64::MAX, 0));
    if restored.is_err() || bench.table() != before {
        return format!("{restored:?} after {answers:?}");
    }
    old["version"] = (VERSION + 1).into();
    let newer = Journal::parse("new", &old.to_string()).unwrap_err().to_string();
    let is_told = newer.contains("this program reads 1 to 2");
    if is_told { String::new() } else { newer }
}

/// A device with torque on is not written to.
fn torque() -> String {
    let spec = Spec::embedded().unwrap();
    let folder = folder();
    let bench = Bench::new(&spec, "ja40", "torque-enable=1", folder.path().join("journal"));
    let before = bench.table();
    let mut subject = bench.device(bench.line(u64::MAX, 0));
    for question in &bench.questions {
        let answer = format!("{:?}", subject.ask(question));
        if !answer.starts_with("Skipped") || !answer.contains("torque is on") {
            return format!("{question:?}: {answer}");
        }
    }
    let is_left = bench.path.exists() || subject.end().is_some() || bench.table() != before;
    if is_left { "a device with torque on was written to".to_owned() } else { String::new() }
}
