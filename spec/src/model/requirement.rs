use std::fmt;

#[cfg(feature = "exports")]
use schemars::JsonSchema;
use serde::Deserialize;

use super::Citation;

/// A file of `requirements/`.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct RequirementsFile {
    /// One row per requirement.
    pub requirements: Vec<Requirement>,
}

/// A requirement: a normative statement of a document, in our own words.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Requirement {
    /// Permanent id; begins with the document's id.
    pub id: String,
    /// How strict it is.
    pub level: Level,
    /// What is required.
    pub text: String,
    /// Where the document requires it.
    pub source: Citation,
    /// Ids of the errata that it depends on: with another reading of these, the requirement would
    /// be different.
    #[serde(default)]
    pub errata: Vec<String>,
    /// The roles that it binds.
    pub binds: Vec<Role>,
    /// Tests of this repository, in addition to the suite's checks, which any codec can be asked.
    /// `FILE::TEST` checks the built-in codec. `FILE.txt` is a conversation, which checks the virtual
    /// device.
    #[serde(default)]
    pub tests: Vec<String>,
    /// What else checks it; given if neither a vector nor a test names it.
    pub checked_by: Option<CheckedBy>,
    /// A requirement of another document that requires the same, so that its checks count for this
    /// one too: those of each role that no check of this one asks.
    pub checked_with: Option<String>,
    /// Why packets can't show whether it is obeyed.
    #[serde(default)]
    pub unseen: Unseen,
}

/// Why packets can't show whether a requirement is obeyed, for each role. A reason is absent if they
/// can, or if the role is not bound. A conversation of the virtual device may show it all the same: a
/// virtual device takes faults, and does not wear.
#[derive(Clone, Debug, Default, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Unseen {
    /// Why they can't show it of a host.
    pub host: Option<String>,
    /// Why they can't show it of a device.
    pub device: Option<String>,
}

impl Unseen {
    /// The reason for a role. What a codec does always shows in its answers.
    #[must_use]
    pub fn by(&self, role: Role) -> Option<&str> {
        match role {
            Role::Codec => None,
            Role::Host => self.host.as_deref(),
            Role::Device => self.device.as_deref(),
        }
    }
}

impl Requirement {
    /// Whether a test of this repository checks it for this role.
    #[must_use]
    pub fn is_tested(&self, role: Role) -> bool {
        self.tests.iter().any(|test| match role {
            Role::Codec => test.contains("::"),
            Role::Host => false,
            Role::Device => !test.contains("::"),
        })
    }
}

/// What checks a requirement that neither a vector nor a test names.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum CheckedBy {
    /// Checks of the suite that need no vector.
    Suite,
    /// Nothing yet.
    Nothing,
}

/// How strict a requirement is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
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
    /// Every level, the strictest first.
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

/// The role that a requirement binds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Role {
    /// A library that builds or reads packets.
    Codec,
    /// A program that sends instructions.
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
