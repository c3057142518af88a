//! The result of a successful op, or of a conversation.

use std::fmt;

use actucheck_spec::model::HexBytes;
use actucheck_spec::wire::{self, Message, Number, Packet};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::device::{self, Heard};
use super::host::{self, Course};
use super::requests::json;

/// The result of a successful op.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Output {
    /// Of `crc`.
    Crc(u64),
    /// Of `stuff`, `unstuff` and `encode`, and of `value` and `message` if the meaning is given.
    Bytes(HexBytes),
    /// Of `decode`.
    Packet(Packet),
    /// Of `stream`.
    Packets(Vec<Packet>),
    /// Of `value` if the bytes are given.
    Value(wire::Value),
    /// Of `message` if the bytes are given.
    Message(Message),
    /// Of calls on a line that plays a script: what became of each.
    #[schemars(skip)]
    Conversation(Vec<Course>),
    /// Of a device on its port: what passed in each step.
    #[schemars(skip)]
    Line(Vec<Heard>),
}

impl Output {
    /// Of `stream`, the packets of one wire.
    pub fn packets<P: Into<Packet>>(packets: impl IntoIterator<Item = P>) -> Self {
        Self::Packets(packets.into_iter().map(Into::into).collect())
    }

    /// Whether it is the same as `other`, except that numbers may be less than `within` apart.
    #[must_use]
    pub fn is_near(&self, other: &Self, within: Number) -> bool {
        match (self, other) {
            (Self::Value(value), Self::Value(other)) => value.is_near(other, within),
            (Self::Message(message), Self::Message(other)) => message.is_near(other, within),
            _ => self == other,
        }
    }
}

/// Writes a CRC as a hexadecimal number, bytes in hex, and packets as JSON.
impl fmt::Display for Output {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Crc(crc) => write!(f, "{crc:#06X}"),
            Self::Bytes(bytes) => bytes.fmt(f),
            Self::Packet(packet) => f.write_str(&json(packet)?),
            Self::Packets(packets) => f.write_str(&json(packets)?),
            Self::Value(value) => f.write_str(&json(value)?),
            Self::Message(message) => f.write_str(&json(message)?),
            Self::Conversation(steps) => f.write_str(&host::told(steps)),
            Self::Line(steps) => f.write_str(&device::told(steps)),
        }
    }
}
