//! Makes `RESULTS.md` and `crc.svg` from criterion's measurements.
//!
//! `cargo run --release -p actucheck-benches [FOLDER]`, right after `cargo bench`. The default
//! folder is `target/criterion`. In `RESULTS.md` it replaces the text between the two marks; the
//! rest is written by hand.

use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::{env, fs};

use actucheck_benches::{chart, measured, table};

const BEGIN: &str = "<!-- measured -->\n";
const END: &str = "<!-- end of measured -->\n";

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("ratios: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run() -> io::Result<()> {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folder = env::args_os().nth(1).map_or(here.join("../target/criterion"), PathBuf::from);
    let all = measured::read(&folder)?;
    let results = here.join("RESULTS.md");
    let old = fs::read_to_string(&results)?;
    let parts = old.split_once(BEGIN).zip(old.split_once(END));
    let ((before, _), (_, after)) = parts.ok_or_else(|| io::Error::other("no marks"))?;
    let tables = table::markdown(&all);
    fs::write(&results, format!("{before}{BEGIN}\n{}\n{tables}\n{END}{after}", circumstances()))?;
    fs::write(here.join("crc.svg"), chart::svg(&all))?;
    print!("{tables}");
    Ok(())
}

/// Machine, compiler, day and load.
fn circumstances() -> String {
    let said = |program: &str, argument: &str| {
        let output = Command::new(program).arg(argument).output();
        output.map(|output| String::from_utf8_lossy(&output.stdout).trim().to_owned())
    };
    let unknown = |_| "unknown".to_owned();
    let cpu = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let line = |name: &str| {
        let line = cpu.lines().find(|line| line.starts_with(name));
        line.and_then(|line| line.split_once(": ")).map_or("unknown", |(_, value)| value)
    };
    let flags = ["sse2", "avx2", "pclmulqdq", "vpclmulqdq", "avx512f"];
    let flags: Vec<_> = flags
        .into_iter()
        .filter(|flag| line("flags").split(' ').any(|other| other == *flag))
        .collect();
    format!(
        "- processor: {} (family {}, model {}) with {}\n- compiler: {}\n- day: {}\n\
         - load over 1, 5 and 15 minutes when the run ended: {}\n",
        line("model name"),
        line("cpu family"),
        line("model\t"),
        flags.join(", "),
        said("rustc", "--version").unwrap_or_else(unknown),
        said("date", "+%F").unwrap_or_else(unknown),
        fs::read_to_string("/proc/loadavg").map_or_else(unknown, |load| {
            load.split(' ').take(3).collect::<Vec<_>>().join(", ")
        }),
    )
}
