//! What the bytes of each register of each device mean, and the bytes of such a meaning.
//!
//! A register whose values have names is asked for the names, one of bits for the flags that are
//! set, and any other one for a number in its unit.

mod basics;
mod cases;
mod requirement;

use actucheck_spec::model::{Access, Device, Register};
use actucheck_spec::wire::Value;
use actucheck_spec::wire::dynamixel2::reference;

pub(super) use self::basics::family as basics;
pub(in crate::suite::codec) use self::basics::rests_on;
use self::cases::Case;
use crate::adapter::{Given, Output, Question, RegisterOf};
use crate::names::as_word;
use crate::suite::Author;
use crate::suite::check::{Check, Demand};
use crate::suite::plan::{Family, Group};

pub(super) fn families(author: Author<'_>) -> impl Iterator<Item = Family<'_>> {
    devices(author).map(move |device| {
        let groups = move || device.registers.iter().flat_map(move |it| groups(author, device, it));
        Family::new(format!("{}.value.", device.device), groups)
    })
}

fn devices(author: Author<'_>) -> impl Iterator<Item = &Device> {
    let devices = author.spec.devices.iter().map(|file| &file.content);
    devices.filter(move |device| device.wire == author.wire)
}

/// A group per value of a register. A host can't write a read-only one.
fn groups<'a>(
    author: Author<'a>,
    device: &'a Device,
    register: &'a Register,
) -> impl Iterator<Item = Group<'a>> {
    cases::of(device, register).into_iter().map(move |case| {
        let id = format!("{}.value.{}", device.device, as_word(&register.name));
        let field = case.field.map_or_else(String::new, |name| format!(".{}", as_word(name)));
        let id = format!("{id}{field}.{}", case.raw);
        let names: &[&str] =
            if is_written(register, &case) { &["/read", "/write"] } else { &["/read"] };
        Group::new(id, names, move |id| checks(&author, device, register, &case, id))
    })
}

/// The other bits of a register decide over its bytes too, so that a field alone is only read.
fn is_written(register: &Register, case: &Case<'_>) -> bool {
    register.access == Access::Rw && case.field.is_none()
}

fn checks(
    author: &Author<'_>,
    device: &Device,
    register: &Register,
    case: &Case<'_>,
    id: &str,
) -> Vec<Check> {
    let Case { field, form, raw } = case;
    let value = reference::register_value(register, *field, form, *raw);
    let (Some(value), Some(within)) = (value, reference::half_a_count(register)) else {
        return Vec::new();
    };
    let bytes = reference::register_bytes(register, *raw);
    let question = |given| Question::Value {
        wire: author.wire,
        of: RegisterOf {
            device: device.device.clone(),
            register: register.name.clone(),
            address: register.address,
            size: register.kind.size(),
            field: field.map(str::to_owned),
        },
        form: form.clone(),
        given,
    };
    let check = |name: &str, given, demand| {
        let requirement = requirement::of(author.spec, device, register, case, &given);
        let check = author.check(format!("{id}/{name}"), &requirement, question(given), demand);
        let source = register.source.first().cloned().unwrap_or_else(|| check.source.clone());
        Check { source, ..check }
    };
    let output = Output::Value(value.clone());
    let read = match value {
        Value::Number(_) => Demand::Near { output, within },
        Value::Name(_) | Value::Flags(_) => Demand::Yield(output),
    };
    let mut checks = vec![check("read", Given::Bytes(bytes.clone().into()), read)];
    if is_written(register, case) {
        let written = Demand::Yield(Output::Bytes(bytes.into()));
        checks.push(check("write", Given::Value(value), written));
    }
    checks
}
