//! The bugs of `planted.tsv` can be planted: each text is there, once, and each target has a bug.

#![allow(clippy::unwrap_used)] // tests may stop at a surprise

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use actucheck_fuzz::TARGETS;

#[test]
fn every_text_stands_once_in_its_file_and_every_target_has_a_bug() {
    let top = Path::new(env!("CARGO_MANIFEST_DIR"));
    let table = fs::read_to_string(top.join("planted.tsv")).unwrap();
    let (mut bugs, mut targets) = (BTreeSet::new(), BTreeSet::new());
    for row in table.lines() {
        let fields: Vec<_> = row.split('\t').collect();
        let [target, bug, _what, file, text, becomes] = fields[..] else {
            panic!("six fields with tabs between: {row}");
        };
        let source = fs::read_to_string(top.join("..").join(file)).unwrap();
        assert_eq!(source.matches(text).count(), 1, "{bug}: {text:?} in {file}");
        assert_ne!(text, becomes, "{bug}");
        assert!(bugs.insert(bug), "{bug} is there twice");
        targets.insert(target);
    }
    assert_eq!(targets, TARGETS.iter().map(|target| target.name).collect());
}
