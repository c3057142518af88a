//! The generated files in this folder are up to date.
//!
//! `ACCEPT=1 cargo test --workspace --test published` writes the files anew.

#![allow(clippy::unwrap_used)] // tests may stop at a surprise

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use actucheck_fuzz::published::{self, File};
use actucheck_spec::Spec;

/// The folders with nothing but generated files.
const FOLDERS: [&str; 3] = ["seeds", "dictionaries", "options"];

fn generated() -> BTreeMap<String, Vec<u8>> {
    let files = published::all(&Spec::embedded().unwrap());
    files.into_iter().map(|File { path, bytes }| (path, bytes)).collect()
}

/// The files below a folder by their paths from the top.
fn read(top: &Path, folder: &str, files: &mut BTreeMap<String, Vec<u8>>) {
    for entry in fs::read_dir(top.join(folder)).unwrap() {
        let entry = entry.unwrap();
        let path = format!("{folder}/{}", entry.file_name().into_string().unwrap());
        if entry.path().is_dir() {
            read(top, &path, files);
        } else {
            files.insert(path, fs::read(entry.path()).unwrap());
        }
    }
}

#[test]
fn the_generated_files_are_fresh() {
    let top = Path::new(env!("CARGO_MANIFEST_DIR"));
    let generated = generated();
    if std::env::var_os("ACCEPT").is_some() {
        for folder in FOLDERS {
            let _ = fs::remove_dir_all(top.join(folder)); // there may be none yet
        }
        for (path, bytes) in &generated {
            fs::create_dir_all(top.join(path).parent().unwrap()).unwrap();
            fs::write(top.join(path), bytes).unwrap();
        }
    }
    let mut there = BTreeMap::new();
    for folder in FOLDERS {
        read(top, folder, &mut there);
    }
    let stale: Vec<_> = generated
        .keys()
        .chain(there.keys())
        .filter(|path| generated.get(*path) != there.get(*path))
        .collect();
    assert!(stale.is_empty(), "stale: {stale:?}; ACCEPT=1 cargo test --workspace --test published");
}
