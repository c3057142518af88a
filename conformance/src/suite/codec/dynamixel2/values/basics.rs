//! Basic checks of values: for each device, one register for each thing that may go wrong on its
//! own.

use actucheck_spec::model::{Device, Register};
use actucheck_spec::wire::{Form, Value};

use super::cases::{self, Case};
use super::{checks, devices, is_written};
use crate::adapter::{Given, Output, Question};
use crate::suite::Author;
use crate::suite::check::Check;
use crate::suite::plan::Family;

const PREFIX: &str = "dynamixel2.basic.value-";

/// A number of one byte that is negative if it is taken for a signed one.
const BYTE: i64 = 0x80;

/// A number whose two bytes differ, and one whose bytes do not.
const TWO_BYTES: i64 = 0x0102;
const EVEN: i64 = 0x0101;

/// An error of a hundredth shows in the numbers above it.
const SMALL: i64 = 0x40;

pub(in crate::suite::codec::dynamixel2) fn family(author: Author<'_>) -> Family<'_> {
    Family::of(PREFIX, move || {
        devices(author).flat_map(|device| of_device(&author, device)).collect()
    })
}

/// The ids of the basic checks that an answer rests on, the most basic first.
pub(in crate::suite::codec) fn rests_on(
    question: &Question,
    expected: Option<&Output>,
) -> Vec<String> {
    let Question::Value { of, form, given, .. } = question else {
        return Vec::new();
    };
    let (op, value) = match (given, expected) {
        (Given::Value(value), _) => ("write", value),
        (Given::Bytes(_), Some(Output::Value(value))) => ("read", value),
        (Given::Bytes(_), _) => return Vec::new(),
    };
    let parts = parts(of.size, form, value).into_iter();
    parts.map(|part| format!("{PREFIX}{part}.{}/{op}", of.device)).collect()
}

/// What a value may go wrong with.
fn parts(size: u16, form: &Form, value: &Value) -> Vec<String> {
    let parts: &[&str] = match (form, value) {
        (Form::Unit(_), _) if size > 1 => &["byte", "bytes", "byte-order"],
        (Form::Unit(_), _) => &["byte"],
        (Form::Names(_), _) => &["name", "name-number"],
        (Form::Flags(_), Value::Flags(set)) if set.len() > 1 => &["flag", "flags"],
        (Form::Flags(_), _) => &["flag"],
    };
    let unit = match form {
        Form::Unit(Some(symbol)) => Some(unit(symbol)),
        _ => None,
    };
    let is_negative = matches!(value, Value::Number(number) if f64::from(*number) < 0.0);
    let sign = is_negative.then(|| "sign".to_owned());
    parts.iter().map(|part| (*part).to_owned()).chain(unit).chain(sign).collect()
}

/// The part that is a unit: `unit-rev-min`.
fn unit(symbol: &str) -> String {
    let words = symbol.replace('%', "percent").replace('°', "degrees-").replace('²', "-2");
    let letter = |letter: char| if letter.is_ascii_alphanumeric() { letter } else { '-' };
    format!("unit-{}", words.to_lowercase().chars().map(letter).collect::<String>())
}

/// Whether the number in a register is an example of something.
type Shows = Box<dyn Fn(&Register, &Case<'_>) -> bool>;

fn of_device(author: &Author<'_>, device: &Device) -> Vec<Check> {
    let all: Vec<_> = device
        .registers
        .iter()
        .flat_map(|register| cases::of(device, register).into_iter().map(move |it| (register, it)))
        .collect();
    let mut list = Vec::new();
    for (part, shows) in examples(device) {
        let shown = all.iter().filter(|(register, case)| shows(register, case));
        // The first that is written too, else the first.
        let first = shown.min_by_key(|(register, case)| !is_written(register, case));
        let Some((register, case)) = first else { continue };
        let raw = if part == "bytes" { EVEN } else { case.raw };
        let case = Case { raw, ..case.clone() };
        let id = format!("{PREFIX}{part}.{}", device.device);
        list.extend(checks(author, device, register, &case, &id));
    }
    list
}

/// What shows each part, the most basic first.
fn examples(device: &Device) -> Vec<(String, Shows)> {
    let number = |size: u16, raw: i64| -> Shows {
        Box::new(move |register, case| {
            register.kind.size() == size && case.form == Form::Unit(None) && case.raw == raw
        })
    };
    let mut examples = vec![
        ("byte".to_owned(), number(1, BYTE)),
        ("bytes".to_owned(), number(2, TWO_BYTES)),
        ("byte-order".to_owned(), number(2, TWO_BYTES)),
    ];
    for symbol in device.registers.iter().filter_map(|it| Some(&it.unit.as_ref()?.symbol)) {
        let part = unit(symbol);
        if !examples.iter().any(|(other, _)| *other == part) {
            let form = Form::Unit(Some(symbol.clone()));
            let shows = move |_: &Register, case: &Case<'_>| case.form == form && case.raw > SMALL;
            examples.push((part, Box::new(shows)));
        }
    }
    let others: [(&str, Shows); 5] = [
        ("sign", Box::new(|_, case| matches!(case.form, Form::Unit(_)) && case.raw == -1)),
        ("name", Box::new(|_, case| matches!(case.form, Form::Names(_)) && case.field.is_none())),
        ("name-number", Box::new(has_number)),
        ("flag", Box::new(|_, case| has_flags(case) && case.raw.count_ones() == 1)),
        ("flags", Box::new(|_, case| has_flags(case) && case.raw.count_ones() > 1)),
    ];
    examples.extend(others.map(|(part, shows)| (part.to_owned(), shows)));
    examples
}

/// Whether it is a name with another number than its place in the list of names.
fn has_number(register: &Register, case: &Case<'_>) -> bool {
    let place = register.values.iter().position(|row| row.value == case.raw);
    place.is_some_and(|place| i64::try_from(place) != Ok(case.raw))
}

const fn has_flags(case: &Case<'_>) -> bool {
    matches!(case.form, Form::Flags(_))
}
