//! Which registers are kept, and in which order they are restored.

use actucheck_spec::model::{Access, Area, Device, Register};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Place, Run};

/// The most bytes that are read at once: more than most registers, and no more than firmware has buffers for.
const LONGEST: u16 = 128;

/// Where the registers of a device are that are kept.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Layout {
    /// All that is read, by address and number of bytes.
    pub read: Vec<(u16, u16)>,
    /// What is restored, in this order: first what lets the device answer, then modes, then limits before
    /// what they limit, and goals after them.
    pub restored: Vec<Place>,
    /// Bytes that stand for others while a register holds the others' address: each byte, and the register.
    #[serde(default)]
    pub indirect: Vec<(Place, Place)>,
    /// Whether torque is on.
    #[serde(default)]
    pub torque: Option<Place>,
    /// Where the shaft is to go, and where it is.
    #[serde(default)]
    pub position: Option<(Place, Place)>,
    /// Bits that let a goal switch torque on when it is written.
    #[serde(default)]
    pub goals_switch: Option<(Place, u32)>,
    /// Which instructions the device answers.
    #[serde(default)]
    pub level: Option<Place>,
    /// Whether a write waits for an Action.
    #[serde(default)]
    pub registered: Option<Place>,
    /// The hardware errors.
    #[serde(default)]
    pub alarms: Option<Place>,
}

/// What the registers of a layout held.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(transparent)]
pub struct Snapshot(pub Vec<Run>);

impl Snapshot {
    /// The bytes of a register, if it was read.
    #[must_use]
    pub fn get(&self, place: &Place) -> Option<&[u8]> {
        let bytes = |run: &'_ Run| {
            let from = usize::from(place.address.checked_sub(run.address)?);
            Some(from..from + usize::from(place.size))
        };
        self.0.iter().find_map(|run| run.data.0.get(bytes(run)?))
    }

    /// The number in a register, low byte first.
    #[must_use]
    pub fn number(&self, place: &Place) -> Option<u32> {
        let bytes = self.get(place)?;
        Some(bytes.iter().rev().fold(0, |number, byte| (number << 8) | u32::from(*byte)))
    }

    /// Whether a register holds a number other than 0.
    #[must_use]
    pub fn is_set(&self, place: Option<&Place>) -> bool {
        place.and_then(|place| self.number(place)).is_some_and(|number| number != 0)
    }
}

impl Layout {
    /// The registers of a device.
    #[must_use]
    pub fn of(device: &Device) -> Self {
        let named = |name: &str| device.register(name).map(Place::of);
        let written = |register: &&Register| register.access == Access::Rw;
        let is_kept = |register: &&Register| {
            // Who is asked by another ID, or at another rate, would not hear.
            !matches!(register.name.as_str(), "ID" | "Baud Rate" | "Torque Enable")
                && !register.name.starts_with("Indirect Data ")
        };
        let mut restored: Vec<_> =
            device.registers.iter().filter(written).filter(is_kept).collect();
        restored.sort_by_key(|register| (rank(register), register.address));
        let indirect = device.registers.iter().filter_map(|register| {
            let number = register.name.strip_prefix("Indirect Data ")?;
            Some((Place::of(register), named(&format!("Indirect Address {number}"))?))
        });
        Self {
            read: runs(device),
            restored: restored.into_iter().map(Place::of).collect(),
            indirect: indirect.collect(),
            torque: named(device.eeprom_lock.as_deref().unwrap_or("Torque Enable")),
            position: named("Goal Position").zip(named("Present Position")),
            goals_switch: switch(device),
            level: named("Status Return Level"),
            registered: named("Registered Instruction"),
            alarms: named("Hardware Error Status"),
        }
    }

    /// The values of a device without a control table: the first tells whether the shaft may turn.
    #[must_use]
    pub fn of_values(values: Vec<Place>) -> Self {
        let read = values.iter().map(|place| (place.address, place.size)).collect();
        let torque = values.first().cloned();
        let restored = values.into_iter().skip(1).collect();
        Self { read, restored, torque, ..Self::default() }
    }

    /// The registers that hold something else now than they held, in the order in which they are restored.
    pub(super) fn differing<'l>(&'l self, held: &Snapshot, now: &Snapshot) -> Vec<&'l Place> {
        let is_data =
            |address: u32| self.indirect.iter().any(|(data, _)| u32::from(data.address) == address);
        // What stands for another register is restored with that.
        let own =
            self.indirect.iter().filter(|(_, address)| held.number(address).is_some_and(is_data));
        let all = self.restored.iter().chain(own.map(|(data, _)| data));
        all.filter(|place| held.get(place) != now.get(place)).collect()
    }
}

impl Place {
    fn of(register: &Register) -> Self {
        let (address, size) = (register.address, register.kind.size());
        Self { name: register.name.clone(), address, size }
    }
}

/// The bits of a device that let a goal switch torque on.
fn switch(device: &Device) -> Option<(Place, u32)> {
    let register = device.register("Drive Mode")?;
    let mask = register.bit_field("Torque On by Goal Update")?.mask();
    Some((Place::of(register), u32::try_from(mask).ok()?))
}

/// When a register is restored.
fn rank(register: &Register) -> u8 {
    match register.name.as_str() {
        "Status Return Level" => 0,
        // Ranges, and what other registers hold, depend on them.
        "Operating Mode" | "Drive Mode" => 1,
        name if name.starts_with("Goal ") => 4,
        // It stops the device if nothing is sent for long.
        "Bus Watchdog" => 5,
        _ => match register.area {
            Area::Eeprom => 2,
            Area::Ram => 3,
        },
    }
}

/// Neighbouring registers, as many at once as fit.
fn runs(device: &Device) -> Vec<(u16, u16)> {
    let mut runs: Vec<(u16, u16)> = Vec::new();
    for register in &device.registers {
        let size = register.kind.size();
        match runs.last_mut() {
            Some((start, length))
                if *start + *length == register.address && *length + size <= LONGEST =>
            {
                *length += size;
            }
            _ => runs.push((register.address, size)),
        }
    }
    runs
}
