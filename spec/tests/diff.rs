//! What differs between two devices is told once.

#![allow(clippy::unwrap_used)] // tests may stop at a surprise

use actucheck_spec::diff::{Diff, Difference, Only};
use actucheck_spec::model::Device;

const LEFT: &str = "
device: left
title: Left
wire: dynamixel2
source: []
instructions: [Ping, Clear]
alarms: [{bit: Hot, register: Heat, above: Limit}]
registers:
  - {address: 0, name: Heat, type: u8, area: eeprom, access: r, initial: 3, source: []}
  - {address: 1, name: Limit, type: u8, area: ram, access: rw, source: [], values: [{value: 0, name: Off}]}
  - {address: 2, name: Flags, type: u8, area: ram, access: r, source: [], bits: [{name: A, lowest: 0}]}
";

fn device(text: &str) -> Device {
    serde_yaml::from_str(text).unwrap()
}

fn told(differences: &[Difference]) -> Vec<String> {
    let row = |row: &Difference| format!("{}: {}, {}", row.fact, row.left, row.right);
    differences.iter().map(row).collect()
}

#[test]
fn a_device_does_not_differ_from_itself() {
    assert!(Diff::of(&device(LEFT), &device(LEFT)).is_empty());
}

#[test]
fn each_fact_that_differs_is_told_once() {
    let right = LEFT
        .replace("Ping, Clear", "Ping, Read")
        .replace("bit: Hot", "bit: Warm")
        .replace(
            "type: u8, area: eeprom, access: r, initial: 3",
            "type: i16, area: ram, access: rw",
        )
        .replace("name: Off", "name: \"Off, or so\"")
        .replace("{name: A, lowest: 0}", "{name: B, lowest: 0, width: 2}, {name: C, lowest: 2}");
    let (left, right) = (device(LEFT), device(&right));
    let diff = Diff::of(&left, &right);
    assert_eq!(
        told(&diff.device),
        [
            "instruction Clear: yes, -",
            "instruction Read: -, yes",
            "alarm, Heat above Limit: Hot, Warm"
        ]
    );
    let registers: Vec<_> = diff.registers.iter().map(|row| told(&row.differences)).collect();
    assert_eq!(
        registers,
        [
            vec!["type: u8, i16", "area: EEPROM, RAM", "access: R, RW", "initial: 3, not told"],
            vec!["value 0: Off, Off, or so"],
            vec!["bit 0: A, B, 2 bits", "bit 2: -, C"],
        ]
    );
}

#[test]
fn a_register_of_one_device_tells_where_the_other_has_its_name() {
    let right = LEFT.replace("address: 2, name: Flags", "address: 9, name: Flags");
    let (left, right) = (device(LEFT), device(&right));
    let diff = Diff::of(&left, &right);
    let at = |rows: &[Only<'_>]| -> Vec<_> {
        rows.iter().map(|row| (row.register.address, row.elsewhere)).collect()
    };
    assert_eq!(at(&diff.only_left), [(2, Some(9))]);
    assert_eq!(at(&diff.only_right), [(9, Some(2))]);
}
