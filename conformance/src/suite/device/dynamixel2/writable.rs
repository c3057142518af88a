//! Which registers may be written, and with what.

use actucheck_spec::model::{Access, Area, Bound, Device, Register};

use super::Talk;
use crate::adapter::{Permission, Permissions};

/// Registers that no check of values writes; only checks of their own write some. With another ID, rate or protocol the device would not hear what sets it
/// back. Others switch torque, let it be switched on at the next start, or stop the device if nothing is sent;
/// the mode decides what all goals mean, and one of its values moves the shaft.
const NEVER: [&str; 10] = [
    "ID",
    "Baud Rate",
    "Secondary(Shadow) ID",
    "Protocol Type",
    "Torque Enable",
    "Startup Configuration",
    "Bus Watchdog",
    "Status Return Level",
    "Operating Mode",
    "Shutdown",
];

/// A register, and the smallest and the largest value that it must take, whatever other registers hold.
#[derive(Clone, Copy)]
pub(super) struct Writable<'a> {
    pub(super) register: &'a Register,
    pub(super) min: i64,
    pub(super) max: i64,
}

impl Writable<'_> {
    pub(super) fn size(self) -> usize {
        self.register.kind.size().into()
    }

    /// A value other than the initial one.
    pub(super) const fn other(self) -> i64 {
        match self.register.initial {
            Some(initial) if initial == self.max => self.min,
            _ => self.max,
        }
    }
}

/// The bytes of a value of a register.
pub(super) fn bytes(register: &Register, value: i64) -> Vec<u8> {
    value.to_le_bytes().into_iter().take(register.kind.size().into()).collect()
}

/// The registers that any value of a range may be written to.
pub(super) fn writable<'a>(talk: &Talk<'a>) -> Vec<Writable<'a>> {
    let Some(device) = talk.target.device else { return Vec::new() };
    let with_range = device.registers.iter().filter_map(|register| {
        let range = register.range.as_ref().filter(|range| talk.author.spec.settles(range))?;
        let bound = |bound: &Option<Bound>| match bound {
            Some(Bound::Value(value)) => Some(*value),
            _ => None,
        };
        let (min, max) = bound(&range.min).zip(bound(&range.max))?;
        Some(Writable { register, min, max })
    });
    let is_free = |one: &Writable<'_>| {
        let Register { name, access, meanings, .. } = one.register;
        *access == Access::Rw
            && meanings.is_empty()
            && !NEVER.contains(&name.as_str())
            && !name.starts_with("Indirect ")
    };
    with_range.filter(is_free).collect()
}

/// A register of the RAM area that does nothing by itself while torque is off, with many values.
pub(super) fn probe<'a>(talk: &Talk<'a>) -> Option<Writable<'a>> {
    probes(talk).next()
}

/// All such registers.
pub(super) fn probes<'a>(talk: &Talk<'a>) -> impl Iterator<Item = Writable<'a>> + use<'a> {
    let is_gain = |one: &Writable<'_>| {
        one.register.area == Area::Ram && one.size() == 2 && one.register.initial.is_some()
    };
    // The last one is no time, which may have a meaning of its own at 0.
    writable(talk).into_iter().rev().filter(is_gain)
}

/// A register of the EEPROM area that bounds something, and raises no alarm.
pub(super) fn lasting<'a>(talk: &Talk<'a>) -> Option<Writable<'a>> {
    let device = talk.target.device?;
    let bounds = |one: &Writable<'_>| {
        one.register.area == Area::Eeprom
            && one.register.name.ends_with("Limit")
            && !raises_alarms(device, &one.register.name)
            && one.register.initial.is_some()
    };
    let all: Vec<_> = writable(talk).into_iter().filter(bounds).collect();
    // What an erratum is about may leave the factory with another value.
    let certain = all.iter().find(|one| one.register.errata.is_empty());
    certain.or(all.first()).copied()
}

/// What a check needs that writes a register. An alarm stays until the device restarts.
pub(super) fn needs(talk: &Talk<'_>, register: &Register) -> Permissions {
    let area = match register.area {
        Area::Eeprom => Permission::Eeprom,
        Area::Ram => Permission::WriteRam,
    };
    let alarms = talk.target.device.is_some_and(|device| raises_alarms(device, &register.name));
    [area].into_iter().chain(alarms.then_some(Permission::Reboot)).collect()
}

/// Whether a value of this register may raise an alarm: it is its limit, or changes what is measured.
fn raises_alarms(device: &Device, name: &str) -> bool {
    device.alarms.iter().any(|alarm| {
        let limits = [&alarm.below, &alarm.above];
        limits.into_iter().flatten().any(|limit| limit == name)
            || alarm.register == "Present Position"
                && matches!(name, "Homing Offset" | "Drive Mode")
    })
}
