//! The values of the codec's registers.

use actucheck_codec::register::Row;
use actucheck_spec::model::Fault;
use actucheck_spec::wire::{Form, Number, Value};

use super::super::{not_fitting, output, rejection};
use super::Result;
use crate::adapter::{Given, Output, RegisterOf, Rejection};
use crate::device::KNOWN;

/// The codec's answer to the op `value`.
pub(super) fn ask(of: &RegisterOf, form: &Form, given: &Given) -> Result {
    let device = KNOWN.into_iter().find(|device| device.id == of.device);
    let row = device.and_then(|device| device.register(of.address));
    let row = row.ok_or_else(|| rejection(Fault::Parameter, &"no such register"))?;
    match given {
        Given::Bytes(bytes) => {
            let raw = row.decode(bytes).ok_or_else(not_fitting)?;
            meaning(row, of.field.as_deref(), form, raw).map(Output::Value).ok_or_else(not_fitting)
        }
        Given::Value(_) if of.field.is_some() => {
            Err(rejection(Fault::Parameter, &"a field does not determine the rest of its register"))
        }
        Given::Value(value) => {
            let raw = raw(row, value).ok_or_else(not_fitting)?;
            let data = row.encode_unchecked(raw).map_err(|error| refused(&error))?;
            Ok(output(data.as_bytes()))
        }
    }
}

/// What the number in a register means.
fn meaning(row: &Row, field: Option<&str>, form: &Form, raw: i64) -> Option<Value> {
    let name = |name: &str| Value::Name(name.to_owned());
    match (form, field) {
        (Form::Unit(None), _) => Some(Value::Number(Number::whole(raw))),
        (Form::Unit(Some(_)), _) => row.physical(raw)?.try_into().ok().map(Value::Number),
        (Form::Names(_), None) => row.value_name(raw).map(name),
        (Form::Names(_), Some(field)) => {
            let field = row.bits.iter().find(|bits| bits.name == field)?;
            let value = field.of(raw);
            field.values.iter().find(|row| row.value == value).map(|row| name(row.name))
        }
        (Form::Flags(_), _) => {
            let set = row.bits.iter().filter(|bits| bits.width == 1 && bits.of(raw) == 1);
            Some(Value::Flags(set.map(|bits| bits.name.to_owned()).collect()))
        }
    }
}

/// The number in a register that means this.
fn raw(row: &Row, value: &Value) -> Option<i64> {
    match value {
        Value::Number(number) if row.unit.is_none() => number.to_whole(),
        Value::Number(number) => row.from_physical((*number).into()),
        Value::Name(name) => row.values.iter().find(|row| row.name == name).map(|row| row.value),
        Value::Flags(flags) => {
            let bit = |flag: &String| row.bits.iter().find(|bits| bits.name == flag);
            flags.iter().map(|flag| bit(flag).map(|bits| 1 << bits.lowest)).sum()
        }
    }
}

fn refused(error: &impl ToString) -> Rejection {
    rejection(Fault::Parameter, error)
}
