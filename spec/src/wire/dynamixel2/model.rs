//! The content of the wire's file.

#[cfg(feature = "exports")]
use schemars::JsonSchema;
use serde::Deserialize;

use crate::model::{Citation, Crc, HexBytes, Id, Length, NamedValue};

/// `wires/dynamixel2.yaml`: the wire and its instructions.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Dynamixel2 {
    /// Its name.
    pub title: String,
    /// The start of a packet.
    pub framing: Framing,
    /// The end of a packet.
    pub crc: Crc,
    /// Byte stuffing, which keeps the header out of bodies.
    pub stuffing: Stuffing,
    /// The status packet.
    pub status: StatusFormat,
    /// The instructions of hosts, by ascending code.
    pub instructions: Vec<Instruction>,
}

/// Header, ID and length.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Framing {
    /// The first bytes, including the reserved byte.
    pub header: Vec<u8>,
    /// The IDs that packets may have.
    pub id: Id,
    /// The length field.
    pub length: Length,
    /// The sections that say so.
    pub source: Vec<Citation>,
    /// Ids of the errata that it depends on.
    #[serde(default)]
    pub errata: Vec<String>,
}

/// Byte stuffing.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Stuffing {
    /// The bytes after which a body must have the stuffing byte.
    pub pattern: Vec<u8>,
    /// The byte that is inserted after them.
    pub insert: u8,
    /// The bytes that are searched for the pattern, in words.
    pub covers: String,
    /// The sections that say so.
    pub source: Vec<Citation>,
    /// Ids of the errata that it depends on.
    #[serde(default)]
    pub errata: Vec<String>,
}

/// The status packet.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct StatusFormat {
    /// Its instruction.
    pub instruction: u8,
    /// The bit of the error byte that signals a hardware error.
    pub alert_bit: u8,
    /// The values of the error byte's other bits.
    pub errors: Vec<ErrorNumber>,
    /// The sections that say so.
    pub source: Vec<Citation>,
    /// Ids of the errata that it depends on.
    #[serde(default)]
    pub errata: Vec<String>,
}

/// A number that the error byte may hold.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct ErrorNumber {
    /// The number, without the alert bit.
    pub number: u8,
    /// Its name.
    pub name: String,
    /// Its meaning.
    pub summary: String,
}

/// A command of a host.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Instruction {
    /// Its name in the documents.
    pub name: String,
    /// Its code.
    pub code: u8,
    /// Its effect.
    pub summary: String,
    /// The sections that describe it.
    pub source: Vec<Citation>,
    /// Whether it may be sent to the broadcast ID only.
    #[serde(default)]
    pub broadcast_only: bool,
    /// Whether devices answer it when it is sent to the broadcast ID.
    #[serde(default)]
    pub answers_broadcast: bool,
    /// Whether a device answers it at every Status Return Level.
    #[serde(default)]
    pub always_answered: bool,
    /// Layout of its parameters.
    #[serde(default)]
    pub parameters: Vec<Field>,
    /// Layout of the status packet's parameters, if each device sends its own status packet.
    pub status: Option<Vec<Field>>,
    /// Layout of one device's block, if the devices answer with a fast status packet.
    pub fast_status: Option<Vec<Field>>,
    /// Ids of the errata that it depends on.
    #[serde(default)]
    pub errata: Vec<String>,
}

/// A field of a layout: with a `size`, or `each` for a group that repeats up to the end.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Field {
    /// Its name.
    pub name: String,
    /// How many bytes it has.
    pub size: Option<Size>,
    /// The fields that repeat for each device.
    #[serde(default)]
    pub each: Vec<Field>,
    /// Whether the field may be missing at the end.
    #[serde(default)]
    pub optional: bool,
    /// The fixed bytes of the field, if the document states them.
    pub fixed: Option<HexBytes>,
    /// Values with a name.
    #[serde(default)]
    pub values: Vec<NamedValue>,
}

/// How many bytes a field has.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(
    untagged,
    expecting = "a size is a number of bytes, the name of an earlier field that holds it, or `rest`"
)]
pub enum Size {
    /// A fixed number.
    Bytes(u8),
    /// The name of an earlier field that holds the number, or `rest`.
    Named(String),
}
