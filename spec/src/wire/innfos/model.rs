//! The content of the wire's file.

use std::fmt;
use std::net::Ipv4Addr;

#[cfg(feature = "exports")]
use schemars::JsonSchema;
use serde::Deserialize;

use crate::model::{Citation, Crc, Id, Length};
use crate::wire::Direction;

/// `wires/innfos.yaml`: the wire and its commands.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Innfos {
    /// Its name.
    pub title: String,
    /// The structure of a frame.
    pub framing: Envelope,
    /// The CRC of the data.
    pub crc: Crc,
    /// Which frames carry a CRC.
    pub crc_presence: CrcPresence,
    /// How frames are transported.
    pub udp: Udp,
    /// The formats of values in the data, one row per format.
    pub formats: Vec<FormatRow>,
    /// The commands of hosts, in the order of the document's tables.
    pub commands: Vec<Command>,
    /// The values of the format `mode`.
    pub modes: Modes,
    /// The bits of the format `alarms`.
    pub alarms: Alarms,
    /// The models, with the full scales of relative values.
    pub actuators: Actuators,
}

impl Innfos {
    /// The command with this code.
    #[must_use]
    pub fn command(&self, code: u8) -> Option<&Command> {
        self.commands.iter().find(|command| command.code == code)
    }

    /// The row of this format.
    #[must_use]
    pub fn format(&self, format: Format) -> Option<&FormatRow> {
        self.formats.iter().find(|row| row.format == format)
    }
}

/// Header, address, length and end.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Envelope {
    /// The first byte.
    pub header: u8,
    /// The addresses that frames may have.
    pub address: Id,
    /// The length field, which comes after address and command.
    pub length: Length,
    /// The last byte.
    pub tail: u8,
    /// The sections that say so.
    pub source: Vec<Citation>,
    /// Ids of the errata that it depends on.
    #[serde(default)]
    pub errata: Vec<String>,
}

/// Which frames carry a CRC. A frame without data never does.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct CrcPresence {
    /// A request with at least this many bytes of data has a CRC.
    pub request: u16,
    /// A reply with at least this many bytes of data has a CRC.
    pub reply: u16,
    /// The commands whose shorter replies may have no CRC, zeros in its place, or a CRC.
    pub optional: Vec<u8>,
    /// The sections that say so.
    pub source: Vec<Citation>,
    /// Ids of the errata that it depends on.
    #[serde(default)]
    pub errata: Vec<String>,
}

/// The addresses and times of the Ethernet control board.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Udp {
    /// The board's address as delivered.
    pub address: Ipv4Addr,
    /// The board's port.
    pub port: u16,
    /// The broadcast address, for frames to every board.
    pub broadcast: Ipv4Addr,
    /// The network mask of board and host.
    pub netmask: Ipv4Addr,
    /// The network's gateway.
    pub gateway: Ipv4Addr,
    /// The last byte of the host's address is larger than this.
    pub host_above: u8,
    /// How long the board takes to find its actuators.
    pub query_milliseconds: u32,
    /// The sections that say so.
    pub source: Vec<Citation>,
    /// Ids of the errata that it depends on.
    #[serde(default)]
    pub errata: Vec<String>,
}

/// The format of a value in the data; the high byte comes first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Format {
    /// 1 for success, enabled, on or normal; 0 for the opposite.
    Flag,
    /// A row of [`Modes`].
    Mode,
    /// A sum of rows of [`Alarms`].
    Alarms,
    /// A signed number with 8 fractional bits.
    Iq8,
    /// A signed number with 24 fractional bits.
    Iq24,
    /// A signed number, the true value times [`Command::factor`].
    Scaled,
    /// An identifier that the document calls a MAC address.
    Mac,
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Flag => "flag",
            Self::Mode => "mode",
            Self::Alarms => "alarms",
            Self::Iq8 => "iq8",
            Self::Iq24 => "iq24",
            Self::Scaled => "scaled",
            Self::Mac => "mac",
        })
    }
}

