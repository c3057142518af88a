use std::fmt;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Citation;

/// A file of `requirements/`.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RequirementsFile {
    /// One row a normative statement.
    pub requirements: Vec<Requirement>,
}

/// A normative statement of a document, in our own words.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Requirement {
    /// Permanent id; begins with the document's.
    pub id: String,
    /// How binding it is.
    pub level: Level,
    /// What is demanded.
    pub text: String,
    /// Where the document demands it.
    pub source: Citation,
    /// Ids of the errata that it rests on: what it says differs with how they are decided.
    #[serde(default)]
    pub errata: Vec<String>,
    /// Who has to obey.
    pub binds: Vec<Role>,
    /// Tests of this repository that hold the built-in codec to it, beside the suite's checks,
    /// which any codec can take: `FILE::TEST`.
    #[serde(default)]
    pub tests: Vec<String>,
    /// What else checks it; said where neither a vector nor a test names it.
    pub checked_by: Option<CheckedBy>,
    /// Another document's requirement that demands the same, so that its checks show this one too.
    pub checked_with: Option<String>,
}

/// What checks a requirement that neither a vector nor a test names.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum CheckedBy {
    /// Checks that the suite makes without a vector.
    Suite,
    /// Nothing yet.
    Nothing,
}

/// How binding a requirement is.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Deserialize, Serialize, JsonSchema,
)]
#[serde(rename_all = "lowercase")]
pub enum Level {
    /// Breaking it fails the run.
    Must,
    /// Breaking it is a warning.
    Should,
    /// Either way is right.
    May,
}

impl Level {
    /// Every level, the most binding one first.
    pub const ALL: [Self; 3] = [Self::Must, Self::Should, Self::May];
}

impl fmt::Display for Level {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Must => "must",
            Self::Should => "should",
            Self::May => "may",
        })
    }
}

/// Whom a requirement binds.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Deserialize, Serialize, JsonSchema,
)]
#[serde(rename_all = "lowercase")]
pub enum Role {
    /// Whoever builds or reads packets.
    Codec,
    /// Whoever sends instructions.
    Host,
    /// The actuator.
    Device,
}

impl Role {
    /// Every role.
    pub const ALL: [Self; 3] = [Self::Codec, Self::Host, Self::Device];
}

impl fmt::Display for Role {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Codec => "codec",
            Self::Host => "host",
            Self::Device => "device",
        })
    }
}
