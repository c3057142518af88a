//! Implementations that take the bytes of registers for something else.

use std::sync::LazyLock;

use actucheck::adapter::{Given, Output, Question};
use actucheck_spec::Spec;
use actucheck_spec::model::Register;
use actucheck_spec::wire::dynamixel2::reference::{
    register_bytes, register_number, register_value,
};
use actucheck_spec::wire::{Form, Number, Value};

use super::{Mutant, Wrong, bytes};

static SPEC: LazyLock<Spec> = LazyLock::new(|| Spec::embedded().unwrap());

/// How numbers are read.
pub(super) static NUMBERS: [Mutant; 10] = [
    Mutant {
        name: "reads a unit that is 1 % too large",
        blames: "ja-variant.table.units",
        wrong: Wrong::Answers(|op| quantity(op, |_, number| number * 1.01)),
        found_by: "ja40.value.current-limit.15000/read",
        found_by_documents: false,
    },
    Mutant {
        name: "reads degrees for counts",
        blames: "ja-variant.table.units",
        wrong: Wrong::Answers(|op| {
            quantity(
                op,
                |unit, number| if unit == "count" { number * 360. / 32_768. } else { number },
            )
        }),
        found_by: "ja40.value.goal-position.1/read",
        found_by_documents: false,
    },
    Mutant {
        name: "reads half the counts",
        blames: "ja-variant.table.units",
        wrong: Wrong::Answers(|op| {
            quantity(op, |unit, number| if unit == "count" { number / 2. } else { number })
        }),
        found_by: "ja40.value.present-position.-1/read",
        found_by_documents: false,
    },
    Mutant {
        name: "reads fractions for per cent",
        blames: "ja-variant.table.units",
        wrong: Wrong::Answers(|op| {
            quantity(op, |unit, number| if unit == "%" { number / 100. } else { number })
        }),
        found_by: "ja40.value.pwm-limit.37500/read",
        found_by_documents: false,
    },
    Mutant {
        name: "reads velocities in the unit of other actuators",
        blames: "ja-variant.table.units",
        wrong: Wrong::Answers(|op| {
            quantity(op, |unit, number| if unit == "rev/min" { number * 22.9 } else { number })
        }),
        found_by: "ja-variant.value.velocity-trajectory.-1/read",
        found_by_documents: false,
    },
    Mutant {
        name: "reads whole units only",
        blames: "ja-variant.table.units",
        wrong: Wrong::Answers(|op| quantity(op, |_, number| number.trunc())),
        found_by: "ja40.value.goal-velocity.-1/read",
        found_by_documents: false,
    },
    Mutant {
        name: "reads the high byte first",
        blames: "ja-variant.table.registers",
        wrong: Wrong::Answers(|op| {
            read(op, |register, bytes| {
                let other: Vec<_> = bytes.iter().rev().copied().collect();
                register_number(register, &other)
            })
        }),
        found_by: "ja40.value.model-number.5210/read",
        found_by_documents: false,
    },
    Mutant {
        name: "reads every number without a sign",
        blames: "ja-variant.table.units",
        wrong: Wrong::Answers(|op| {
            read(op, |_, bytes| {
                bytes.iter().rev().fold(0, |number, byte| number << 8 | i64::from(*byte))
            })
        }),
        found_by: "ja40.value.present-current.-1/read",
        found_by_documents: false,
    },
    Mutant {
        name: "reads the lowest byte only",
        blames: "ja-variant.table.registers",
        wrong: Wrong::Answers(|op| read(op, |_, bytes| bytes[0].into())),
        found_by: "ja40.value.position-p-gain.2000/read",
        found_by_documents: false,
    },
    Mutant {
        name: "reads a byte as a signed number",
        blames: "ja-variant.table.registers",
        wrong: Wrong::Answers(|op| {
            read(op, |register, bytes| match bytes {
                [byte] => i8::from_le_bytes([*byte]).into(),
                _ => register_number(register, bytes),
            })
        }),
        found_by: "xm430-w210.value.secondary-shadow-id.255/read",
        found_by_documents: false,
    },
];

