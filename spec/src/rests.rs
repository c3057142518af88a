//! What rests on an erratum: everything of the spec that names it.

use std::fmt;

use crate::Spec;
use crate::model::{Device, Requirement, Vector};
use crate::wire::Wire;

/// Something that rests on an erratum.
#[derive(Clone, Debug)]
pub enum Rests<'a> {
    /// A requirement.
    Requirement(&'a Requirement),
    /// A test vector.
    Vector(&'a Vector),
    /// A device as a whole.
    Device(&'a Device),
    /// A register or an alarm of a device, by its name.
    Register(&'a Device, &'a str),
    /// A part of a wire, by its name.
    Wire(String),
}

impl fmt::Display for Rests<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Requirement(row) => write!(f, "requirement {}", row.id),
            Self::Vector(row) => write!(f, "vector {}", row.id),
            Self::Device(device) => write!(f, "device {}", device.device),
            Self::Register(device, name) => write!(f, "register {}/{name}", device.device),
            Self::Wire(part) => f.write_str(part),
        }
    }
}

/// Everything that names an erratum, with the erratum's id, in the order of the files.
#[must_use]
pub fn all(spec: &Spec) -> Vec<(&str, Rests<'_>)> {
    let mut all = Vec::new();
    for row in spec.requirements.iter().flat_map(|file| &file.content.requirements) {
        push(&mut all, &row.errata, &Rests::Requirement(row));
    }
    for (_, vector) in spec.vectors() {
        push(&mut all, &vector.errata, &Rests::Vector(vector));
    }
    for file in &spec.devices {
        device(&file.content, &mut all);
    }
    for part in Wire::ALL.into_iter().flat_map(|wire| wire.cited(spec)) {
        push(&mut all, part.errata, &Rests::Wire(part.name));
    }
    all
}

fn device<'a>(device: &'a Device, all: &mut Vec<(&'a str, Rests<'a>)>) {
    push(all, &device.errata, &Rests::Device(device));
    for alarm in &device.alarms {
        push(all, &alarm.errata, &Rests::Register(device, &alarm.bit));
    }
    for register in &device.registers {
        push(all, register.all_errata(), &Rests::Register(device, &register.name));
    }
}

fn push<'a>(
    all: &mut Vec<(&'a str, Rests<'a>)>,
    errata: impl IntoIterator<Item = &'a String>,
    what: &Rests<'a>,
) {
    all.extend(errata.into_iter().map(|id| (id.as_str(), what.clone())));
}
