//! The tests that requirements name exist, and a conversation or a reason is there for each that binds a
//! device.

#![allow(clippy::unwrap_used)] // tests may stop at a surprise

use std::fs;
use std::path::Path;

use actucheck_spec::Spec;
use actucheck_spec::model::{Level, Role};

#[test]
fn every_test_that_a_requirement_names_is_there() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let spec = Spec::embedded().unwrap();
    let mut tests = 0;
    for row in spec.requirements.iter().flat_map(|file| &file.content.requirements) {
        for test in &row.tests {
            let (file, name) = test.split_once("::").unwrap_or((test, &row.id));
            let (role, line) = if test.contains("::") {
                (Role::Codec, format!("fn {name}("))
            } else {
                (Role::Device, name.to_owned())
            };
            let text = fs::read_to_string(root.join(file)).unwrap_or_default();
            assert!(text.contains(&line), "{}: no test {test}", row.id);
            assert!(row.binds.contains(&role), "{} binds no {role}", row.id);
            tests += 1;
        }
    }
    assert!(tests > 0, "no requirement names a test");
}

/// What devices may do either way needs neither.
#[test]
fn packets_show_what_devices_do_or_there_is_a_reason_why_not() {
    let spec = Spec::embedded().unwrap();
    let mut rows = 0;
    for row in spec.requirements.iter().flat_map(|file| &file.content.requirements) {
        if row.level != Level::May && row.binds.contains(&Role::Device) {
            let is_shown = row.is_tested(Role::Device) || row.unseen.device.is_some();
            assert!(is_shown, "{} has no conversation and no reason", row.id);
            rows += 1;
        }
    }
    assert!(rows > 0, "no requirement binds a device");
}
