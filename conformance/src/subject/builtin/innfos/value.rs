//! The values of the codec's commands.

use actucheck_codec::innfos::{
    ACTUATORS, Actuator, Alarms, Command, DD_6010, Flag, Format, Mode, Value as Own,
};
use actucheck_spec::wire::Value;

/// What the two flags are called.
const FLAGS: [(&str, Flag); 2] = [("no", Flag::NO), ("yes", Flag::YES)];

/// The model of this name. Without a model in the question, no full scale matters.
pub(super) fn actuator(name: Option<&str>) -> Actuator {
    let named = |actuator: &Actuator| name == Some(actuator.name);
    ACTUATORS.into_iter().find(named).unwrap_or(DD_6010)
}

/// What a value of the codec means.
pub(super) fn meaning(command: Command, actuator: &Actuator, value: Own) -> Option<Value> {
    Some(match value {
        Own::Flag(flag) => {
            let (name, _) = FLAGS.into_iter().find(|(_, named)| *named == flag)?;
            Value::Name(name.to_owned())
        }
        Own::Mode(Mode::Unknown(_)) | Own::Mac(_) => return None,
        Own::Mode(mode) => Value::Name(mode.name().to_owned()),
        Own::Alarms(alarms) => Value::Flags(alarms.names().map(str::to_owned).collect()),
        Own::Iq8(_) | Own::Iq24(_) | Own::Scaled(_) => {
            Value::Number(command.physical(value, actuator)?.try_into().ok()?)
        }
    })
}

/// The codec's value that means this.
pub(super) fn own(
    command: Command,
    actuator: &Actuator,
    format: Format,
    value: &Value,
) -> Option<Own> {
    match (format, value) {
        (Format::Flag, Value::Name(name)) => {
            FLAGS.into_iter().find(|(named, _)| named == name).map(|(_, flag)| Own::Flag(flag))
        }
        (Format::Mode, Value::Name(name)) => {
            Mode::ALL.into_iter().find(|mode| mode.name() == name).map(Own::Mode)
        }
        (Format::Alarms, Value::Flags(flags)) => {
            let bits = (0..u16::BITS).map(|bit| Alarms(1 << bit));
            let set = |alarm: &Alarms| alarm.names().any(|name| flags.contains(name));
            Some(Own::Alarms(Alarms(bits.filter(set).map(|alarm| alarm.0).sum())))
        }
        (_, Value::Number(number)) => command.from_physical((*number).into(), actuator),
        _ => None,
    }
}
