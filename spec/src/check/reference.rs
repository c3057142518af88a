//! What is named exists: registers, instructions, protocols, requirements, errata.

use super::innfos;
use crate::load::File;
use crate::model::{Area, Bound, Condition, Device};
use crate::{Diagnostic, Spec};

pub(super) fn check(spec: &Spec) -> Vec<Diagnostic> {
    let mut defects = Vec::new();
    protocols(spec, &mut defects);
    commands(spec, &mut defects);
    devices(spec, &mut defects);
    vectors(spec, &mut defects);
    defects
}

fn protocols(spec: &Spec, defects: &mut Vec<Diagnostic>) {
    for file in &spec.protocols {
        let protocol = &file.content;
        let parts = [
            ("framing", &protocol.framing.errata),
            ("crc", &protocol.crc.errata),
            ("stuffing", &protocol.stuffing.errata),
            ("status", &protocol.status.errata),
        ];
        for (part, errata) in parts {
            let node = format!("{part}.errata");
            defects.extend(unknown_erratum(spec, errata).map(|text| file.diagnostic(&node, text)));
        }
        for (index, row) in protocol.instructions.iter().enumerate() {
            let node = format!("instructions[{index}].errata");
            let unknown = unknown_erratum(spec, &row.errata);
            defects.extend(unknown.map(|text| file.diagnostic(&node, text)));
        }
    }
}

fn commands(spec: &Spec, defects: &mut Vec<Diagnostic>) {
    let file = &spec.innfos;
    for part in innfos::parts(&file.content) {
        let node = format!("{}.errata", part.node);
        let unknown = unknown_erratum(spec, part.errata);
        defects.extend(unknown.map(|text| file.diagnostic(&node, text)));
    }
    for (index, code) in file.content.crc_presence.open.iter().enumerate() {
        if file.content.command(*code).is_none() {
            let message = format!("there is no command {code:#04X}");
            defects.push(file.diagnostic(&format!("crc_presence.open[{index}]"), message));
        }
    }
}

fn devices(spec: &Spec, defects: &mut Vec<Diagnostic>) {
    for file in &spec.devices {
        let device = &file.content;
        let unknown = unknown_erratum(spec, &device.errata);
        defects.extend(unknown.map(|text| file.diagnostic("errata", text)));

        let Some(protocol) = spec.protocol(&device.protocol) else {
            let message = format!("unknown protocol `{}`", device.protocol);
            defects.push(file.diagnostic("protocol", message));
            continue;
        };
        for (index, name) in device.instructions.iter().enumerate() {
            if !protocol.instructions.iter().any(|instruction| instruction.name == *name) {
                let message = format!("{} has no instruction `{name}`", protocol.title);
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

/// What a condition is on exists.
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
        if !spec.has_wire(&file.content.wire) {
            let message = format!("unknown protocol `{}`", file.content.wire);
            defects.push(file.diagnostic("wire", message));
        }
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
