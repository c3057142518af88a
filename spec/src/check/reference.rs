//! What is named exists: registers, instructions, protocols, requirements, errata.

use crate::load::File;
use crate::model::{Area, Bound, Device};
use crate::{Diagnostic, Spec};

pub(super) fn check(spec: &Spec) -> Vec<Diagnostic> {
    let mut defects = Vec::new();
    protocols(spec, &mut defects);
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
            let unknown = unknown_erratum(spec, &register.errata);
            defects.extend(unknown.map(|text| file.diagnostic(&format!("{node}.errata"), text)));
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
        if spec.protocol(&file.content.wire).is_none() {
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

fn unknown_erratum(spec: &Spec, ids: &[String]) -> impl Iterator<Item = String> {
    ids.iter()
        .filter(|id| spec.erratum(id).is_none())
        .map(|id| format!("unknown erratum `{id}`; errata.yaml has no such row"))
}

fn no_register(device: &Device, name: &str) -> String {
    format!("{} has no register `{name}`", device.title)
}

#[cfg(test)]
mod tests {
    use crate::Spec;
    use crate::load::{Source, embedded};

    /// What is wrong with the JA40 after one replacement in its file.
    fn defects_with(text: &str, other: &str) -> Vec<String> {
        let replaced = |file: Source| match file.path.as_str() {
            "spec/devices/ja40.yaml" => {
                Source::new("devices/ja40.yaml", &file.text.replacen(text, other, 1))
            }
            _ => file,
        };
        let sources: Vec<_> = embedded().into_iter().map(replaced).collect();
        let defects = Spec::read(&sources).unwrap_err();
        defects.into_iter().map(|defect| defect.message).collect()
    }

    #[test]
    fn a_backup_names_registers_of_the_ram_area() {
        let item = "  - Position I Gain";
        assert_eq!(
            defects_with(item, "  - Position X Gain"),
            ["JA40 has no register `Position X Gain`"]
        );
        assert_eq!(
            defects_with(item, "  - Homing Offset"),
            ["Homing Offset is in the EEPROM area, which every backup holds"]
        );
    }

    #[test]
    fn an_alarm_names_a_bit_and_registers() {
        assert_eq!(
            defects_with("{bit: Overheating Error", "{bit: Overheated"),
            ["JA40 has no bit `Overheated`"]
        );
        assert_eq!(
            defects_with("above: Temperature Limit", "above: Heat Limit"),
            ["JA40 has no register `Heat Limit`"]
        );
    }
}
