use core::fmt;

use super::Command;
use crate::EncodeError;
use crate::number::Or;

/// Why bytes are not a valid frame. Offsets count from the first byte of the frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrameError {
    /// The first byte is not EE.
    Header {
        /// The byte.
        found: u8,
    },
    /// There are too few bytes.
    Truncated {
        /// Number of bytes available.
        available: usize,
        /// Number of bytes of the frame, or of the smallest frame if the length is not available.
        needed: usize,
    },
    /// The last byte is not ED.
    Tail {
        /// Its offset.
        at: usize,
        /// The byte found.
        found: u8,
    },
    /// There are extra bytes after the frame.
    Trailing {
        /// Number of bytes of the frame.
        end: usize,
        /// Number of bytes available.
        available: usize,
    },
    /// The CRC does not match.
    Crc {
        /// Its offset.
        at: usize,
        /// The CRC found.
        found: u16,
        /// The right CRC, of the data.
        expected: u16,
    },
}

impl FrameError {
    /// The offset of the first byte that shows the fault.
    #[must_use]
    pub const fn offset(&self) -> usize {
        match *self {
            Self::Header { .. } => 0,
            Self::Truncated { available, .. } => available,
            Self::Tail { at, .. } | Self::Crc { at, .. } => at,
            Self::Trailing { end, .. } => end,
        }
    }
}

impl fmt::Display for FrameError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Header { found } => {
                write!(f, "header: byte 0 is {found:02X}, a frame has EE there")
            }
            Self::Truncated { available, needed } => {
                write!(f, "truncated: {available} bytes are there, {needed} are needed")
            }
            Self::Tail { at, found } => {
                write!(f, "tail: byte {at} is {found:02X}, the frame ends there with ED")
            }
            Self::Trailing { end, available } => {
                write!(f, "trailing: the frame ends at byte {end}, but {available} bytes are there")
            }
            Self::Crc { at, found, expected } => {
                let ([found_low, found_high], [low, high]) =
                    (found.to_le_bytes(), expected.to_le_bytes());
                write!(
                    f,
                    "crc: bytes {at} and {} are {found_low:02X} {found_high:02X}, \
                     {low:02X} {high:02X} is expected",
                    at + 1
                )
            }
        }
    }
}

impl core::error::Error for FrameError {}

/// Why a frame has no meaning, or a message has no frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MessageError {
    /// The command is not in the document.
    Unknown {
        /// Its code.
        code: u8,
    },
    /// The command has no reply.
    NoReply {
        /// The command.
        command: Command,
    },
    /// The data has the wrong size.
    Size {
        /// The command.
        command: Command,
        /// Bytes of data.
        found: usize,
        /// The valid sizes.
        expected: &'static [u16],
    },
    /// The value is missing, superfluous, or has the wrong format.
    Value {
        /// The command.
        command: Command,
    },
    /// The quantity to be set is NaN.
    NotANumber {
        /// The command.
        command: Command,
    },
    /// The frame can't be built.
    Encode(EncodeError),
}

impl fmt::Display for MessageError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unknown { code } => write!(f, "{code:02X} is no command"),
            Self::NoReply { command } => write!(f, "{} is not answered", command.name()),
            Self::Size { command, found, expected } => {
                write!(f, "{} has ", command.name())?;
                match expected {
                    [0] => f.write_str("no")?,
                    sizes => Or(sizes).fmt(f)?,
                }
                let s = if *expected == [1] { "" } else { "s" };
                write!(f, " byte{s} of data here, not {found}")
            }
            Self::Value { command } => {
                write!(f, "{} takes another value here, or none", command.name())
            }
            Self::NotANumber { command } => {
                write!(f, "{} takes a number, and this is none", command.name())
            }
            Self::Encode(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for MessageError {}

impl From<EncodeError> for MessageError {
    fn from(error: EncodeError) -> Self {
        Self::Encode(error)
    }
}
