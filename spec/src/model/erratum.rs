use std::fmt;

use serde::Deserialize;

use super::Citation;

/// `errata.yaml`.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ErrataFile {
    /// One row a defect.
    pub errata: Vec<Erratum>,
}

/// A place where a document is wrong, contradicts itself or leaves a question open.
#[derive(Clone, Debug, Deserialize)]
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
}

/// How sure the right reading of an erratum is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
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
