//! An actuator: what it answers, and what it does when it is told something.

use std::time::Duration;

use actucheck_codec::innfos::{
    Actuator as Model, Alarms, Command, Flag, Format, Frame, Iq24, Mac, Message, Mode, Operation,
    Value,
};

use super::super::DeviceState;
use super::super::fault::Alarm;
use super::readings::BoardReadings;
use super::shaft::Shaft;
use super::values::{Values, WHOLE};

/// What the document prints as a MAC address. The others follow it.
const FIRST_MAC: u32 = 0x0164_5ADF;

/// An actuator behind a board.
pub(super) struct Actuator {
    address: u8,
    name: &'static str,
    mac: Option<Mac>,
    values: Values,
    /// What is stored in the EEPROM.
    stored: Values,
    shaft: Shaft,
}

impl Actuator {
    /// An actuator that has just got power, the one of this number behind its board.
    pub(super) fn new(address: u8, number: u32, model: &Model, readings: BoardReadings) -> Self {
        let mac = Mac::new(&FIRST_MAC.wrapping_add(number).to_be_bytes());
        let mut values = Values::new();
        let mut shaft = Shaft::new(model, readings.full_speed);
        shaft.stay(&mut values);
        Self { address, name: model.name, mac, stored: values.clone(), values, shaft }
    }

    pub(super) const fn address(&self) -> u8 {
        self.address
    }

    /// What it does.
    pub(super) fn state(&mut self, now: Duration) -> DeviceState {
        self.shaft.advance(&mut self.values, now);
        self.watch();
        // Four digits of a turn are enough to look at.
        let position = (self.values.real(Command::ReadPosition) * 1e4).round() / 1e4;
        DeviceState {
            id: self.address,
            name: self.name,
            position: Some(position),
            goal: None,
            torque: Some(self.values.is_on()),
            error: Some(self.values.alarms().0.into()),
        }
    }

    /// Lets a command read this value at the beginning. Returns whether it does.
    pub(super) fn preset(&mut self, command: Command, value: Value) -> bool {
        match (command, value) {
            (Command::ReadPosition, Value::Iq24(Iq24(position))) => {
                self.shaft.turn_to(&mut self.values, position.into());
            }
            _ => self.values.set(command, value),
        }
        self.shaft.advance(&mut self.values, Duration::ZERO);
        self.stored = self.values.clone();
        self.values.get(command) == Some(value)
    }

    /// The value with which a request is answered; `None` if it is not.
    pub(super) fn answer(&mut self, frame: &Frame<'_>, now: Duration) -> Option<Value> {
        let command = frame.command();
        let row = command.row()?;
        let asked = Message::parse(frame);
        self.shaft.advance(&mut self.values, now);
        self.watch();
        if row.operation == Operation::Read {
            asked.ok()?;
            return match row.format? {
                Format::Mac => self.mac.map(Value::Mac),
                _ => self.values.get(command),
            };
        }
        let is_done = asked.is_ok_and(|asked| self.obey(command, asked.value));
        self.watch();
        let result = Value::Flag(if is_done { Flag::YES } else { Flag::NO });
        (!row.reply.is_empty()).then_some(result)
    }

    /// Does what a write tells. Returns whether that can be done.
    fn obey(&mut self, command: Command, value: Option<Value>) -> bool {
        let Self { values, stored, shaft, .. } = self;
        if command == Command::ClearAlarms {
            values.set(Command::ReadAlarms, Value::Alarms(Alarms(0)));
            shaft.stay(values);
            return true;
        }
        if values.alarms().0 != 0 {
            return false;
        }
        match (command, value) {
            (Command::SaveParameters, _) => *stored = values.clone(),
            (Command::ClearHomingData, _) => {
                for homing in [Command::WriteHomeValue, Command::WritePositionOffset] {
                    values.set(homing, Value::Iq24(Iq24(0)));
                }
                values.free_positions();
                shaft.stay(values);
            }
            (
                Command::WriteCurrent | Command::WriteSpeed | Command::WritePosition,
                Some(Value::Iq24(goal)),
            ) => {
                if values.is_on() && shaft.take(values, command, goal) {
                    self.raise(Alarms(0).with_step_of_more_than_1_in_position_mode(true));
                }
            }
            (_, Some(value)) if may_be(command, value) => {
                let before =
                    (values.mode(), values.is_on(), values.get(Command::ReadPositionOffset));
                values.set(command, value);
                let after =
                    (values.mode(), values.is_on(), values.get(Command::ReadPositionOffset));
                if before != after {
                    shaft.stay(values);
                }
            }
            _ => return false,
        }
        true
    }

    fn raise(&mut self, alarms: Alarms) {
        let all = Alarms(self.values.alarms().0 | alarms.0);
        self.values.set(Command::ReadAlarms, Value::Alarms(all));
        self.shaft.stay(&mut self.values);
    }

    /// Has the alarms that follow from what is measured.
    fn watch(&mut self) {
        let protection = self.values.real(Command::ReadInverterProtectionTemperature);
        // 0 is one that nobody has set.
        if protection > 0.0 && self.values.real(Command::ReadInverterTemperature) > protection {
            self.raise(Alarms(0).with_overheating(true));
        }
    }

    pub(super) fn alarm(&mut self, alarm: Alarm) {
        let none = Alarms(0);
        self.raise(match alarm {
            Alarm::LowVoltage => none.with_undervoltage(true),
            Alarm::Overheating => none.with_overheating(true),
            Alarm::Overload => none.with_locked_rotor(true),
            // An error of the equipment: the document has no name for it.
            Alarm::Encoder => Alarms(0x0800),
        });
    }

    /// The supply goes and comes back.
    pub(super) fn restart(&mut self, now: Duration) {
        self.shaft.advance(&mut self.values, now);
        let was_on = self.values.is_on();
        self.values = self.stored.clone();
        self.values.lose_power();
        let was_right = if was_on { Flag::NO } else { Flag::YES };
        self.values.set(Command::ReadLastShutdownState, Value::Flag(was_right));
        if was_on {
            self.shaft.lose_turns(&mut self.values);
        } else {
            self.shaft.stay(&mut self.values);
        }
    }
}

/// Whether a command may set this.
fn may_be(command: Command, value: Value) -> bool {
    match value {
        Value::Flag(flag) => flag.is_yes().is_some(),
        Value::Mode(mode) => !matches!(mode, Mode::Unknown(_)),
        Value::Iq24(Iq24(number)) if is_output_limit(command) => (-WHOLE..=WHOLE).contains(&number),
        _ => true,
    }
}

const fn is_output_limit(command: Command) -> bool {
    matches!(
        command,
        Command::WriteCurrentLoopOutputLowerLimit
            | Command::WriteCurrentLoopOutputUpperLimit
            | Command::WriteSpeedLoopOutputLowerLimit
            | Command::WriteSpeedLoopOutputUpperLimit
            | Command::WritePositionLoopOutputLowerLimit
            | Command::WritePositionLoopOutputUpperLimit
    )
}
