//! Measures how time and memory of the program grow with its work, and keeps it in `runs/growth.json`.
//!
//! `cargo run --release -p actucheck-benches --bin grow PROGRAM HOST`, on Linux, with the program `actucheck` that
//! `cargo build --release` made, and the test program `hosts`, which is a right host too.

use std::ffi::OsStr;
use std::fs::{self, File};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};
use std::process::{Child, ExitCode, Stdio};
use std::time::Duration;
use std::{env, thread};

use actucheck_benches::growth::{Command, Growth, Run};
use actucheck_benches::kept::Machine;
use actucheck_codec::dynamixel2::instruction::Read;
use serde_json::Value;

/// How often a process is looked at: its last look misses as much of its time at most.
const PAUSE: Duration = Duration::from_millis(2);
/// The unit of processor time in `/proc`, on every Linux that Rust runs on.
const TICKS_A_SECOND: f64 = 100.0;

/// What is measured, with so much work.
type Work = fn(&Programs, u64, &Path) -> io::Result<Run>;

struct Programs {
    actucheck: PathBuf,
    host: PathBuf,
}

fn main() -> ExitCode {
    let mut arguments = env::args_os().skip(1).map(PathBuf::from);
    let (Some(actucheck), Some(host)) = (arguments.next(), arguments.next()) else {
        eprintln!(
            "grow: name the program, such as target/release/actucheck, and the test program hosts, such as \
             target/debug/deps/hosts-0123456789abcdef"
        );
        return ExitCode::from(2);
    };
    match run(&Programs { actucheck, host }) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("grow: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(programs: &Programs) -> io::Result<()> {
    let folder = env::temp_dir().join(format!("actucheck-growth-{}", std::process::id()));
    fs::create_dir(&folder)?;
    let measured = measured(programs, &folder);
    fs::remove_dir_all(&folder)?;
    let growth = Growth { commands: measured?, machine: Machine::here(1) };
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("runs/growth.json");
    fs::write(&file, serde_json::to_string_pretty(&growth)? + "\n")?;
    println!("wrote {}", file.display());
    Ok(())
}

fn measured(programs: &Programs, folder: &Path) -> io::Result<Vec<Command>> {
    let all: [(&str, &str, Work, [u64; 3]); 5] = [
        ("codec", "checks", codec, [20_000, 200_000, 2_000_000]),
        ("decode", "packets", decode, [10_000, 100_000, 1_000_000]),
        ("bus", "requests", bus, [100_000, 1_000_000, 10_000_000]),
        ("fuzz --host", "conversations", fuzz_host, [300, 3000, 30_000]),
        ("fuzz --device", "conversations", fuzz_device, [300, 3000, 30_000]),
    ];
    let mut commands = Vec::new();
    for (name, unit, work, sizes) in all {
        let mut runs = Vec::new();
        for size in sizes {
            let run = work(programs, size, folder)?;
            println!("{name}: {run:?}");
            runs.push(run);
        }
        commands.push(Command { name: name.to_owned(), unit: unit.to_owned(), runs });
    }
    Ok(commands)
}

/// So many random cases of the built-in codec, beside those that are always asked.
fn codec(programs: &Programs, cases: u64, folder: &Path) -> io::Result<Run> {
    let report = folder.join("report.json");
    let (cases, json) = (cases.to_string(), format!("json={}", report.display()));
    let arguments = ["codec", "-q", "--jobs", "1", "--cases", &cases, "--report", &json];
    let run = watched(&programs.actucheck, arguments, Stdio::null())?;
    let report: Value = serde_json::from_str(&fs::read_to_string(report)?)?;
    let totals = report.get("totals").and_then(Value::as_object);
    let checks = totals.map(|totals| totals.values().filter_map(Value::as_u64).sum());
    Ok(Run { work: checks.ok_or_else(|| io::Error::other("a report without totals"))?, ..run })
}

/// A log of so many packets.
fn decode(programs: &Programs, packets: u64, folder: &Path) -> io::Result<Run> {
    let log = folder.join("log");
    requests(&log, packets)?;
    let arguments = [OsStr::new("decode"), OsStr::new("--input=raw"), log.as_os_str()];
    Ok(Run { work: packets, ..watched(&programs.actucheck, arguments, Stdio::null())? })
}

/// So many requests to a virtual device.
fn bus(programs: &Programs, packets: u64, folder: &Path) -> io::Result<Run> {
    let log = folder.join("requests");
    requests(&log, packets)?;
    let arguments = ["bus", "ja40@1", "--stdio"];
    Ok(Run { work: packets, ..watched(&programs.actucheck, arguments, File::open(&log)?.into())? })
}

/// So many conversations with a virtual device.
fn fuzz_device(programs: &Programs, cases: u64, folder: &Path) -> io::Result<Run> {
    let device =
        [programs.actucheck.as_os_str(), "bus".as_ref(), "ja40@1".as_ref(), "--stdio".as_ref()];
    fuzz(programs, "--device", cases, folder, &device)
}

/// So many conversations of a right host, on a port in memory.
fn fuzz_host(programs: &Programs, cases: u64, folder: &Path) -> io::Result<Run> {
    let host = [
        programs.host.as_os_str(),
        "adapter".as_ref(),
        "none".as_ref(),
        "100".as_ref(),
        "memory".as_ref(),
    ];
    fuzz(programs, "--host", cases, folder, &host)
}

/// So many conversations of what is a process of its own.
fn fuzz(
    programs: &Programs,
    role: &str,
    cases: u64,
    folder: &Path,
    command: &[&OsStr],
) -> io::Result<Run> {
    let (number, out) = (cases.to_string(), folder.join("findings.yaml"));
    let options = ["fuzz", "-q", role, "--seed", "1", "--cases", &number, "--out"];
    let options = options.into_iter().map(OsStr::new).chain([out.as_os_str(), "--".as_ref()]);
    let run = watched(&programs.actucheck, options.chain(command.iter().copied()), Stdio::null())?;
    Ok(Run { work: cases, ..run })
}

/// A file of so many Reads, one directly after the other.
fn requests(file: &Path, packets: u64) -> io::Result<()> {
    let mut buffer = [0; 32];
    let read = Read { address: 132, length: 4 };
    let packet = read.encode(1, &mut buffer).map_err(io::Error::other)?;
    let mut file = io::BufWriter::new(File::create(file)?);
    for _ in 0..packets {
        file.write_all(packet)?;
    }
    file.flush()
}

/// Runs the program and looks at it until it ends.
fn watched<A: AsRef<OsStr>>(
    program: &Path,
    arguments: impl IntoIterator<Item = A>,
    input: Stdio,
) -> io::Result<Run> {
    let mut command = std::process::Command::new(program);
    let command = command.args(arguments).stdin(input).stdout(Stdio::null()).stderr(Stdio::null());
    let mut child = command.spawn()?;
    let mut last = Run { work: 0, seconds: 0.0, memory: 0 };
    let status = loop {
        if let Some(status) = child.try_wait()? {
            break status;
        }
        // Between the two it may have ended.
        last = look(&child).unwrap_or(last);
        thread::sleep(PAUSE);
    };
    if !status.success() || last.memory == 0 {
        return Err(io::Error::other(format!("{} ended with {status}", program.display())));
    }
    Ok(last)
}

/// What a process has used so far.
fn look(child: &Child) -> Option<Run> {
    let folder = Path::new("/proc").join(child.id().to_string());
    let stat = fs::read_to_string(folder.join("stat")).ok()?;
    // The name, which may have spaces, ends with the last bracket; two times come eleven fields later.
    let (_, fields) = stat.rsplit_once(") ")?;
    let ticks: f64 =
        fields.split(' ').skip(11).take(2).filter_map(|field| field.parse::<f64>().ok()).sum();
    let status = fs::read_to_string(folder.join("status")).ok()?;
    let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let memory = peak.trim().strip_suffix(" kB")?.parse().ok()?;
    Some(Run { work: 0, seconds: ticks / TICKS_A_SECOND, memory })
}
