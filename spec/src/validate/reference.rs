//! Rule: every name refers to something that exists: registers, instructions, requirements, errata.

use crate::load::File;
use crate::model::{Area, Bound, Condition, Device};
use crate::wire::Wire;
use crate::{Diagnostic, Spec};

pub(super) fn check(spec: &Spec) -> Vec<Diagnostic> {
    let mut defects = Vec::new();
    wires(spec, &mut defects);
    devices(spec, &mut defects);
    vectors(spec, &mut defects);
    defects
}

fn wires(spec: &Spec, defects: &mut Vec<Diagnostic>) {
    for wire in Wire::ALL {
        for part in wire.cited(spec) {
            let node = format!("{}.errata", part.node);
            let unknown = unknown_erratum(spec, part.errata);
            defects.extend(unknown.map(|text| wire.diagnostic(spec, &node, text)));
        }
    }
}

fn devices(spec: &Spec, defects: &mut Vec<Diagnostic>) {
    for file in &spec.devices {
        let device = &file.content;
        let unknown = unknown_erratum(spec, &device.errata);
        defects.extend(unknown.map(|text| file.diagnostic("errata", text)));

        let instructions = device.wire.asks(spec);
        for (index, name) in device.instructions.iter().enumerate() {
            if !instructions.iter().any(|row| row.name == name) {
                let message = format!("{} has no instruction `{name}`", device.wire);
                defects.push(file.diagnostic(&format!("instructions[{index}]"), message));
            }
        }
        if let Some(name) = &device.eeprom_lock
            && device.register(name).is_none()
        {
            defects.push(file.diagnostic("eeprom_lock", no_register(device, name)));
        }
        alarms(file, defects);
        backup(file, defects);
        for (index, register) in device.registers.iter().enumerate() {
            let node = format!("registers[{index}]");
            let unknown = unknown_erratum(spec, register.all_errata());
            defects.extend(unknown.map(|text| file.diagnostic(&format!("{node}.errata"), text)));
            for (place, meaning) in register.meanings.iter().enumerate() {
                let node = format!("{node}.meanings[{place}].when");
                defects.extend(condition(file, &node, &meaning.when));
            }
            let Some(range) = &register.range else {
                continue;
            };
            for (end, bound) in [("min", &range.min), ("max", &range.max)] {
                if let Some(Bound::Register(name)) = bound
                    && device.register(name.trim_start_matches('-')).is_none()
                {
                    let message = no_register(device, name.trim_start_matches('-'));
                    defects.push(file.diagnostic(&format!("{node}.range.{end}"), message));
                }
            }
        }
    }
}

fn alarms(file: &File<Device>, defects: &mut Vec<Diagnostic>) {
    let device = &file.content;
    for (index, alarm) in device.alarms.iter().enumerate() {
        let bits = device.registers.iter().flat_map(|register| &register.bits);
        if !bits.into_iter().any(|bit| bit.name == alarm.bit) {
            let message = format!("{} has no bit `{}`", device.title, alarm.bit);
            defects.push(file.diagnostic(&format!("alarms[{index}].bit"), message));
        }
        if alarm.below.is_none() && alarm.above.is_none() {
            let message = "an alarm has `below`, `above` or both".to_owned();
            defects.push(file.diagnostic(&format!("alarms[{index}]"), message));
        }
        if let Some(when) = &alarm.when {
            defects.extend(condition(file, &format!("alarms[{index}].when"), when));
        }
        let names = [
            ("register", Some(&alarm.register)),
            ("below", alarm.below.as_ref()),
            ("above", alarm.above.as_ref()),
        ];
        for (field, name) in names {
            if let Some(name) = name.filter(|name| device.register(name).is_none()) {
                let node = format!("alarms[{index}].{field}");
                defects.push(file.diagnostic(&node, no_register(device, name)));
            }
        }
    }
}

/// Rule: the register and bits of a condition exist.
fn condition(file: &File<Device>, node: &str, condition: &Condition) -> Option<Diagnostic> {
    let device = &file.content;
    let Some(register) = device.register(&condition.register) else {
        let message = no_register(device, &condition.register);
        return Some(file.diagnostic(&format!("{node}.register"), message));
    };
    let name = condition.bits.as_ref().filter(|name| register.bit_field(name).is_none())?;
    let message = format!("{} has no bits `{name}`", register.name);
    Some(file.diagnostic(&format!("{node}.bits"), message))
}

fn backup(file: &File<Device>, defects: &mut Vec<Diagnostic>) {
    let device = &file.content;
    for (index, name) in device.backup.iter().enumerate() {
        let message = match device.register(name) {
            None => no_register(device, name),
            Some(register) if register.area == Area::Eeprom => {
                format!("{name} is in the EEPROM area, which every backup holds")
            }
            Some(_) => continue,
        };
        defects.push(file.diagnostic(&format!("backup[{index}]"), message));
    }
}

fn vectors(spec: &Spec, defects: &mut Vec<Diagnostic>) {
    for file in &spec.vectors {
        for (index, vector) in file.content.vectors.iter().enumerate() {
            let node = format!("vectors[{index}]");
            let unknown = unknown_erratum(spec, &vector.errata);
            defects.extend(unknown.map(|text| file.diagnostic(&format!("{node}.errata"), text)));
            if let Some(id) = &vector.requirement
                && spec.requirement(id).is_none()
            {
                let message = format!("unknown requirement `{id}`");
                defects.push(file.diagnostic(&format!("{node}.requirement"), message));
            }
        }
    }
}

fn unknown_erratum<'a>(
    spec: &Spec,
    ids: impl IntoIterator<Item = &'a String>,
) -> impl Iterator<Item = String> {
    ids.into_iter()
        .filter(|id| spec.erratum(id).is_none())
        .map(|id| format!("unknown erratum `{id}`; errata.yaml has no such row"))
}

fn no_register(device: &Device, name: &str) -> String {
    format!("{} has no register `{name}`", device.title)
}
