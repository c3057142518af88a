use std::fmt;

#[cfg(feature = "exports")]
use schemars::JsonSchema;
use serde::Deserialize;

use super::{Citation, Condition, Device};

/// A row of a control table.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Register {
    /// Address of its lowest byte.
    pub address: u16,
    /// Its name in the document.
    pub name: String,
    /// Size and signedness; the low byte comes first.
    #[serde(rename = "type")]
    pub kind: Type,
    /// The memory area, which decides whether the value survives a power cycle.
    pub area: Area,
    /// Whether hosts may write it.
    pub access: Access,
    /// The initial value.
    pub initial: Option<i64>,
    /// The values that it may have, if the document limits them.
    pub range: Option<Range>,
    /// The physical value of one count.
    pub unit: Option<Unit>,
    /// Other ranges and units that apply while another register has a certain value. The first one
    /// whose condition holds applies.
    #[serde(default)]
    pub meanings: Vec<Meaning>,
    /// The sections that say so.
    pub source: Vec<Citation>,
    /// Ids of the errata that it depends on.
    #[serde(default)]
    pub errata: Vec<String>,
    /// Values with a name.
    #[serde(default)]
    pub values: Vec<NamedValue>,
    /// Named bit fields, in ascending order.
    #[serde(default)]
    pub bits: Vec<BitField>,
}

impl Register {
    /// The bits with this name.
    #[must_use]
    pub fn bit_field(&self, name: &str) -> Option<&BitField> {
        self.bits.iter().find(|bits| bits.name == name)
    }

    /// Ids of all errata that it depends on: its own, and those of its range and of its conditional
    /// meanings.
    pub fn all_errata(&self) -> impl Iterator<Item = &String> {
        let ranges = self.range.iter().chain(self.meanings.iter().flat_map(|row| &row.range));
        let meanings = self.meanings.iter().flat_map(|row| &row.errata);
        self.errata.iter().chain(ranges.flat_map(|range| &range.errata)).chain(meanings)
    }
}

/// The range and unit of a register while a condition holds, where they differ from its usual ones.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Meaning {
    /// When it holds.
    pub when: Condition,
    /// The values that the register may have then; the usual ones if absent.
    pub range: Option<Range>,
    /// The physical value of one count then; the usual one if absent.
    pub unit: Option<Unit>,
    /// The sections that say so.
    pub source: Vec<Citation>,
    /// Ids of the errata that it depends on.
    #[serde(default)]
    pub errata: Vec<String>,
}

impl Meaning {
    /// Range, unit and condition in words: `0 to 32767, one count is 1 ms, while …`.
    #[must_use]
    pub fn in_words(&self, device: &Device) -> String {
        let range = self.range.as_ref().map(ToString::to_string);
        let unit = self.unit.as_ref().map(|unit| format!("one count is {unit}"));
        let when = format!("while {}", self.when.in_words(device));
        let facts: Vec<_> = range.into_iter().chain(unit).chain([when]).collect();
        facts.join(", ")
    }
}

/// Size and signedness of a register.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Type {
    /// One byte.
    U8,
    /// One byte, signed.
    I8,
    /// Two bytes.
    U16,
    /// Two bytes, signed.
    I16,
    /// Four bytes.
    U32,
    /// Four bytes, signed.
    I32,
}

impl fmt::Display for Type {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::U8 => "u8",
            Self::I8 => "i8",
            Self::U16 => "u16",
            Self::I16 => "i16",
            Self::U32 => "u32",
            Self::I32 => "i32",
        })
    }
}

impl Type {
    /// Bytes.
    #[must_use]
    pub const fn size(self) -> u16 {
        match self {
            Self::U8 | Self::I8 => 1,
            Self::U16 | Self::I16 => 2,
            Self::U32 | Self::I32 => 4,
        }
    }

    /// The smallest and the largest value of this size.
    #[must_use]
    pub fn limits(self) -> (i64, i64) {
        match self {
            Self::U8 => (0, u8::MAX.into()),
            Self::I8 => (i8::MIN.into(), i8::MAX.into()),
            Self::U16 => (0, u16::MAX.into()),
            Self::I16 => (i16::MIN.into(), i16::MAX.into()),
            Self::U32 => (0, u32::MAX.into()),
            Self::I32 => (i32::MIN.into(), i32::MAX.into()),
        }
    }

    /// Whether this size can hold the value.
    #[must_use]
    pub fn holds(self, value: i64) -> bool {
        let (min, max) = self.limits();
        (min..=max).contains(&value)
    }
}

/// The memory area of a register.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Area {
    /// EEPROM area: the value survives a power cycle; writing can be locked.
    Eeprom,
    /// RAM area: the value is lost at a power cycle.
    Ram,
}

impl fmt::Display for Area {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Eeprom => "EEPROM",
            Self::Ram => "RAM",
        })
    }
}

/// Whether hosts may write a register.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Access {
    /// Read-only.
    R,
    /// Read and write.
    Rw,
}

impl fmt::Display for Access {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::R => "R",
            Self::Rw => "RW",
        })
    }
}

/// The values that a register may have: from `min` to `max`, or those of `one_of`.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Range {
    /// The smallest.
    pub min: Option<Bound>,
    /// The largest.
    pub max: Option<Bound>,
    /// All of them.
    pub one_of: Option<Vec<i64>>,
    /// Ids of the errata that it depends on. While one of them is open, the range is not enforced
    /// on writers.
    #[serde(default)]
    pub errata: Vec<String>,
}

impl fmt::Display for Range {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let bound = |bound: &Option<Bound>| {
            bound.as_ref().map_or_else(|| "no limit".to_owned(), ToString::to_string)
        };
        match &self.one_of {
            Some(values) => {
                let values: Vec<_> = values.iter().map(ToString::to_string).collect();
                write!(f, "one of {}", values.join(", "))
            }
            None => write!(f, "{} to {}", bound(&self.min), bound(&self.max)),
        }
    }
}

/// A bound of a range.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(untagged, expecting = "a bound is a number or a register's name, `-` before it to negate")]
pub enum Bound {
    /// A number.
    Value(i64),
    /// The value of another register, negated if its name has a `-` before it.
    Register(String),
}

impl fmt::Display for Bound {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Value(value) => write!(f, "{value}"),
            Self::Register(name) => f.write_str(name),
        }
    }
}

/// The physical value of one count.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Unit {
    /// The physical value of one count.
    pub factor: f64,
    /// The unit of that.
    pub symbol: String,
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.factor, self.symbol)
    }
}

/// A value with a name.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct NamedValue {
    /// The value.
    pub value: i64,
    /// Its name.
    pub name: String,
    /// The actual quantity, if the document states one (a baud rate in bit/s).
    pub actual: Option<i64>,
}

impl fmt::Display for NamedValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.name)?;
        self.actual.map_or(Ok(()), |actual| write!(f, ", actually {actual}"))
    }
}

/// Neighbouring bits with a name.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct BitField {
    /// Its name.
    pub name: String,
    /// The lowest bit, from 0.
    pub lowest: u8,
    /// How many bits.
    #[serde(default = "one")]
    pub width: u8,
    /// Values with a name, shifted down to bit 0.
    #[serde(default)]
    pub values: Vec<NamedValue>,
}

impl BitField {
    /// The bits that it takes.
    #[must_use]
    pub fn mask(&self) -> u64 {
        let ones = 1_u64.checked_shl(self.width.into()).map_or(u64::MAX, |end| end - 1);
        ones.checked_shl(self.lowest.into()).unwrap_or(0)
    }
}

fn one() -> u8 {
    1
}
