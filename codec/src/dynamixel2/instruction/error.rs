use core::fmt;

use crate::BufferTooSmall;
use crate::layout::LayoutError;

/// Why a device can't carry out a packet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RequestError {
    /// The buffer for its parameters is too small.
    Buffer(BufferTooSmall),
    /// It is a status packet.
    Status,
    /// Its parameters don't fit the instruction.
    Layout(LayoutError),
    /// It names its devices itself, so it must be sent to the broadcast ID.
    NotBroadcast {
        /// The ID that it was sent to.
        found: u8,
    },
    /// It names an ID that no device may have.
    Id {
        /// The ID.
        found: u8,
    },
}

impl fmt::Display for RequestError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Buffer(error) => error.fmt(f),
            Self::Status => f.write_str("it is a status packet"),
            Self::Layout(error) => error.fmt(f),
            Self::NotBroadcast { found } => {
                write!(f, "it goes to {found}, but an instruction to several devices goes to 254")
            }
            Self::Id { found } => write!(f, "{found} is no device's ID; one is 0 to 252"),
        }
    }
}

impl core::error::Error for RequestError {}

impl From<BufferTooSmall> for RequestError {
    fn from(error: BufferTooSmall) -> Self {
        Self::Buffer(error)
    }
}

impl From<LayoutError> for RequestError {
    fn from(error: LayoutError) -> Self {
        Self::Layout(error)
    }
}
