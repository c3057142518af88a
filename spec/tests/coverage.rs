//! The tests that requirements name exist.

#![allow(clippy::unwrap_used)] // tests may stop at a surprise

use std::fs;
use std::path::Path;

use actucheck_spec::Spec;
use actucheck_spec::model::Role;

#[test]
fn every_test_that_a_requirement_names_is_there() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let spec = Spec::embedded().unwrap();
    let mut tests = 0;
    for row in spec.requirements.iter().flat_map(|file| &file.content.requirements) {
        for test in &row.tests {
            let (file, name) = test.split_once("::").unwrap();
            let text = fs::read_to_string(root.join(file)).unwrap_or_default();
            assert!(text.contains(&format!("fn {name}(")), "{}: no test {test}", row.id);
            assert!(row.binds.contains(&Role::Codec), "{} binds no codec", row.id);
            tests += 1;
        }
    }
    assert!(tests > 0, "no requirement names a test");
}
