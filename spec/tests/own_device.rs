//! A user's own device: defects of its YAML are reported with their places.

#![allow(clippy::unwrap_used, clippy::indexing_slicing)] // tests may stop at a surprise

use actucheck_spec::generate::device_from_yaml;

const GRIPPER: &str = include_str!("../../codec/examples/own-device/gripper.yaml");

/// The defects of the YAML after replacing a text that occurs in it once.
#[track_caller]
fn defects(text: &str, other: &str) -> Vec<String> {
    assert_eq!(GRIPPER.matches(text).count(), 1, "{text}");
    let defects = device_from_yaml("gripper.yaml", &GRIPPER.replace(text, other)).unwrap_err();
    defects.iter().map(ToString::to_string).collect()
}

#[test]
fn the_example_is_right() {
    let source = device_from_yaml("gripper.yaml", GRIPPER).unwrap();
    assert!(source.contains("pub mod gripper"));
    assert!(source.contains("use actucheck_codec::register::"));
}

#[test]
fn a_defect_has_its_place() {
    let cases = [
        ("name: ID, type: u8", "name: ID, type: u9", "gripper.yaml:12:34: "),
        ("lowest: 1, width: 1", "lowest: 1, size: 1", "gripper.yaml:61:36: "),
        ("Max Force, max: Max Force", "Max Force, max: Max Power", "gripper.yaml:42:35: "),
        ("address: 70", "address: 69", "gripper.yaml:46:14: "),
        ("instructions: [Ping", "instructions: [Pong", "gripper.yaml:8:16: "),
        ("[manual §4.5]", "[]", "gripper.yaml:52:5: "),
        ("name: Present Width", "name: 3D Width", "gripper.yaml:47:11: "),
        ("name: Present Width", "name: goal-force", "gripper.yaml:47:11: "),
        ("name: Grip Status", "name: Device", "gripper.yaml:55:11: "),
        ("{value: 1, name: On}", "{value: 1, name: Off}", "gripper.yaml:33:26: "),
    ];
    for (text, other, place) in cases {
        let defects = defects(text, other);
        assert!(defects[0].starts_with(place), "{other}: {defects:#?}");
    }
}
