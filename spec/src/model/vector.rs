use std::fmt;

#[cfg(feature = "exports")]
use schemars::JsonSchema;
use serde::Deserialize;

use super::{Citation, HexBytes};
use crate::wire::{Context, Direction, Packet, Wire};

/// A file of `vectors/`: the test vectors of one section.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct VectorsFile {
    /// The section, for every vector that names no other section.
    pub source: Citation,
    /// The wire.
    pub wire: Wire,
    /// One row per packet.
    pub vectors: Vec<Vector>,
}

/// A test vector: bytes that a document prints or that follow from its rules, with their meaning.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Vector {
    /// Permanent id.
    pub id: String,
    /// The section, if it is not the file's.
    pub source: Option<Citation>,
    /// A note for readers.
    pub note: Option<String>,
    /// The bytes as the document prints them; absent if it prints none.
    pub printed: Option<HexBytes>,
    /// The right bytes, if they differ from the printed ones or none are printed.
    pub bytes: Option<HexBytes>,
    /// What an implementation must do with [`Vector::frame`].
    #[serde(default)]
    pub result: Outcome,
    /// For an invalid frame: what is wrong with it.
    pub fault: Option<Fault>,
    /// If `bytes` corrects `printed`: what is wrong with the printed bytes.
    pub printed_fault: Option<Fault>,
    /// Ids of the errata that it depends on.
    #[serde(default)]
    pub errata: Vec<String>,
    /// Id of the requirement that it tests, if it is not the wire's general one.
    pub requirement: Option<String>,
    /// For an invalid frame of a wire whose frames do not state their direction: the direction.
    #[serde(rename = "kind")]
    pub direction: Option<Direction>,
    /// The frame's meaning; absent for an invalid frame.
    pub packet: Option<Packet>,
}

impl Vector {
    /// The right bytes, or else the printed ones. Empty if there are neither, which
    /// [`crate::validate`] does not let pass.
    #[must_use]
    pub fn frame(&self) -> &[u8] {
        self.bytes.as_ref().or(self.printed.as_ref()).map_or(&[], |bytes| bytes)
    }

    /// What a reader has to know beside the bytes.
    #[must_use]
    pub fn context(&self) -> Context {
        let of_packet = self.packet.as_ref().map(Packet::context);
        of_packet.unwrap_or(Context { direction: self.direction, fast: None })
    }

    /// The printed bytes, if they are not the right ones.
    #[must_use]
    pub fn defective(&self) -> Option<&[u8]> {
        self.bytes.as_ref().and(self.printed.as_deref())
    }
}

/// What an implementation must do with a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Outcome {
    /// Build it and read it.
    #[default]
    Valid,
    /// Reject it.
    Invalid,
    /// Build and read it as given, or reject it; the documents leave it unspecified.
    Acceptable,
}

/// What is wrong with a frame; these are the error classes of the adapter protocol.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Fault {
    /// It does not begin with a header.
    Header,
    /// It has an ID that no packet may have.
    Id,
    /// It has a length that no packet may have.
    Length,
    /// It is shorter than its length field states.
    Truncated,
    /// There are extra bytes after it.
    Trailing,
    /// It is longer than the receiver takes.
    Oversize,
    /// The CRC does not match.
    Crc,
    /// The body has the pattern without stuffing.
    Stuffing,
    /// An instruction that the receiver does not know.
    Instruction,
    /// Parameters that do not fit the instruction.
    Parameter,
    /// It does not end with the end byte.
    Tail,
    /// The implementation does not say what is wrong. No vector has this fault.
    Unspecified,
    /// The implementation failed with an exception or a crash. No vector has this fault.
    Internal,
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Header => "header",
            Self::Id => "id",
            Self::Length => "length",
            Self::Truncated => "truncated",
            Self::Trailing => "trailing",
            Self::Oversize => "oversize",
            Self::Crc => "crc",
            Self::Stuffing => "stuffing",
            Self::Instruction => "instruction",
            Self::Parameter => "parameter",
            Self::Tail => "tail",
            Self::Unspecified => "unspecified",
            Self::Internal => "internal",
        })
    }
}
