use super::{Command, Iq8, Iq24, Value};
use crate::number::{nearest, to_f64};

/// What the documents' tables say of a command.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CommandRow {
    /// Which way the value goes.
    pub direction: Direction,
    /// Bytes of the request's data.
    pub request: u16,
    /// The sizes that the reply's data may have; empty if no reply comes.
    pub reply: &'static [u16],
    /// How the value stands in the data; `None` if there is none. What answers a write is a
    /// flag.
    pub format: Option<Format>,
    /// The value's unit, if the document names one.
    pub unit: Option<&'static str>,
    /// The quantity whose full scale is the value 1.0, if the value is relative.
    pub full_scale: Option<FullScale>,
}

/// Whether a command reads or writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Direction {
    /// The reply carries the value.
    Read,
    /// The request carries the value.
    Write,
}

/// How a value stands in the data; the high byte comes first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Format {
    /// One byte: 1 for success, enabled, on or normal; 0 for the opposite.
    Flag,
    /// One byte: a [`Mode`](super::Mode).
    Mode,
    /// Two bytes: [`Alarms`](super::Alarms).
    Alarms,
    /// Two bytes, signed, 8 bits behind the point.
    Iq8,
    /// Four bytes, signed, 24 bits behind the point.
    Iq24,
    /// Four bytes, signed: a whole number, `factor` times the value.
    Scaled {
        /// The number on the wire of the value 1.
        factor: f64,
    },
    /// Four or six bytes that tell actuators apart.
    Mac,
}

impl Format {
    /// How many bytes the value may have.
    #[must_use]
    pub const fn sizes(self) -> &'static [u16] {
        match self {
            Self::Flag | Self::Mode => &[1],
            Self::Alarms | Self::Iq8 => &[2],
            Self::Iq24 | Self::Scaled { .. } => &[4],
            Self::Mac => &[4, 6],
        }
    }
}

/// A quantity of which a model has a full scale.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FullScale {
    /// [`Actuator::current`].
    Current,
    /// [`Actuator::motor_speed`].
    MotorSpeed,
}

/// A model's full scales (INNFOS document, Appendix D). The document leaves open whether the
/// speed's is the model's or always 6000 RPM: change `motor_speed` where it is not the model's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Actuator {
    /// The model.
    pub name: &'static str,
    /// In A.
    pub current: f64,
    /// Of the motor, in revolutions a minute; relative speeds refer to it.
    pub motor_speed: f64,
    /// Behind the gear, in revolutions a minute.
    pub output_speed: f64,
}

impl Command {
    /// The value in the command's unit: the fixed-point number, times the model's full scale if
    /// the value is relative; for a scaled one the whole number over its factor. `None` for a
    /// value that is no quantity, or not of the command's format.
    ///
    /// ```
    /// use actucheck_codec::innfos::{Command, DD_6010, Iq24, Value};
    /// let half = Value::Iq24(Iq24(1 << 23));
    /// assert_eq!(Command::ReadSpeed.physical(half, &DD_6010), Some(2100.0)); // RPM
    /// assert_eq!(Command::ReadPosition.physical(half, &DD_6010), Some(0.5)); // R
    /// ```
    #[must_use]
    pub fn physical(self, value: Value, actuator: &Actuator) -> Option<f64> {
        let row = self.row()?;
        Some(match (row.format?, value) {
            (Format::Iq8, Value::Iq8(value)) => value.to_f64() * row.scale(actuator),
            (Format::Iq24, Value::Iq24(value)) => value.to_f64() * row.scale(actuator),
            (Format::Scaled { factor }, Value::Scaled(number)) => to_f64(number.into()) / factor,
            _ => return None,
        })
    }

    /// The value nearest to a quantity in the command's unit; of two that are equally near, the one
    /// farther from 0. What lies beyond the format becomes its largest or smallest value. `None` if
    /// the command's value is no quantity, or for NaN.
    ///
    /// ```
    /// use actucheck_codec::innfos::{Command, DD_6010, Iq24, Value};
    /// let value = Command::WriteCurrent.from_physical(16.5, &DD_6010); // of 33 A
    /// assert_eq!(value, Some(Value::Iq24(Iq24(1 << 23))));
    /// let value = Command::WriteStallEnergy.from_physical(40.0, &DD_6010); // J
    /// assert_eq!(value, Some(Value::Scaled(3009)));
    /// ```
    #[must_use]
    pub fn from_physical(self, physical: f64, actuator: &Actuator) -> Option<Value> {
        let row = self.row()?;
        let number = physical / row.scale(actuator);
        match row.format? {
            Format::Iq8 => Iq8::from_f64(number).map(Value::Iq8),
            Format::Iq24 => Iq24::from_f64(number).map(Value::Iq24),
            Format::Scaled { factor } => {
                let (min, max) = (i32::MIN.into(), i32::MAX.into());
                let number = nearest(physical * factor)?.clamp(min, max);
                i32::try_from(number).ok().map(Value::Scaled)
            }
            Format::Flag | Format::Mode | Format::Alarms | Format::Mac => None,
        }
    }
}

impl CommandRow {
    /// The quantity that the value 1.0 stands for.
    fn scale(&self, actuator: &Actuator) -> f64 {
        match self.full_scale {
            None => 1.0,
            Some(FullScale::Current) => actuator.current,
            Some(FullScale::MotorSpeed) => actuator.motor_speed,
        }
    }
}
