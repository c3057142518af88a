//! Whether each requirement that a check judges has a fault that the check finds.

use std::collections::{BTreeMap, BTreeSet};

use actucheck::adapter::Wire;
use actucheck::suite;
use actucheck::suite::device::Target;
use actucheck_spec::Spec;
use actucheck_spec::model::Level;

use super::every;
use super::fault::Fault;

/// The must rows of which no fault is found by one of their checks, a line each.
pub(crate) fn without_a_fault() -> String {
    let spec = Spec::embedded().unwrap();
    let tables = spec.devices.iter().map(|file| Some(&file.content));
    // A check that finds a fault of one device would find it of another.
    let finds: BTreeSet<_> = every().map(Fault::check).collect();
    let mut found: BTreeMap<String, bool> = BTreeMap::new();
    for device in tables.chain([None]) {
        let target = Target::alone(device).with_neighbour(2, device);
        let wires = device.map_or_else(|| Wire::ALL.to_vec(), |device| vec![device.wire]);
        for check in suite::device_plan(&spec, &wires, &target).checks() {
            if check.level == Level::Must && !check.only_records() {
                *found.entry(check.requirement).or_default() |= finds.contains(&check.id);
            }
        }
    }
    assert!(found.len() > 200, "{} rows are judged", found.len());
    let without = found.into_iter().filter(|(_, is_found)| !is_found);
    let lines: Vec<_> =
        without.map(|(requirement, _)| format!("{requirement} has no fault")).collect();
    lines.join("\n")
}
