//! The tests that requirements name exist, a conversation or a reason is there for each that binds a device,
//! and checks count for whom they ask.

#![allow(clippy::unwrap_used, clippy::indexing_slicing)] // tests may stop at a surprise

use std::fs;
use std::path::Path;

use actucheck_spec::Spec;
use actucheck_spec::coverage::{CheckName, Checks, Cover, matrix, total};
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

#[test]
fn a_check_covers_the_role_that_it_is_asked_of_and_no_other() {
    let spec = Spec::embedded().unwrap();
    let role = Role::Codec;
    let check = |id, requirement| CheckName { id, requirement, role, only_records: false };
    let checks = [
        check("a", "ja40.packets"),
        check("b", "ja40.packets"),
        check("c", "dynamixel2.bulk-read.no-repeat"),
    ];
    let rows = matrix(&spec, checks);
    let row = |id| rows.iter().find(|row| row.requirement.id == id).unwrap();

    let packets = row("ja40.packets");
    assert_eq!(
        packets.checks[&Role::Codec],
        Checks { count: 2, recorded: 0, example: "a".to_owned() }
    );
    assert_eq!(packets.cover(Role::Codec), Cover::Check);
    assert_eq!(packets.cover(Role::Host), Cover::Nothing);
    let of_hosts = row("dynamixel2.bulk-read.no-repeat");
    assert!(of_hosts.is_uncovered() && of_hosts.checks.contains_key(&Role::Codec));

    let total = total(&rows, Role::Codec, Level::Must);
    assert_eq!(total.checked, 1);
    assert_eq!(total.unchecked() + total.tested + 1, total.requirements);
}

#[test]
fn checks_of_the_same_sentence_count_for_the_roles_that_no_check_of_its_own_asks() {
    let spec = Spec::embedded().unwrap();
    let (own, same) = ("ja40.ping.status", "dynamixel2.ping.status");
    let check = |id, requirement, role| CheckName { id, requirement, role, only_records: false };
    let checks = [
        check("own", own, Role::Codec),
        check("other", same, Role::Codec),
        check("host", same, Role::Host),
    ];
    let rows = matrix(&spec, checks);
    let row = rows.iter().find(|row| row.requirement.id == own).unwrap();
    assert_eq!(row.checks[&Role::Codec].example, "own");
    assert_eq!(row.checks[&Role::Host].example, "host");
}

#[test]
fn checks_that_only_record_do_not_count_as_checked() {
    let spec = Spec::embedded().unwrap();
    let (requirement, role) = ("dynamixel2.receive.id", Role::Codec);
    let check = |id, only_records| CheckName { id, requirement, role, only_records };
    let rows = matrix(&spec, [check("a", true), check("b", true)]);
    let row = rows.iter().find(|row| row.requirement.id == requirement).unwrap();
    assert_eq!(row.cover(role), Cover::Record);
    let total = total(&rows, role, Level::Must);
    assert_eq!((total.checked, total.recorded), (0, 1));

    let rows = matrix(&spec, [check("a", true), check("b", false)]);
    let row = rows.iter().find(|row| row.requirement.id == requirement).unwrap();
    assert_eq!(row.cover(role), Cover::Check);
    assert_eq!(row.checks[&role], Checks { count: 2, recorded: 1, example: "b".to_owned() });
}
