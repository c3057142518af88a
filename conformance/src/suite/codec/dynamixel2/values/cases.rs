//! The values of a register that are asked.

use std::collections::BTreeSet;

use actucheck_spec::model::{BitField, Bound, Device, NamedValue, Range, Register};
use actucheck_spec::wire::Form;

/// A value of a register.
#[derive(Clone, Debug)]
pub(super) struct Case<'a> {
    /// The bits that are asked; `None` for the whole register.
    pub(super) field: Option<&'a str>,
    pub(super) form: Form,
    /// The number in the register.
    pub(super) raw: i64,
}

/// Numbers whose bytes differ, whose highest bit is set, and their neighbours: they tell orders,
/// sizes and signs apart.
const TELLING: [i64; 17] = [
    0,
    1,
    2,
    0x80,
    0x0102,
    0x8000,
    0x01_0203,
    0x0102_0304,
    0x8000_0000,
    -1,
    -2,
    -0x80,
    -0x81,
    -0x0102,
    -0x8000,
    -0x01_0203,
    -0x0102_0304,
];

pub(super) fn of<'a>(device: &'a Device, register: &'a Register) -> Vec<Case<'a>> {
    if !register.values.is_empty() {
        let form = names(&register.values);
        let cases = register.values.iter().map(|row| Case {
            field: None,
            form: form.clone(),
            raw: row.value,
        });
        return cases.collect();
    }
    if !register.bits.is_empty() {
        return of_flags(register).into_iter().chain(of_fields(register)).collect();
    }
    let form = Form::Unit(register.unit.as_ref().map(|unit| unit.symbol.clone()));
    let numbers = numbers(device, register).into_iter();
    numbers.map(|raw| Case { field: None, form: form.clone(), raw }).collect()
}

fn names(values: &[NamedValue]) -> Form {
    Form::Names(values.iter().map(|row| row.name.clone()).collect())
}

/// No flag, each one alone, and all of them.
fn of_flags(register: &Register) -> Vec<Case<'_>> {
    let flags = || register.bits.iter().filter(|bits| bits.width == 1);
    let form = Form::Flags(flags().map(|bits| bits.name.clone()).collect());
    let alone = flags().map(|bits| 1 << bits.lowest);
    let all = alone.clone().sum();
    let numbers: BTreeSet<i64> = alone.chain([0, all]).collect();
    numbers.into_iter().map(|raw| Case { field: None, form: form.clone(), raw }).collect()
}

/// The named values of each field of several bits, alone and while every other bit with a name is
/// set.
fn of_fields(register: &Register) -> impl Iterator<Item = Case<'_>> {
    let shifted = |value: i64, bits: &BitField| value << bits.lowest;
    register.bits.iter().filter(|bits| bits.width > 1).flat_map(move |field| {
        let others = register.bits.iter().filter(|bits| bits.name != field.name);
        let others: i64 = others.map(|bits| shifted((1 << bits.width) - 1, bits)).sum();
        field.values.iter().flat_map(move |row| {
            [0, others].map(|others| Case {
                field: Some(&field.name),
                form: names(&field.values),
                raw: shifted(row.value, field) | others,
            })
        })
    })
}

/// The smallest, the largest and the initial value with their neighbours, and what tells sizes, signs and orders of bytes
/// apart: all that lie within the range.
fn numbers(device: &Device, register: &Register) -> BTreeSet<i64> {
    let (min, max) = bounds(device, register);
    let around = [Some(min), Some(max), register.initial].into_iter().flatten();
    let numbers = around.flat_map(|number| [number - 1, number, number + 1]).chain(TELLING);
    numbers.filter(|number| (min..=max).contains(number)).collect()
}

/// The smallest and the largest value. A bound that is another register's value is as wide as that
/// register's own numbers allow.
fn bounds(device: &Device, register: &Register) -> (i64, i64) {
    let of = |name: &str| device.register(name).map(|other| within(other, |_| None));
    within(register, of)
}

/// The same, with the bounds of other registers from `others`; without them, those of the size.
fn within(register: &Register, others: impl Fn(&str) -> Option<(i64, i64)>) -> (i64, i64) {
    let (smallest, largest) = register.kind.limits();
    let Some(Range { min, max, .. }) = &register.range else { return (smallest, largest) };
    let number = |bound: &Option<Bound>, end: fn((i64, i64)) -> i64| match bound.as_ref()? {
        Bound::Value(value) => Some(*value),
        Bound::Register(name) => match name.strip_prefix('-') {
            Some(name) => others(name).map(|(_, max)| -max),
            None => others(name).map(end),
        },
    };
    let min = number(min, |(min, _)| min).unwrap_or(smallest);
    let max = number(max, |(_, max)| max).unwrap_or(largest);
    (min.max(smallest), max.min(largest))
}
