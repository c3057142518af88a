use std::fmt;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Citation;

/// `errata.yaml`.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ErrataFile {
    /// One row a defect.
    pub errata: Vec<Erratum>,
}

/// A place where a document is wrong, contradicts itself or leaves a question open.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Erratum {
    /// Permanent id; begins with the document's.
    pub id: String,
    /// Where it stands.
    pub source: Citation,
    /// What the document prints.
    pub printed: String,
    /// What this project holds to be right.
    pub held_right: String,
    /// Why.
    pub evidence: String,
    /// How sure that is.
    pub status: Status,
    /// How a test finds the defect by itself, where it can.
    pub proof: Option<Proof>,
}

/// How a test finds a defect.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Proof {
    /// What it looks at.
    pub kind: ProofKind,
    /// The document's lines on which it finds the defect, from 1.
    #[serde(default)]
    pub lines: Vec<usize>,
}

/// What a test looks at to find a defect.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize, Serialize, JsonSchema,
)]
#[serde(rename_all = "lowercase")]
pub enum ProofKind {
    /// A printed packet whose length or CRC does not compute.
    Packet,
    /// A number printed in decimal and in hexadecimal that are not equal.
    Number,
    /// A register's name with an address that is not its own.
    Reference,
    /// A row of a control table that is not the register held right.
    Row,
    /// A register's range that its own bits or named values do not fit; found without the document.
    Range,
}

/// How sure the right reading of an erratum is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Status {
    /// One reading is provably right.
    Resolved,
    /// A reading was picked.
    Chosen,
    /// More than one reading stands; vectors that depend on it are acceptable in each.
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
