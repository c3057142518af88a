//! YAML that is made to exhaust its reader is refused quickly.

#![allow(clippy::unwrap_used)] // tests may stop at a surprise

use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

use actucheck_spec::load::Source;
use actucheck_spec::wire::Wire;
use actucheck_spec::{Diagnostic, Spec};

const DEEP: usize = 100_000;
/// Ten times the time of the slowest case, so that a busy machine fails nothing. Without the limits
/// it takes minutes.
const LIMIT: Duration = Duration::from_secs(10);

/// The defects of a device, in the small spec of `tests/base`.
fn defects(device: &str) -> Vec<Diagnostic> {
    let base = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/base");
    let file = |path: &str| Source::new(path, &fs::read_to_string(base.join(path)).unwrap());
    let wires = Wire::ALL.map(|wire| file(&format!("wires/{wire}.yaml")));
    let others =
        ["documents.yaml", "errata.yaml", "vectors/ping.yaml", "requirements/book.yaml"].map(file);
    let mut sources = [&wires[..], &others].concat();
    sources.push(Source::new("devices/motor.yaml", device));
    let start = Instant::now();
    let defects = Spec::read(&sources).unwrap_err();
    for defect in &defects {
        assert!(!defect.excerpt().is_empty());
    }
    assert!(start.elapsed() < LIMIT, "{:?}", start.elapsed());
    defects
}

#[test]
fn what_nests_deep_is_refused() {
    for deep in ["[", "{a: ", "- ", "[{a: ", "? "] {
        // Only one of the two readers rejects the last one.
        for before in ["", "device: ", "device:\tmotor\n"] {
            let found = defects(&format!("{before}{}", deep.repeat(DEEP)));
            assert_eq!(found.len(), 1, "{found:?}");
        }
    }
}

#[test]
fn aliases_of_aliases_are_refused() {
    let mut text = "device: &a0 [x, x]\n".to_owned();
    for level in 1..60 {
        let below = level - 1;
        writeln!(text, "a{level}: &a{level} [*a{below}, *a{below}]").unwrap();
    }
    for text in [&text, "device: &a [*a, *a]"] {
        let found = defects(text);
        assert_eq!(found.len(), 1, "{found:?}");
    }
}

#[test]
fn a_long_file_is_refused() {
    let found = defects(&"#\n".repeat(1 << 20));
    let messages: Vec<_> = found.iter().map(|defect| &defect.message[..]).collect();
    assert_eq!(messages, ["2097152 bytes; at most 1048576 are allowed: split the file"]);
}

/// A defect's place is looked up without reading the whole file for each.
#[test]
fn many_defects_are_told_soon() {
    let head =
        "device: motor\ntitle: Motor\nwire: dynamixel2\nsource: [book §2]\ninstructions: [Ping]\n";
    let row = "  - {address: 0, name: A, type: u16, area: ram, access: rw, source: [book §2]}\n";
    let found = defects(&format!("{head}registers:\n{}", row.repeat(2000)));
    assert!(found.len() >= 2000, "{}", found.len());
}
