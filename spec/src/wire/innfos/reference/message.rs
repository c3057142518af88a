//! What packets say: the document's values by arithmetic.

use crate::wire::innfos::{Actuator, Command, Format, Innfos, Packet};
use crate::wire::{Form, Message, Number, Value};

/// What flags are called: 0, failure, disabled, off, abnormal; 1, success, enabled, on, normal.
const FLAGS: [&str; 2] = ["no", "yes"];

/// What a packet says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Meaning {
    /// The message.
    pub message: Message,
    /// The form of its value; `None` if there is none.
    pub form: Option<Form>,
    /// The difference between a number and the next one; 0 if the value is no number.
    pub step: Number,
}

/// What a packet of the tables says. `None` if it has no meaning there: a size or a value that its
/// row does not have, bytes that only tell actuators apart, or a fraction of the full scale of a
/// model that is not given.
#[must_use]
pub fn meaning(innfos: &Innfos, packet: &Packet, actuator: Option<&Actuator>) -> Option<Meaning> {
    let Packet { direction, address, command, data } = packet;
    let row = innfos.command(*command)?;
    if data.len() != usize::from(row.size_in(*direction)?) {
        return None;
    }
    let none = Number::whole(0);
    let (value, form, step) = match row.format_in(*direction) {
        None => (None, None, none),
        Some(format) => {
            let form = form(innfos, row, format)?;
            let (value, step) = match (&form, format) {
                (Form::Unit(_), _) => {
                    let step = step(innfos, row, format, actuator)?;
                    (number(signed(data) * step)?, Number::try_from(step).ok()?)
                }
                (Form::Names(_), Format::Flag) => {
                    let name = FLAGS.get(usize::from(*data.first()?))?;
                    (Value::Name((*name).to_owned()), none)
                }
                (Form::Names(_), _) => {
                    let mode = innfos.modes.rows.iter().find(|row| [row.code] == **data)?;
                    (Value::Name(mode.name.clone()), none)
                }
                (Form::Flags(_), _) => (alarms(innfos, data), none),
            };
            (Some(value), Some(form), step)
        }
    };
    let message = Message { direction: *direction, address: *address, command: *command, value };
    Some(Meaning { message, form, step })
}

/// The packet that says this; `None` if none does, or several do.
#[must_use]
pub fn packet(innfos: &Innfos, message: &Message, actuator: Option<&Actuator>) -> Option<Packet> {
    let Message { direction, address, command, value } = message;
    let row = innfos.command(*command)?;
    let size = usize::from(row.size_in(*direction)?);
    let raw = match (row.format_in(*direction), value) {
        (None, None) => 0,
        (Some(Format::Flag), Some(Value::Name(name))) => {
            i64::try_from(FLAGS.iter().position(|flag| flag == name)?).ok()?
        }
        (Some(Format::Mode), Some(Value::Name(name))) => {
            i64::from(innfos.modes.rows.iter().find(|row| row.name == *name)?.code)
        }
        (Some(Format::Alarms), Some(Value::Flags(names))) => {
            let row = |name: &String| innfos.alarms.rows.iter().find(|row| row.name == *name);
            let masks: Option<Vec<_>> =
                names.iter().map(|name| Some(i64::from(row(name)?.mask))).collect();
            masks?.iter().sum()
        }
        (Some(format), Some(Value::Number(number))) => {
            let step = step(innfos, row, format, actuator)?;
            Number::try_from((f64::from(*number) / step).round()).ok()?.to_whole()?
        }
        _ => return None,
    };
    let bytes = raw.to_be_bytes();
    let data = bytes.get(bytes.len().checked_sub(size)?..)?.to_vec().into();
    Some(Packet { direction: *direction, address: *address, command: *command, data })
}

fn form(innfos: &Innfos, row: &Command, format: Format) -> Option<Form> {
    Some(match format {
        Format::Flag => Form::Names(FLAGS.map(str::to_owned).into()),
        Format::Mode => Form::Names(innfos.modes.rows.iter().map(|row| row.name.clone()).collect()),
        Format::Alarms => {
            let named = innfos.alarms.rows.iter().map(|row| &row.name);
            Form::Flags(named.chain([&innfos.alarms.other]).cloned().collect())
        }
        Format::Iq8 | Format::Iq24 | Format::Scaled => Form::Unit(row.unit.clone()),
        Format::Mac => return None,
    })
}

/// What the last bit of a number is worth, in the command's unit.
fn step(
    innfos: &Innfos,
    row: &Command,
    format: Format,
    actuator: Option<&Actuator>,
) -> Option<f64> {
    let full_scale = match row.full_scale {
        None => 1.0,
        Some(quantity) => actuator?.full_scale(quantity),
    };
    match (innfos.format(format)?.fraction_bits, row.factor) {
        (Some(bits), None) => Some(full_scale / 2_f64.powi(bits.into())),
        (None, Some(factor)) => Some(full_scale / factor),
        _ => None,
    }
}

/// A number whose high byte comes first and whose highest bit is its sign.
fn signed(data: &[u8]) -> f64 {
    let weigh = |number: f64, byte: &u8| number * 256.0 + f64::from(*byte);
    let unsigned = data.iter().fold(0.0, weigh);
    if data.first().is_some_and(|first| *first >= 0x80) {
        unsigned - data.iter().fold(1.0, |weight, _| weight * 256.0)
    } else {
        unsigned
    }
}

fn number(value: f64) -> Option<Value> {
    Number::try_from(value).ok().map(Value::Number)
}

/// A name per bit; bits without one share a name.
fn alarms(innfos: &Innfos, data: &[u8]) -> Value {
    let all = data.iter().fold(0_u16, |bits, byte| bits << 8 | u16::from(*byte));
    let bits = (0..u16::BITS).map(|bit| 1 << bit).filter(|bit| all & bit != 0);
    let name = |bit: u16| {
        let row = innfos.alarms.rows.iter().find(|row| row.mask == bit);
        row.map_or(&innfos.alarms.other, |row| &row.name).clone()
    };
    Value::Flags(bits.map(name).collect())
}
