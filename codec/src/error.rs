//! What can be wrong with what is to be sent, and with a buffer for it.

use core::fmt;

/// A buffer is too small for what was to be written to it. Its contents are unspecified then.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BufferTooSmall {
    /// Bytes that it would have to have.
    pub needed: usize,
    /// Bytes that it has.
    pub available: usize,
}

impl fmt::Display for BufferTooSmall {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the buffer has {} bytes, {} are needed", self.available, self.needed)
    }
}

impl core::error::Error for BufferTooSmall {}

/// Why a packet can't be built.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EncodeError {
    /// The buffer is too small.
    Buffer(BufferTooSmall),
    /// The ID is neither that of a device nor the broadcast ID.
    Id {
        /// The ID.
        found: u8,
    },
    /// The length field can't hold the packet's length.
    TooLong {
        /// The length; at most 65,535 is possible.
        length: usize,
    },
    /// A device's data are not as many as the instruction says that each device's are.
    DataLength {
        /// The device.
        id: u8,
        /// How many they are.
        found: usize,
        /// What the instruction says.
        expected: u16,
    },
}

impl fmt::Display for EncodeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Buffer(error) => error.fmt(f),
            Self::Id { found } => {
                write!(f, "{found} is no ID; one is 0 to 252, or 254 for broadcast")
            }
            Self::TooLong { length } => {
                write!(f, "the packet's length would be {length}; at most 65535 is possible")
            }
            Self::DataLength { id, found, expected } => {
                write!(f, "device {id} has {found} bytes of data, each device has {expected}")
            }
        }
    }
}

impl core::error::Error for EncodeError {}

impl From<BufferTooSmall> for EncodeError {
    fn from(error: BufferTooSmall) -> Self {
        Self::Buffer(error)
    }
}
