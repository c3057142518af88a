//! What the bytes of a register or of a command mean.

use std::collections::BTreeSet;
use std::fmt;

#[cfg(feature = "exports")]
use schemars::JsonSchema;
use serde::Deserialize;

/// The meaning of some bytes: `{"number": 175.8}`, `{"name": "Position Control Mode"}` or
/// `{"flags": ["Overheating Error"]}`.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Value {
    /// A quantity, or a plain number.
    Number(Number),
    /// The name of the value.
    Name(String),
    /// The names of the flags that are set, in any order.
    Flags(BTreeSet<String>),
}

impl Value {
    /// Whether it is the same as `other`, or a number that is less than `within` away.
    #[must_use]
    pub fn is_near(&self, other: &Self, within: Number) -> bool {
        match (self, other) {
            (Self::Number(Number(number)), Self::Number(Number(other))) => {
                (number - other).abs() < within.0
            }
            _ => self == other,
        }
    }
}

/// The form of a value, and what it may be.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Form {
    /// A number in this unit; `null` for a plain number.
    Unit(Option<String>),
    /// One of these names.
    Names(Vec<String>),
    /// Any of these flags.
    Flags(Vec<String>),
}

impl Form {
    /// Whether the value has this form.
    #[must_use]
    pub fn fits(&self, value: &Value) -> bool {
        match (self, value) {
            (Self::Unit(_), Value::Number(_)) => true,
            (Self::Names(names), Value::Name(name)) => names.contains(name),
            (Self::Flags(all), Value::Flags(set)) => set.iter().all(|flag| all.contains(flag)),
            _ => false,
        }
    }
}

/// What a value must be: `a number`, `one of …`, `flags out of …`.
impl fmt::Display for Form {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unit(_) => f.write_str("a `number`"),
            Self::Names(names) => write!(f, "a `name`, one of {}", names.join(", ")),
            Self::Flags(flags) => write!(f, "`flags` out of {}", flags.join(", ")),
        }
    }
}

/// A number that is neither infinite nor NaN.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(try_from = "f64", into = "f64")]
pub struct Number(f64);

/// Every number equals itself, as none is NaN.
impl Eq for Number {}

/// A number that is infinite or NaN.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NotFinite;

impl fmt::Display for NotFinite {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number must be neither infinite nor NaN")
    }
}

impl std::error::Error for NotFinite {}

impl TryFrom<f64> for Number {
    type Error = NotFinite;

    fn try_from(number: f64) -> Result<Self, NotFinite> {
        if number.is_finite() { Ok(Self(number)) } else { Err(NotFinite) }
    }
}

impl Number {
    /// The number nearest to a whole one; the same up to 53 bits, which is more than any value on a
    /// wire has.
    #[must_use]
    pub fn whole(number: i64) -> Self {
        #[allow(clippy::cast_precision_loss)]
        let double = number as f64;
        Self(double)
    }

    /// The whole number that it is; `None` if it has a fraction or more than 53 bits.
    #[must_use]
    pub fn to_whole(self) -> Option<i64> {
        // Cuts off the fraction, and saturates.
        #[allow(clippy::cast_possible_truncation)]
        let whole = self.0 as i64;
        (whole.unsigned_abs() < 1 << 53 && Self::whole(whole) == self).then_some(whole)
    }
}

impl From<Number> for f64 {
    fn from(number: Number) -> Self {
        number.0
    }
}

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn number(value: f64) -> Value {
        Value::Number(value.try_into().unwrap())
    }

    #[test]
    fn a_number_is_near_within_the_tolerance_only() {
        let within = 0.5.try_into().unwrap();
        assert!(number(2.25).is_near(&number(2.5), within));
        assert!(!number(2.0).is_near(&number(2.5), within));
        assert!(!number(2.0).is_near(&Value::Name("2".to_owned()), within));
    }

    #[test]
    fn a_whole_number_is_told_from_a_fraction() {
        for (number, whole) in [(-3.0, Some(-3)), (0.0, Some(0)), (0.5, None), (1e300, None)] {
            assert_eq!(Number::try_from(number).unwrap().to_whole(), whole, "{number}");
        }
    }

    #[test]
    fn what_is_no_number_is_refused() {
        for text in ["{\"number\":1e999}", "{\"number\":null}", "{\"number\":1,\"name\":\"a\"}"] {
            assert!(serde_json::from_str::<Value>(text).is_err(), "{text}");
        }
        assert_eq!(Number::try_from(f64::NAN), Err(NotFinite));
        assert_eq!(Number::try_from(f64::INFINITY), Err(NotFinite));
    }
}
