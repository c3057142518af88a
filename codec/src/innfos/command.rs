use super::{Command, Iq8, Iq24, Value};
use crate::number::{nearest, to_f64};

/// The facts about a command in the document's tables.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CommandRow {
    /// Whether the command reads or writes the value.
    pub operation: Operation,
    /// Bytes of the request's data.
    pub request: u16,
    /// The sizes that the reply's data may have; empty if no reply comes.
    pub reply: &'static [u16],
    /// The format of the value; `None` if there is no value. A write is answered with a flag.
    pub format: Option<Format>,
    /// The value's unit, if the document names one.
    pub unit: Option<&'static str>,
    /// The quantity whose full scale is the value 1.0, if the value is relative.
    pub full_scale: Option<FullScale>,
}

/// Whether a command reads or writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Operation {
    /// The reply carries the value.
    Read,
    /// The request carries the value.
    Write,
}

/// The format of a value in the data; the high byte comes first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Format {
    /// One byte: 1 for success, enabled, on or normal; 0 for the opposite.
    Flag,
    /// One byte: a [`Mode`](super::Mode).
    Mode,
    /// Two bytes: [`Alarms`](super::Alarms).
    Alarms,
    /// Two bytes, signed, with 8 fractional bits.
    Iq8,
    /// Four bytes, signed, with 24 fractional bits.
    Iq24,
    /// Four bytes, signed: a whole number, `factor` times the value.
    Scaled {
        /// The number that represents the value 1.
        factor: f64,
    },
    /// Four or six bytes that identify an actuator.
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

/// A quantity with a full scale.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FullScale {
    /// [`Actuator::current`].
    Current,
    /// [`Actuator::motor_speed`].
    MotorSpeed,
}

/// A model's full scales (INNFOS document, Appendix D). The document leaves unspecified whether the
/// full scale of speed is the model's or always 6000 RPM; change `motor_speed` if it is not the
/// model's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Actuator {
    /// The model.
    pub name: &'static str,
    /// In A.
    pub current: f64,
    /// Speed of the motor, in revolutions per minute; relative speeds refer to it.
    pub motor_speed: f64,
    /// Speed after the gear, in revolutions per minute.
    pub output_speed: f64,
}

impl Command {
    /// The value in the command's unit: the fixed-point number, times the model's full scale if the
    /// value is relative; for a scaled value, the whole number divided by its factor. `None` if the
    /// value is not a quantity, or not of the command's format.
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
    /// The quantity that the value 1.0 represents.
    fn scale(&self, actuator: &Actuator) -> f64 {
        match self.full_scale {
            None => 1.0,
            Some(FullScale::Current) => actuator.current,
            Some(FullScale::MotorSpeed) => actuator.motor_speed,
        }
    }
}
