//! What an actuator holds.

use std::collections::BTreeMap;

use actucheck_codec::innfos::{Alarms, Command, Flag, Format, Iq8, Iq24, Mode, Value};

/// Values by the name that the commands share which read and write them.
#[derive(Clone, Debug)]
pub(super) struct Values(BTreeMap<&'static str, Value>);

/// `Position offset` for the commands that read and write it.
fn name(command: Command) -> &'static str {
    let name = command.name();
    ["Read ", "Write "].iter().find_map(|verb| name.strip_prefix(verb)).unwrap_or(name)
}

impl Values {
    /// Those of an actuator that nobody has set anything on.
    pub(super) fn new() -> Self {
        let mut values = Self(BTreeMap::new());
        values.set(Command::ReadHandshake, Value::Flag(Flag::YES));
        values.set(Command::ReadLastShutdownState, Value::Flag(Flag::YES));
        values.set(Command::ReadMode, Value::Mode(Mode::Current));
        let room = Iq8::from_f64(25.0).unwrap_or_default();
        values.set(Command::ReadActuatorTemperature, Value::Iq8(room));
        values.set(Command::ReadInverterTemperature, Value::Iq8(room));
        // No limit is narrower than what the value may be.
        for (lower, upper) in [
            (Command::ReadCurrentLoopOutputLowerLimit, Command::ReadCurrentLoopOutputUpperLimit),
            (Command::ReadSpeedLoopOutputLowerLimit, Command::ReadSpeedLoopOutputUpperLimit),
            (Command::ReadPositionLoopOutputLowerLimit, Command::ReadPositionLoopOutputUpperLimit),
        ] {
            values.set(lower, Value::Iq24(Iq24(-WHOLE)));
            values.set(upper, Value::Iq24(Iq24(WHOLE)));
        }
        values.free_positions();
        values
    }

    /// Allows all positions.
    pub(super) fn free_positions(&mut self) {
        self.set(Command::ReadPositionLowerLimit, Value::Iq24(Iq24(i32::MIN)));
        self.set(Command::ReadPositionUpperLimit, Value::Iq24(Iq24(i32::MAX)));
    }

    /// The value of a command; 0 if nobody has set it. `None` if it has none.
    pub(super) fn get(&self, command: Command) -> Option<Value> {
        let format = command.row()?.format?;
        self.0.get(name(command)).copied().or(match format {
            Format::Flag => Some(Value::Flag(Flag::NO)),
            Format::Mode => Some(Value::Mode(Mode::Current)),
            Format::Alarms => Some(Value::Alarms(Alarms(0))),
            Format::Iq8 => Some(Value::Iq8(Iq8(0))),
            Format::Iq24 => Some(Value::Iq24(Iq24(0))),
            Format::Scaled { .. } => Some(Value::Scaled(0)),
            Format::Mac => None,
        })
    }

    pub(super) fn set(&mut self, command: Command, value: Value) {
        self.0.insert(name(command), value);
    }

    /// Forgets what does not outlast the supply.
    pub(super) fn lose_power(&mut self) {
        for command in [Command::ReadPowerState, Command::ReadMode, Command::ReadAlarms] {
            self.0.remove(name(command));
        }
    }

    /// The number on the wire.
    pub(super) fn iq24(&self, command: Command) -> f64 {
        match self.get(command) {
            Some(Value::Iq24(Iq24(number))) => number.into(),
            _ => 0.0,
        }
    }

    /// The value of a number.
    pub(super) fn real(&self, command: Command) -> f64 {
        match self.get(command) {
            Some(Value::Iq8(number)) => number.to_f64(),
            Some(Value::Iq24(number)) => number.to_f64(),
            _ => 0.0,
        }
    }

    pub(super) fn mode(&self) -> Mode {
        match self.get(Command::ReadMode) {
            Some(Value::Mode(mode)) => mode,
            _ => Mode::Unknown(0),
        }
    }

    pub(super) fn is_on(&self) -> bool {
        self.get(Command::ReadPowerState) == Some(Value::Flag(Flag::YES))
    }

    pub(super) fn alarms(&self) -> Alarms {
        match self.get(Command::ReadAlarms) {
            Some(Value::Alarms(alarms)) => alarms,
            _ => Alarms(0),
        }
    }
}

/// 1.0 as an IQ24 number.
pub(super) const WHOLE: i32 = 1 << Iq24::FRACTION_BITS;
