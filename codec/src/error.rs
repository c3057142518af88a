//! Errors of building a packet, and the one error into which all others convert.

use core::fmt;

use crate::layout::LayoutError;
use crate::register::RegisterError;
use crate::{dynamixel2, innfos};

/// A buffer is too small. Its contents are then unspecified.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BufferTooSmall {
    /// The number of bytes needed.
    pub needed: usize,
    /// The number of bytes available.
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
    /// The ID is neither a device's ID nor the broadcast ID.
    Id {
        /// The ID.
        found: u8,
    },
    /// The length field can't hold the packet's length.
    TooLong {
        /// The length; at most 65,535 is possible.
        length: usize,
    },
    /// A device's data does not have the number of bytes that the instruction states.
    DataLength {
        /// The device.
        id: u8,
        /// The number of bytes found.
        found: usize,
        /// The number of bytes expected.
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

/// Any error of this crate, for code that passes errors on with `?`. Every other error converts
/// into it.
///
/// ```
/// use actucheck_codec::dynamixel2::Frame;
/// use actucheck_codec::{Error, ja40};
///
/// fn position(packet: &[u8]) -> Result<i32, Error> {
///     Ok(Frame::parse(packet)?.status()?.value(ja40::PRESENT_POSITION)?)
/// }
///
/// let error = position(b"\xFF\xFF\xFD\x00\x01\x03\x00\x01\x19\x00").unwrap_err();
/// assert_eq!(error.to_string(), "crc: bytes 8 and 9 are 19 00, 19 4E is expected");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Error {
    /// A buffer is too small.
    Buffer(BufferTooSmall),
    /// A packet or frame can't be built.
    Encode(EncodeError),
    /// Bytes are not a packet of DYNAMIXEL Protocol 2.0.
    Frame(dynamixel2::FrameError),
    /// A packet is not an instruction that a device can carry out.
    Request(dynamixel2::RequestError),
    /// A body can't be unstuffed.
    Stuffing(dynamixel2::stuffing::UnstuffError),
    /// Parameters do not fit their layout.
    Layout(LayoutError),
    /// A register can't be written or read.
    Register(RegisterError),
    /// Bytes are not a frame of INNFOS.
    InnfosFrame(innfos::FrameError),
    /// A frame of INNFOS has no meaning, or a message has no frame.
    InnfosMessage(innfos::MessageError),
}

macro_rules! from {
    ($($variant:ident: $error:ty,)*) => {
        $(impl From<$error> for Error {
            fn from(error: $error) -> Self {
                Self::$variant(error)
            }
        })*

        impl fmt::Display for Error {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                match self {
                    $(Self::$variant(error) => error.fmt(f),)*
                }
            }
        }
    };
}

from! {
    Buffer: BufferTooSmall,
    Encode: EncodeError,
    Frame: dynamixel2::FrameError,
    Request: dynamixel2::RequestError,
    Stuffing: dynamixel2::stuffing::UnstuffError,
    Layout: LayoutError,
    Register: RegisterError,
    InnfosFrame: innfos::FrameError,
    InnfosMessage: innfos::MessageError,
}

impl core::error::Error for Error {}
