//! What the wire's file may say.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::model::{Citation, Crc, HexBytes, Id, Length, NamedValue};

/// `wires/dynamixel2.yaml`: the wire and its instructions.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Dynamixel2 {
    /// Its name.
    pub title: String,
    /// What a packet begins with.
    pub framing: Framing,
    /// What a packet ends with.
    pub crc: Crc,
    /// What keeps the header out of bodies.
    pub stuffing: Stuffing,
    /// What devices answer.
    pub status: StatusFormat,
    /// What hosts may ask, by rising code.
    pub instructions: Vec<Instruction>,
}

/// Header, ID and length.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Framing {
    /// The first bytes, the reserved one included.
    pub header: Vec<u8>,
    /// The IDs that packets may have.
    pub id: Id,
    /// The length field.
    pub length: Length,
    /// Where this stands.
    pub source: Vec<Citation>,
    /// Ids of the errata that it depends on.
    #[serde(default)]
    pub errata: Vec<String>,
}

/// Byte stuffing.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Stuffing {
    /// The bytes that must not stand in a body alone.
    pub pattern: Vec<u8>,
    /// The byte that is put behind them.
    pub insert: u8,
    /// Where the pattern is looked for, in words.
    pub covers: String,
    /// Where this stands.
    pub source: Vec<Citation>,
    /// Ids of the errata that it depends on.
    #[serde(default)]
    pub errata: Vec<String>,
}

/// The status packet.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StatusFormat {
    /// Its instruction.
    pub instruction: u8,
    /// The bit of the error byte that tells of a hardware error.
    pub alert_bit: u8,
    /// The values of the error byte's other bits.
    pub errors: Vec<ErrorNumber>,
    /// Where this stands.
    pub source: Vec<Citation>,
    /// Ids of the errata that it depends on.
    #[serde(default)]
    pub errata: Vec<String>,
}

/// A number that the error byte may hold.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ErrorNumber {
    /// The number, alert bit aside.
    pub number: u8,
    /// Its name.
    pub name: String,
    /// What it means.
    pub summary: String,
}

/// What a host may ask.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Instruction {
    /// Its name in the documents.
    pub name: String,
    /// Its code.
    pub code: u8,
    /// What it does.
    pub summary: String,
    /// The sections that describe it.
    pub source: Vec<Citation>,
    /// Whether it may go to the broadcast ID only.
    #[serde(default)]
    pub broadcast_only: bool,
    /// Whether devices answer it when it goes to the broadcast ID.
    #[serde(default)]
    pub answers_broadcast: bool,
    /// Whether a device answers it whatever its Status Return Level is.
    #[serde(default)]
    pub always_answered: bool,
    /// Layout of its parameters.
    #[serde(default)]
    pub parameters: Vec<Field>,
    /// Layout of the status packets' parameters, if a device answers with one of its own.
    pub status: Option<Vec<Field>>,
    /// Layout of one device's block, if the devices answer with one status packet together.
    pub fast_status: Option<Vec<Field>>,
    /// Ids of the errata that it depends on.
    #[serde(default)]
    pub errata: Vec<String>,
}

/// A field of a layout: of `size`, or `each` for a group that repeats to the end.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Field {
    /// Its name.
    pub name: String,
    /// How many bytes it has.
    pub size: Option<Size>,
    /// The fields that repeat for each device.
    #[serde(default)]
    pub each: Vec<Field>,
    /// Whether the layout may end before it.
    #[serde(default)]
    pub optional: bool,
    /// The bytes that it always has, if the document gives them.
    pub fixed: Option<HexBytes>,
    /// Values with a name.
    #[serde(default)]
    pub values: Vec<NamedValue>,
}

/// How many bytes a field has.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "a size is a number of bytes, the name of an earlier field that holds it, or `rest`"
)]
pub enum Size {
    /// So many.
    Bytes(u8),
    /// As many as an earlier field says, or the `rest`.
    Named(String),
}
