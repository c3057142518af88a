use std::fmt;

#[cfg(feature = "exports")]
use schemars::JsonSchema;
use serde::Deserialize;

use super::Citation;

/// `errata.yaml`.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct ErrataFile {
    /// One row per defect.
    pub errata: Vec<Erratum>,
}

/// A place where a document is wrong, contradicts itself or leaves something unspecified.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Erratum {
    /// Permanent id; begins with the document's id.
    pub id: String,
    /// The section.
    pub source: Citation,
    /// What the document prints.
    pub printed: String,
    /// The reading that this project takes as right.
    pub held_right: String,
    /// The reasons for this reading.
    pub evidence: String,
    /// How certain this reading is.
    pub status: Status,
    /// How a test finds the defect, if a test can.
    pub proof: Option<Proof>,
}

/// How a test finds a defect.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Proof {
    /// The kind of defect that the test looks for.
    pub kind: ProofKind,
    /// The lines of the document with the defect, from 1.
    #[serde(default)]
    pub lines: Vec<usize>,
}

/// A kind of defect that a test can find.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum ProofKind {
    /// A printed packet with a wrong length or CRC.
    Packet,
    /// A number printed in decimal and in hexadecimal that are not equal.
    Number,
    /// A register's name with an address that is not its own.
    Reference,
    /// A row of a control table that differs from the register in this spec.
    Row,
    /// A register's range that excludes its own bits or named values; found without the document.
    Range,
}

/// How certain the right reading of an erratum is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Status {
    /// One reading is provably right.
    Resolved,
    /// This project chose a reading.
    Chosen,
    /// More than one reading is possible; vectors that depend on it are acceptable in each.
    Open,
}

impl fmt::Display for Status {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Resolved => "resolved",
            Self::Chosen => "chosen",
            Self::Open => "open",
        })
    }
}
