use std::fmt;

#[cfg(feature = "exports")]
use schemars::JsonSchema;
use serde::Deserialize;

/// Facts that a reader of frames needs in addition to their bytes.
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
pub struct Context {
    /// For a fast status packet: the request that it answers.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fast: Option<Fast>,
    /// The direction of the packet. Frames of some wires do not state it.
    #[serde(alias = "kind", skip_serializing_if = "Option::is_none")]
    pub direction: Option<Direction>,
}

impl From<Direction> for Context {
    fn from(direction: Direction) -> Self {
        Self { fast: None, direction: Some(direction) }
    }
}

impl From<Fast> for Context {
    fn from(fast: Fast) -> Self {
        Self { fast: Some(fast), direction: Some(Direction::Reply) }
    }
}

/// The request that a fast status packet answers. The packet can't be read without it.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
pub struct Fast {
    /// Bytes of data a block; 0 for Fast Sync Write.
    pub length: u16,
    /// The devices in the order of the request.
    pub ids: Vec<u8>,
}

/// The direction of a packet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Direction {
    /// From the host.
    Request,
    /// To the host.
    Reply,
}

impl Direction {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Request, Self::Reply];
}

impl fmt::Display for Direction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Request => "request",
            Self::Reply => "reply",
        })
    }
}