/// How they are written.
pub(super) static WRITING: [Mutant; 5] = [
    Mutant {
        name: "writes the high byte first",
        blames: "ja-variant.table.registers",
        wrong: Wrong::Answers(|op| {
            written(op, |register, raw| register_bytes(register, raw).into_iter().rev().collect())
        }),
        found_by: "ja40.value.velocity-limit.2000/write",
        found_by_documents: false,
    },
    Mutant {
        name: "writes negative numbers with a sign bit",
        blames: "ja-variant.table.units",
        wrong: Wrong::Answers(|op| {
            written(op, |register, raw| {
                let sign = 1 << (8 * register.kind.size() - 1);
                register_bytes(register, if raw < 0 { sign | -raw } else { raw })
            })
        }),
        found_by: "ja40.value.goal-velocity.-1/write",
        found_by_documents: false,
    },
    Mutant {
        name: "writes four bytes into every register",
        blames: "ja-variant.table.registers",
        wrong: Wrong::Answers(|op| {
            written(op, |register, raw| {
                let mut bytes = register_bytes(register, raw);
                bytes.resize(4, 0);
                bytes
            })
        }),
        found_by: "ja40.value.position-i-gain.5/write",
        found_by_documents: false,
    },
    Mutant {
        name: "writes the quantity without its unit",
        blames: "ja-variant.table.units",
        wrong: Wrong::Answers(|op| {
            let Question::Value { given: Given::Value(Value::Number(number)), .. } = op else {
                return None;
            };
            let number = Number::try_from(f64::from(*number).round()).ok()?.to_whole()?;
            Some(bytes(register_bytes(register(op)?.0, number)))
        }),
        found_by: "ja40.value.goal-current.2/write",
        found_by_documents: false,
    },
    Mutant {
        name: "counts up one too many",
        blames: "ja-variant.table.registers",
        wrong: Wrong::Answers(|op| written(op, |register, raw| register_bytes(register, raw + 1))),
        found_by: "ja-variant.value.id.1/write",
        found_by_documents: false,
    },
];

/// Names and flags.
pub(super) static NAMES: [Mutant; 7] = [
    Mutant {
        name: "calls a mode by the next one's name",
        blames: "ja-variant.baud-rate.values",
        wrong: Wrong::Answers(|op| match asked(op)? {
            (Form::Names(names), Value::Name(name)) => {
                let place = names.iter().position(|other| *other == name)?;
                Some(Output::Value(Value::Name(names.iter().cycle().nth(place + 1)?.clone())))
            }
            _ => None,
        }),
        found_by: "ja40.value.operating-mode.4/read",
        found_by_documents: false,
    },
    Mutant {
        name: "numbers the modes from 0",
        blames: "ja-variant.operating-mode.extended-position",
        wrong: Wrong::Answers(|op| {
            let Question::Value { form: Form::Names(names), given: Given::Value(value), .. } = op
            else {
                return None;
            };
            let place = names.iter().position(|name| Value::Name(name.clone()) == *value)?;
            Some(bytes(vec![u8::try_from(place).ok()?]))
        }),
        found_by: "ja40.value.operating-mode.17/write",
        found_by_documents: false,
    },
    Mutant {
        name: "takes a bit field without shifting it",
        blames: "ja-variant.moving-status.profile",
        wrong: Wrong::Answers(|op| {
            let (register, field) = register(op)?;
            let field = register.bit_field(field?)?;
            let Question::Value { given: Given::Bytes(bytes), .. } = op else { return None };
            let raw = register_number(register, bytes) & 3;
            let named = field.values.iter().find(|row| row.value == raw)?;
            Some(Output::Value(Value::Name(named.name.clone())))
        }),
        found_by: "ja40.value.moving-status.profile-type.48/read",
        found_by_documents: false,
    },
    Mutant {
        name: "counts bits from 1",
        blames: "ja-variant.drive-mode.direction",
        wrong: Wrong::Answers(|op| flags(op, |raw| raw >> 1)),
        found_by: "ja40.value.hardware-error-status.4/read",
        found_by_documents: false,
    },
    Mutant {
        name: "reports the lowest alarm only",
        blames: "ja-variant.drive-mode.profile",
        wrong: Wrong::Answers(|op| flags(op, |raw| raw & -raw)),
        found_by: "ja40.value.hardware-error-status.238/read",
        found_by_documents: false,
    },
    Mutant {
        name: "sets the opposite of every flag",
        blames: "ja-variant.drive-mode.direction",
        wrong: Wrong::Answers(|op| match op {
            Question::Value { form: Form::Flags(_), given: Given::Bytes(_), .. } => {
                flags(op, |raw| !raw)
            }
            Question::Value { given: Given::Value(Value::Flags(set)), .. } => {
                let (register, _) = register(op)?;
                let unset = register.bits.iter().filter(|row| !set.contains(&row.name));
                let raw = unset.map(|row| 1 << row.lowest).sum();
                Some(bytes(register_bytes(register, raw)))
            }
            _ => None,
        }),
        found_by: "ja-variant.value.drive-mode.2/write",
        found_by_documents: false,
    },
    Mutant {
        name: "reads no names",
        blames: "ja-variant.baud-rate.values",
        wrong: Wrong::Rejects(|op| {
            matches!(op, Question::Value { form: Form::Names(_), given: Given::Bytes(_), .. })
        }),
        found_by: "ja40.value.baud-rate.4/read",
        found_by_documents: false,
    },
];

