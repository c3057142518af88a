//! Every seed and every file of the corpora is an input of its target's test.

#![allow(clippy::unwrap_used, clippy::panic)] // tests may stop at a surprise

use std::fs;
use std::panic::catch_unwind;
use std::path::{Path, PathBuf};

use actucheck_fuzz::targets::{innfos_stream, packet, stream_raw};
use actucheck_fuzz::{TARGETS, Target};
use actucheck_spec::Spec;
use actucheck_spec::model::{Outcome, Vector, VectorsFile};

/// How many files a corpus has: less and it was not made, more and nobody minimised it.
const CORPUS: std::ops::RangeInclusive<usize> = 20..=500;

/// The files of a folder, which has to be there.
fn files(folder: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let entries = fs::read_dir(&folder);
    let entries = entries.unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    entries.map(|entry| entry.unwrap().path()).collect()
}

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
        assert!(seeds.len() >= 20, "{}: {} seeds", target.name, seeds.len());
        replay(target, &seeds);
    }
}

#[test]
fn every_corpus_is_there_and_passes() {
    for target in TARGETS {
        let corpus = files(&format!("corpus/{}", target.name));
        let count = corpus.len();
        assert!(CORPUS.contains(&count), "{}: {count} files, not {CORPUS:?}", target.name);
        replay(target, &corpus);
    }
}

#[test]
fn every_repaired_seed_passes() {
    for target in TARGETS {
        let Some(repair) = target.repair else { continue };
        for seed in files(&format!("seeds/{}", target.seeds.name())) {
            let mut input = fs::read(&seed).unwrap();
            repair(&mut input);
            (target.check)(&input);
        }
    }
}

/// A test vector gets back its bytes.
#[test]
fn repair_gives_the_right_crc() {
    let spec = Spec::embedded().unwrap();
    let valid = |(_, vector): &(&VectorsFile, &Vector)| vector.result == Outcome::Valid;
    let mut repaired = 0;
    for (file, vector) in spec.vectors().filter(valid) {
        let (repairs, behind_crc) = match file.wire.id() {
            "dynamixel2" => (vec![packet::repair, stream_raw::repair], 0),
            // The end byte follows the CRC. A shorter frame may have none.
            _ if vector.frame().len() > 9 => (vec![innfos_stream::repair as fn(&mut [u8])], 1),
            _ => continue,
        };
        for repair in repairs {
            let mut input = vector.frame().to_vec();
            input.iter_mut().rev().skip(behind_crc).take(2).for_each(|byte| *byte ^= 0x5A);
            assert_ne!(input, vector.frame());
            repair(&mut input);
            assert_eq!(input, vector.frame(), "{}", vector.id);
            repaired += 1;
        }
    }
    assert!(repaired > 100, "{repaired} packets");
}
