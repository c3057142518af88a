//! The differences between two devices' control tables.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use crate::model::{Device, Register};

/// The differences between two devices.
#[derive(Clone, Debug)]
pub struct Diff<'a> {
    /// The first device.
    pub left: &'a Device,
    /// The second device.
    pub right: &'a Device,
    /// Facts about the devices as a whole.
    pub device: Vec<Difference>,
    /// Registers at addresses at which the second device has none.
    pub only_left: Vec<Only<'a>>,
    /// Registers at addresses at which the first device has none.
    pub only_right: Vec<Only<'a>>,
    /// Registers at the same address that differ.
    pub registers: Vec<Changed<'a>>,
}

/// Said of a fact that is missing from a list that the document gives in full.
pub const NONE: &str = "-";

/// Said of a fact that the document does not state.
pub const NOT_TOLD: &str = "not told";

/// A register at an address at which the other device has none.
#[derive(Clone, Copy, Debug)]
pub struct Only<'a> {
    /// The register.
    pub register: &'a Register,
    /// The address of the other device's register with this name.
    pub elsewhere: Option<u16>,
}

/// A register that both devices have, with differences.
#[derive(Clone, Debug)]
pub struct Changed<'a> {
    /// The register of the first device.
    pub left: &'a Register,
    /// The register of the second device.
    pub right: &'a Register,
    /// The facts that differ; at least one.
    pub differences: Vec<Difference>,
}

/// A fact that differs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference {
    /// The fact's name.
    pub fact: String,
    /// The fact of the first device; [`NONE`] or [`NOT_TOLD`] if it has none.
    pub left: String,
    /// The fact of the second device; [`NONE`] or [`NOT_TOLD`] if it has none.
    pub right: String,
}

impl<'a> Diff<'a> {
    /// The differences between `left` and `right`. Citations, errata and titles are ignored.
    #[must_use]
    pub fn of(left: &'a Device, right: &'a Device) -> Self {
        let changed = left.registers.iter().filter_map(|register| {
            let other = at(right, register.address)?;
            let differences = differences(
                &register_facts(left, register),
                &register_facts(right, other),
                |fact, _| fact.is_listed(),
            );
            (!differences.is_empty()).then_some(Changed {
                left: register,
                right: other,
                differences,
            })
        });
        Self {
            left,
            right,
            device: differences(&device_facts(left), &device_facts(right), |fact, side| {
                fact.is_listed(match side {
                    Side::Left => left,
                    Side::Right => right,
                })
            }),
            only_left: only(left, right),
            only_right: only(right, left),
            registers: changed.collect(),
        }
    }

    /// Whether nothing differs.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.device.is_empty()
            && self.only_left.is_empty()
            && self.only_right.is_empty()
            && self.registers.is_empty()
    }
}

fn at(device: &Device, address: u16) -> Option<&Register> {
    device.registers.iter().find(|register| register.address == address)
}

fn only<'a>(device: &'a Device, other: &Device) -> Vec<Only<'a>> {
    let missing = device.registers.iter().filter(|register| at(other, register.address).is_none());
    missing
        .map(|register| Only {
            register,
            elsewhere: other.register(&register.name).map(|register| register.address),
        })
        .collect()
}

/// Facts in the order of their keys.
type Facts<K> = BTreeMap<K, String>;

/// One of the devices.
#[derive(Clone, Copy)]
enum Side {
    Left,
    Right,
}

/// `listed` says whether the document would state the fact if the device had it.
fn differences<K: Ord + fmt::Display>(
    left: &Facts<K>,
    right: &Facts<K>,
    listed: impl Fn(&K, Side) -> bool,
) -> Vec<Difference> {
    let told = |value: Option<&String>, key: &K, side| match value {
        Some(value) => value.clone(),
        None if listed(key, side) => NONE.to_owned(),
        None => NOT_TOLD.to_owned(),
    };
    let keys: BTreeSet<_> = left.keys().chain(right.keys()).collect();
    keys.into_iter()
        .map(|key| (key, left.get(key), right.get(key)))
        .filter(|(_, left, right)| left != right)
        .map(|(key, left, right)| Difference {
            fact: key.to_string(),
            left: told(left, key, Side::Left),
            right: told(right, key, Side::Right),
        })
        .collect()
}

/// A fact about a device, in the order of the output.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum DeviceFact {
    Wire,
    ModelNumber,
    EepromLock,
    Instruction(String),
    Backup(String),
    Alarm(String),
    AlarmWhile(String),
}

