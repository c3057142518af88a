//! The values of registers, by arithmetic with the numbers of the devices' YAML.

use crate::model::{Register, Unit};
use crate::wire::{Form, Number, Value};

/// The bytes of the number in a register: its size, low byte first, negative ones in two's
/// complement.
#[must_use]
pub fn register_bytes(register: &Register, raw: i64) -> Vec<u8> {
    let mut rest = raw;
    let mut bytes = Vec::new();
    for _ in 0..register.kind.size() {
        bytes.push(u8::try_from(rest.rem_euclid(256)).unwrap_or_default());
        rest = rest.div_euclid(256);
    }
    bytes
}

/// The number in a register that has these bytes.
#[must_use]
pub fn register_number(register: &Register, bytes: &[u8]) -> i64 {
    let number = bytes.iter().rev().fold(0, |number, byte| number * 256 + i64::from(*byte));
    let (_, largest) = register.kind.limits();
    if number > largest { number - (1 << (8 * register.kind.size())) } else { number }
}

/// What the number in a register, or in one of its bit fields, means in this form; `None` if it has
/// no such meaning.
#[must_use]
pub fn register_value(
    register: &Register,
    field: Option<&str>,
    form: &Form,
    raw: i64,
) -> Option<Value> {
    let (part, named) = match field {
        None => (raw, &register.values),
        Some(name) => {
            let field = register.bit_field(name)?;
            let ones = (1 << field.width) - 1;
            (raw >> field.lowest & ones, &field.values)
        }
    };
    match form {
        Form::Unit(_) => quantity(register.unit.as_ref(), raw).map(Value::Number),
        Form::Names(_) => {
            named.iter().find(|row| row.value == part).map(|row| Value::Name(row.name.clone()))
        }
        Form::Flags(_) => {
            let flags = register.bits.iter().filter(|bits| bits.width == 1);
            let set = flags.filter(|bits| raw >> bits.lowest & 1 == 1);
            Some(Value::Flags(set.map(|bits| bits.name.clone()).collect()))
        }
    }
}

/// Half of what one count is: a number that is less than this away means the same count.
#[must_use]
pub fn half_a_count(register: &Register) -> Option<Number> {
    let factor = register.unit.as_ref().map_or(1.0, |unit| unit.factor);
    (factor / 2.0).try_into().ok()
}

/// So many counts. The factor is used as the decimal number that it is: 2.5177 is 25177 / 10000.
fn quantity(unit: Option<&Unit>, counts: i64) -> Option<Number> {
    let Some(unit) = unit else { return Some(Number::whole(counts)) };
    let printed = unit.factor.to_string();
    let (whole, decimals) = printed.split_once('.').unwrap_or((&printed, ""));
    let numerator: i64 = format!("{whole}{decimals}").parse().ok()?;
    let denominator = decimals.chars().fold(1, |power: i64, _| power * 10);
    let [numerator, denominator] = [counts.checked_mul(numerator)?, denominator]
        .map(|number| f64::from(Number::whole(number)));
    (numerator / denominator).try_into().ok()
}
