//! Inputs that a target failed on, minimised, each with a test of its name.

#![allow(clippy::unwrap_used)] // tests may stop at a surprise

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use actucheck_fuzz::TARGETS;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("regressions")
}

fn replay(target: &str, name: &str) {
    let target = TARGETS.iter().find(|row| row.name == target).unwrap();
    (target.check)(&fs::read(folder().join(target.name).join(name)).unwrap());
}

macro_rules! regressions {
    ($($(#[$doc:meta])* $target:ident: $name:ident;)*) => {
        const NAMES: &[(&str, &str)] = &[$((stringify!($target), stringify!($name))),*];

        $($(#[$doc])*
        #[test]
        fn $name() {
            replay(stringify!($target), stringify!($name));
        })*
    };
}

regressions! {
    /// The reference took the end byte and the next frame's first for the CRC.
    innfos_stream: open_reply_before_another_frame;
    /// The reference reported the CRC, although the extra bytes after the frame come first.
    innfos_frame: wrong_crc_and_trailing_bytes;
    /// The codec named the ID, though the packet ends within its prefix.
    packet: prefix_that_ends_at_a_wrong_id;
    /// What follows another line end than the usual one was taken for the comment before it, and written twice.
    #[cfg(feature = "suite")]
    readers: comment_that_ends_early;
    /// A number of an answer was read as its neighbour.
    #[cfg(feature = "suite")]
    readers: number_to_its_last_bit;
    /// The codec compared the lowest byte of a value that a register of one byte can't hold.
    register: condition_on_a_value_beyond_its_register;
}

#[test]
fn every_file_has_its_test() {
    let mut files = BTreeSet::new();
    for target in fs::read_dir(folder()).unwrap() {
        let target = target.unwrap();
        for file in fs::read_dir(target.path()).unwrap() {
            let names = [target.file_name(), file.unwrap().file_name()];
            files.insert(names.map(|name| name.into_string().unwrap()));
        }
    }
    let named = NAMES.iter().map(|(target, name)| [(*target).to_owned(), (*name).to_owned()]);
    assert_eq!(files, named.collect());
}