impl fmt::Display for DeviceFact {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Wire => f.write_str("wire"),
            Self::ModelNumber => f.write_str("model number"),
            Self::EepromLock => f.write_str("EEPROM lock"),
            Self::Instruction(name) => write!(f, "instruction {name}"),
            Self::Backup(name) => write!(f, "backup of {name}"),
            Self::Alarm(case) => write!(f, "alarm, {case}"),
            Self::AlarmWhile(case) => write!(f, "when, {case}"),
        }
    }
}

impl DeviceFact {
    /// Whether the document lists all facts of this kind, so that a missing one is known not to
    /// hold.
    fn is_listed(&self, device: &Device) -> bool {
        match self {
            Self::Instruction(_) => true,
            Self::Backup(_) => !device.backup.is_empty(),
            Self::Wire
            | Self::ModelNumber
            | Self::EepromLock
            | Self::Alarm(_)
            | Self::AlarmWhile(_) => false,
        }
    }
}

fn device_facts(device: &Device) -> Facts<DeviceFact> {
    let yes = || "yes".to_owned();
    let mut facts = Facts::from([(DeviceFact::Wire, device.wire.to_string())]);
    facts.extend(device.model_number.map(|number| (DeviceFact::ModelNumber, number.to_string())));
    facts.extend(device.eeprom_lock.clone().map(|name| (DeviceFact::EepromLock, name)));
    let instructions = device.instructions.iter().cloned();
    facts.extend(instructions.map(|name| (DeviceFact::Instruction(name), yes())));
    let backup = device.backup.iter().cloned();
    facts.extend(backup.map(|name| (DeviceFact::Backup(name), yes())));
    for alarm in &device.alarms {
        for (word, limit) in [("below", &alarm.below), ("above", &alarm.above)] {
            let Some(limit) = limit else { continue };
            let case = format!("{} {word} {limit}", alarm.register);
            let when = alarm.when.as_ref().map(|when| when.in_words(device));
            facts.insert(DeviceFact::Alarm(case.clone()), alarm.bit.clone());
            facts.insert(DeviceFact::AlarmWhile(case), when.unwrap_or_else(|| "always".to_owned()));
        }
    }
    facts
}

/// A fact about a register, in the order of the output.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum RegisterFact {
    Name,
    Type,
    Area,
    Access,
    Initial,
    Range,
    Unit,
    While(usize),
    Bit(u8),
    BitValue(u8, i64),
    Value(i64),
}

impl fmt::Display for RegisterFact {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Name => f.write_str("name"),
            Self::Type => f.write_str("type"),
            Self::Area => f.write_str("area"),
            Self::Access => f.write_str("access"),
            Self::Initial => f.write_str("initial"),
            Self::Range => f.write_str("range"),
            Self::Unit => f.write_str("unit"),
            Self::While(index) => write!(f, "other meaning {}", index + 1),
            Self::Bit(lowest) => write!(f, "bit {lowest}"),
            Self::BitValue(lowest, value) => write!(f, "bit {lowest} = {value}"),
            Self::Value(value) => write!(f, "value {value}"),
        }
    }
}

impl RegisterFact {
    /// Whether the document lists this fact for every register, so that a missing one is known not
    /// to hold.
    const fn is_listed(&self) -> bool {
        matches!(self, Self::Bit(_) | Self::BitValue(..) | Self::Value(_))
    }
}

fn register_facts(device: &Device, register: &Register) -> Facts<RegisterFact> {
    let mut facts = Facts::from([
        (RegisterFact::Name, register.name.clone()),
        (RegisterFact::Type, register.kind.to_string()),
        (RegisterFact::Area, register.area.to_string()),
        (RegisterFact::Access, register.access.to_string()),
    ]);
    facts.extend(register.initial.map(|value| (RegisterFact::Initial, value.to_string())));
    facts.extend(register.range.as_ref().map(|range| (RegisterFact::Range, range.to_string())));
    facts.extend(register.unit.as_ref().map(|unit| (RegisterFact::Unit, unit.to_string())));
    let meanings = register.meanings.iter().enumerate();
    facts.extend(meanings.map(|(index, row)| (RegisterFact::While(index), row.in_words(device))));
    let values = register.values.iter();
    facts.extend(values.map(|row| (RegisterFact::Value(row.value), row.to_string())));
    for bits in &register.bits {
        let text = match bits.width {
            1 => bits.name.clone(),
            width => format!("{}, {width} bits", bits.name),
        };
        facts.insert(RegisterFact::Bit(bits.lowest), text);
        let values = bits.values.iter();
        facts.extend(
            values.map(|row| (RegisterFact::BitValue(bits.lowest, row.value), row.to_string())),
        );
    }
    facts
}
