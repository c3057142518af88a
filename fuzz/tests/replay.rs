//! Every seed and every file of the corpora goes through its target.

#![allow(clippy::unwrap_used)] // tests may stop at a surprise

use std::fs;
use std::panic::catch_unwind;
use std::path::{Path, PathBuf};

use actucheck_fuzz::{TARGETS, Target};

/// The files of a folder, which has to be there.
fn files(folder: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let entries =
        fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    entries.map(|entry| entry.unwrap().path()).collect()
}

/// Feeds the files to the target and tells which of them it fails on.
fn replay(target: &Target, files: &[PathBuf]) {
    for file in files {
        let input = fs::read(file).unwrap();
        let passed = catch_unwind(|| (target.check)(&input)).is_ok();
        assert!(passed, "{} fails on {}", target.name, file.display());
    }
}

#[test]
fn every_seed_passes() {
    for target in TARGETS {
        let seeds = files(&format!("seeds/{}", target.seeds.name()));
        assert!(seeds.len() >= 7, "{}: {} seeds", target.name, seeds.len());
        replay(target, &seeds);
    }
}
