//! The table of planted bugs has each that the sources have, and a target for it.

#![allow(clippy::unwrap_used, clippy::indexing_slicing)] // tests may stop at a surprise

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use actucheck_fuzz::TARGETS;

/// The names of the bugs in the sources below a folder.
fn planted(folder: &Path, bugs: &mut BTreeSet<String>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            planted(&path, bugs);
        } else {
            let text = fs::read_to_string(path).unwrap();
            let calls = text.split("planted!(").skip(1);
            bugs.extend(calls.map(|call| call.split('"').nth(1).unwrap().to_owned()));
        }
    }
}

#[test]
fn every_bug_is_in_the_table_and_every_target_has_one() {
    let top = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut bugs = BTreeSet::new();
    planted(&top.join("../codec/src"), &mut bugs);
    planted(&top.join("../spec/src"), &mut bugs);

    let table = fs::read_to_string(top.join("planted.tsv")).unwrap();
    let rows = table.lines().map(|line| line.split('\t').collect::<Vec<_>>());
    let (mut named, mut targets) = (BTreeSet::new(), BTreeSet::new());
    for row in rows {
        assert_eq!(row.len(), 3, "{row:?}");
        targets.insert(row[0].to_owned());
        named.insert(row[1].to_owned());
    }
    assert_eq!(named, bugs);
    assert_eq!(targets, TARGETS.iter().map(|target| target.name.to_owned()).collect());
}
