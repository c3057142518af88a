#[cfg(feature = "exports")]
use schemars::JsonSchema;
use serde::Deserialize;

use super::{Citation, Register};
use crate::wire::Wire;

/// A file of `devices/`: a control table.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Device {
    /// Id.
    pub device: String,
    /// Its name.
    pub title: String,
    /// The wire that it speaks.
    pub wire: Wire,
    /// The sections that say so.
    pub source: Vec<Citation>,
    /// The model number that Ping returns; absent if the document states none.
    pub model_number: Option<u16>,
    /// The counts of the position registers in a turn; absent if no document states them.
    pub counts_per_turn: Option<u32>,
    /// Whether the control table has every register. A table that has not tells nothing about other
    /// addresses.
    #[serde(default)]
    pub complete: bool,
    /// Ids of the errata that it depends on.
    #[serde(default)]
    pub errata: Vec<String>,
    /// Names of the instructions that it supports.
    pub instructions: Vec<String>,
    /// The register that keeps the EEPROM area read-only while it is not 0.
    pub eeprom_lock: Option<String>,
    /// Registers of the RAM area that a backup contains, in addition to the whole EEPROM area.
    #[serde(default)]
    pub backup: Vec<String>,
    /// Bits that the device sets when a measurement passes a limit.
    #[serde(default)]
    pub alarms: Vec<Alarm>,
    /// The control table, in ascending order of address.
    pub registers: Vec<Register>,
}

impl Device {
    /// The register with this name.
    #[must_use]
    pub fn register(&self, name: &str) -> Option<&Register> {
        self.registers.iter().find(|register| register.name == name)
    }
}

/// A bit that the device sets when a measurement passes a limit.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Alarm {
    /// Name of the bit.
    pub bit: String,
    /// The register that is watched.
    pub register: String,
    /// The register that holds the smallest value without an alarm.
    pub below: Option<String>,
    /// The register that holds the largest value without an alarm.
    pub above: Option<String>,
    /// A further condition for the alarm; absent if there is none.
    pub when: Option<Condition>,
    /// Ids of the errata that it depends on.
    #[serde(default)]
    pub errata: Vec<String>,
}

impl Alarm {
    /// Bit, limits and condition in words: `Overheating Error: Present Temperature above
    /// Temperature Limit`.
    #[must_use]
    pub fn in_words(&self, device: &Device) -> String {
        let limits = [("below", &self.below), ("above", &self.above)];
        let limits = limits
            .iter()
            .filter_map(|(word, limit)| Some(format!("{word} {}", limit.as_ref()?)))
            .collect::<Vec<_>>()
            .join(" or ");
        let when = self.when.as_ref();
        let when =
            when.map_or_else(String::new, |when| format!(", while {}", when.in_words(device)));
        format!("{}: {} {limits}{when}", self.bit, self.register)
    }
}

/// A condition on the value of another register: `{register: Drive Mode, bits: Profile
/// Configuration, one_of: [1]}`.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Condition {
    /// The register.
    pub register: String,
    /// The bits of the register that are compared; absent means all bits.
    pub bits: Option<String>,
    /// The values for which the condition holds; values of bits are shifted down to bit 0.
    pub one_of: Vec<i64>,
}

impl Condition {
    /// The condition in words, with `device`'s names of the values: `Operating Mode is Position
    /// Control Mode`.
    #[must_use]
    pub fn in_words(&self, device: &Device) -> String {
        let values = self.values_in_words(device);
        let what = self
            .bits
            .as_ref()
            .map_or_else(|| self.register.clone(), |bits| format!("{bits} of {}", self.register));
        format!("{what} is {}", values.join(" or "))
    }

    /// The values by the names that `device` gives them, or as numbers.
    #[must_use]
    pub fn values_in_words(&self, device: &Device) -> Vec<String> {
        let register = device.register(&self.register);
        let bits = self.bits.as_ref().and_then(|name| register?.bit_field(name));
        let named = bits.map_or_else(
            || register.map_or(&[][..], |register| &register.values),
            |bits| &bits.values,
        );
        let value = |value: &i64| {
            let name = named.iter().find(|row| row.value == *value);
            name.map_or_else(|| value.to_string(), |row| row.name.clone())
        };
        self.one_of.iter().map(value).collect()
    }
}
