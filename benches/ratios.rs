//! Keeps criterion's measurements, and makes `RESULTS.md` and pictures from all that is kept.
//!
//! `cargo run --release -p actucheck-benches [keep [FOLDER…]]`: with `keep`, right after `cargo bench`, the
//! measurements in the folders, a folder a run, else in `target/criterion`, are kept in `runs/machines/` first.

use std::io;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::{env, fs};

use actucheck_benches::kept::{Machine, Run};
use actucheck_benches::results::Kept;
use actucheck_benches::{measured, results};

fn main() -> ExitCode {
    let arguments: Vec<_> = env::args_os().skip(1).collect();
    let folders = match arguments.as_slice() {
        [] => Vec::new(),
        [keep] if keep == "keep" => vec![here().join("../target/criterion")],
        [keep, folders @ ..] if keep == "keep" => folders.iter().map(PathBuf::from).collect(),
        _ => {
            eprintln!("ratios: say `keep`, with or without folders of criterion's, or nothing");
            return ExitCode::from(2);
        }
    };
    match run(&folders) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("ratios: {error}");
            ExitCode::FAILURE
        }
    }
}

fn here() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn run(measured: &[PathBuf]) -> io::Result<()> {
    let folder = here().join("runs");
    let runs: Vec<_> = measured.iter().map(|run| measured::read(run)).collect::<io::Result<_>>()?;
    if !runs.is_empty() {
        Run { machine: Machine::here(runs.len()), measured: measured::fastest(&runs) }
            .keep(&folder.join(results::MACHINES))?;
    }
    let kept = Kept::read(&folder)?;
    let results = here().join("RESULTS.md");
    let new = results::renewed(&fs::read_to_string(&results)?, &kept);
    fs::write(&results, new.ok_or_else(|| io::Error::other("RESULTS.md has lost its marks"))?)?;
    for (name, picture) in kept.pictures() {
        fs::write(folder.join(name), picture)?;
    }
    println!("wrote {}", results.display());
    Ok(())
}