/// The size of a format.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct FormatRow {
    /// The format.
    pub format: Format,
    /// The number of bytes that it may have.
    pub sizes: Vec<u16>,
    /// For a fixed-point number: the number of fractional bits.
    pub fraction_bits: Option<u8>,
    /// The sections that say so.
    pub source: Vec<Citation>,
    /// Ids of the errata that it depends on.
    #[serde(default)]
    pub errata: Vec<String>,
}

/// A command of a host.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Command {
    /// The command byte.
    pub code: u8,
    /// Its name, which is unique per access.
    pub name: String,
    /// Whether it reads a value or writes one.
    pub operation: Operation,
    /// Bytes of the request's data.
    pub request: u16,
    /// The sizes that the reply's data may have; empty if no reply comes.
    pub reply: Vec<u16>,
    /// Format of the value that is read or written. A write is answered with a flag.
    pub format: Option<Format>,
    /// For the format `scaled`: the number that represents the value 1.
    pub factor: Option<f64>,
    /// The value's unit, if the document names one.
    pub unit: Option<String>,
    /// For a relative value: the quantity whose full scale is 1.0.
    pub full_scale: Option<FullScale>,
    /// The table that lists it.
    pub source: Vec<Citation>,
    /// Ids of the errata that it depends on.
    #[serde(default)]
    pub errata: Vec<String>,
}

impl Command {
    /// Bytes of data in this direction; `None` if nothing is sent. Of several sizes it is the one
    /// that the document prints, the first.
    #[must_use]
    pub fn size_in(&self, direction: Direction) -> Option<u16> {
        match direction {
            Direction::Request => Some(self.request),
            Direction::Reply => self.reply.first().copied(),
        }
    }

    /// The format of the data in this direction; `None` if there is no data.
    #[must_use]
    pub const fn format_in(&self, direction: Direction) -> Option<Format> {
        match (direction, self.operation) {
            (Direction::Reply, Operation::Read) | (Direction::Request, Operation::Write) => {
                self.format
            }
            (Direction::Reply, Operation::Write) => Some(Format::Flag),
            (Direction::Request, Operation::Read) => None,
        }
    }
}

/// Whether a command reads or writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Operation {
    /// The reply carries the value.
    Read,
    /// The request carries the value.
    Write,
}

impl fmt::Display for Operation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Read => "read",
            Self::Write => "write",
        })
    }
}

/// A column of [`Actuators`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum FullScale {
    /// [`Actuator::current`].
    Current,
    /// [`Actuator::motor_speed`].
    MotorSpeed,
}

/// The operating modes.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Modes {
    /// The sections that say so.
    pub source: Vec<Citation>,
    /// Ids of the errata that it depends on.
    #[serde(default)]
    pub errata: Vec<String>,
    /// One row per mode.
    pub rows: Vec<Mode>,
}

/// An operating mode.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Mode {
    /// Its code.
    pub code: u8,
    /// Its name.
    pub name: String,
}

/// The alarms of an actuator.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Alarms {
    /// The sections that say so.
    pub source: Vec<Citation>,
    /// Ids of the errata that it depends on.
    #[serde(default)]
    pub errata: Vec<String>,
    /// The meaning of any other bit.
    pub other: String,
    /// One row per bit.
    pub rows: Vec<AlarmBit>,
}

/// A bit of the alarms.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct AlarmBit {
    /// The bit.
    pub mask: u16,
    /// Its meaning.
    pub name: String,
}

/// The actuators' models.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Actuators {
    /// The sections that say so.
    pub source: Vec<Citation>,
    /// Ids of the errata that it depends on.
    #[serde(default)]
    pub errata: Vec<String>,
    /// One row per model.
    pub rows: Vec<Actuator>,
}

/// The full scales of a model.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Actuator {
    /// Its name.
    pub name: String,
    /// Current in A.
    pub current: f64,
    /// Speed of the motor in revolutions per minute; relative speeds refer to it.
    pub motor_speed: f64,
    /// Speed after the gear in revolutions per minute.
    pub output_speed: f64,
}

impl Actuator {
    /// The full scale of a quantity.
    #[must_use]
    pub const fn full_scale(&self, quantity: FullScale) -> f64 {
        match quantity {
            FullScale::Current => self.current,
            FullScale::MotorSpeed => self.motor_speed,
        }
    }
}
