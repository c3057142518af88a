//! What rests on an erratum: everything of the spec that names it.

use std::fmt;

use crate::Spec;
use crate::model::{Device, Protocol, Requirement, Vector};

/// Something that rests on an erratum.
#[derive(Clone, Copy, Debug)]
pub enum Rests<'a> {
    /// A requirement.
    Requirement(&'a Requirement),
    /// A golden packet.
    Vector(&'a Vector),
    /// A device as a whole.
    Device(&'a Device),
    /// A register or an alarm of a device, by its name.
    Register(&'a Device, &'a str),
    /// An instruction of a wire, by its name.
    Instruction(&'a Protocol, &'a str),
    /// A part of a wire, by its name in the YAML.
    Part(&'a str, &'static str),
    /// A command of the INNFOS wire, by its code.
    Command(&'a str, u8),
    /// A format of the INNFOS wire, by its name.
    Format(&'a str, crate::model::Format),
}

impl fmt::Display for Rests<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Requirement(row) => write!(f, "requirement {}", row.id),
            Self::Vector(row) => write!(f, "vector {}", row.id),
            Self::Device(device) => write!(f, "device {}", device.device),
            Self::Register(device, name) => write!(f, "register {}/{name}", device.device),
            Self::Instruction(wire, name) => write!(f, "instruction {}/{name}", wire.protocol),
            Self::Part(wire, part) => write!(f, "{part} of {wire}"),
            Self::Command(wire, code) => write!(f, "command {wire}/{code:#04X}"),
            Self::Format(wire, format) => write!(f, "format {format} of {wire}"),
        }
    }
}

/// Everything that names an erratum, with the erratum's id, in the order of the files.
#[must_use]
pub fn all(spec: &Spec) -> Vec<(&str, Rests<'_>)> {
    let mut all = Vec::new();
    for row in spec.requirements.iter().flat_map(|file| &file.content.requirements) {
        push(&mut all, &row.errata, Rests::Requirement(row));
    }
    for (_, vector) in spec.vectors() {
        push(&mut all, &vector.errata, Rests::Vector(vector));
    }
    for file in &spec.devices {
        device(&file.content, &mut all);
    }
    for file in &spec.protocols {
        let wire = &file.content;
        for (part, errata) in [
            ("framing", &wire.framing.errata),
            ("CRC", &wire.crc.errata),
            ("byte stuffing", &wire.stuffing.errata),
            ("status packet", &wire.status.errata),
        ] {
            push(&mut all, errata, Rests::Part(&wire.protocol, part));
        }
        for row in &wire.instructions {
            push(&mut all, &row.errata, Rests::Instruction(wire, &row.name));
        }
    }
    innfos(spec, &mut all);
    all
}

fn device<'a>(device: &'a Device, all: &mut Vec<(&'a str, Rests<'a>)>) {
    push(all, &device.errata, Rests::Device(device));
    for alarm in &device.alarms {
        push(all, &alarm.errata, Rests::Register(device, &alarm.bit));
    }
    for register in &device.registers {
        push(all, register.all_errata(), Rests::Register(device, &register.name));
    }
}

fn innfos<'a>(spec: &'a Spec, all: &mut Vec<(&'a str, Rests<'a>)>) {
    let innfos = &spec.innfos.content;
    let wire = innfos.protocol.as_str();
    for (part, errata) in [
        ("framing", &innfos.framing.errata),
        ("CRC", &innfos.crc.errata),
        ("presence of the CRC", &innfos.crc_presence.errata),
        ("UDP", &innfos.udp.errata),
        ("modes", &innfos.modes.errata),
        ("alarms", &innfos.alarms.errata),
        ("models", &innfos.actuators.errata),
    ] {
        push(all, errata, Rests::Part(wire, part));
    }
    for row in &innfos.formats {
        push(all, &row.errata, Rests::Format(wire, row.format));
    }
    for row in &innfos.commands {
        push(all, &row.errata, Rests::Command(wire, row.code));
    }
}

fn push<'a>(
    all: &mut Vec<(&'a str, Rests<'a>)>,
    errata: impl IntoIterator<Item = &'a String>,
    what: Rests<'a>,
) {
    all.extend(errata.into_iter().map(|id| (id.as_str(), what)));
}