/// The register that is asked, and the name of the field.
fn register(op: &Question) -> Option<(&'static Register, Option<&str>)> {
    let Question::Value { of, .. } = op else { return None };
    let mut devices = SPEC.devices.iter().map(|file| &file.content);
    let device = devices.find(|device| device.device == of.device)?;
    Some((device.register(&of.register)?, of.field.as_deref()))
}

/// The number that is read from the register's bytes, which `number` reads in its own way.
fn read(op: &Question, number: impl Fn(&Register, &[u8]) -> i64) -> Option<Output> {
    let Question::Value { form: form @ Form::Unit(_), given: Given::Bytes(bytes), .. } = op else {
        return None;
    };
    let (register, _) = register(op)?;
    register_value(register, None, form, number(register, bytes)).map(Output::Value)
}

/// The form and the right meaning of the bytes.
fn asked(op: &Question) -> Option<(&Form, Value)> {
    let Question::Value { form, given: Given::Bytes(bytes), .. } = op else { return None };
    let (register, field) = register(op)?;
    Some((form, register_value(register, field, form, register_number(register, bytes))?))
}

/// The quantity that is read, changed.
fn quantity(op: &Question, change: impl Fn(&str, f64) -> f64) -> Option<Output> {
    let (Form::Unit(Some(unit)), Value::Number(number)) = asked(op)? else { return None };
    let number = change(unit, number.into()).try_into().ok()?;
    Some(Output::Value(Value::Number(number)))
}

/// The flags that are read from another number.
fn flags(op: &Question, change: impl Fn(i64) -> i64) -> Option<Output> {
    let Question::Value { form: form @ Form::Flags(_), given: Given::Bytes(bytes), .. } = op else {
        return None;
    };
    let (register, _) = register(op)?;
    let raw = change(register_number(register, bytes));
    register_value(register, None, form, raw).map(Output::Value)
}

/// The bytes of the number to write, which `bytes` makes in its own way.
fn written(op: &Question, own: impl Fn(&Register, i64) -> Vec<u8>) -> Option<Output> {
    let Question::Value { given: Given::Value(Value::Number(number)), .. } = op else {
        return None;
    };
    let (register, _) = register(op)?;
    let factor = register.unit.as_ref().map_or(1.0, |unit| unit.factor);
    let raw = Number::try_from((f64::from(*number) / factor).round()).ok()?.to_whole()?;
    Some(bytes(own(register, raw)))
}
