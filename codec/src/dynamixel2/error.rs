//! Faults of a received packet.

use core::fmt;

use super::HEADER;
use super::header::PREFIX;

/// Why bytes are not a valid frame. Offsets count from the first byte of the frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrameError {
    /// A byte of the header is wrong.
    Header {
        /// Offset of the byte.
        at: usize,
        /// The byte found.
        found: u8,
        /// The right byte of a header.
        expected: u8,
    },
    /// The ID is neither a device's ID nor the broadcast ID.
    Id {
        /// The ID.
        found: u8,
    },
    /// The length field is not valid for this packet.
    Length {
        /// The value of the field.
        found: usize,
        /// The smallest valid value, or the exact one if the packet's size is known.
        expected: usize,
    },
    /// There are too few bytes.
    Truncated {
        /// Number of bytes available.
        available: usize,
        /// Number of bytes of the frame, or of the header if that is incomplete.
        needed: usize,
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
        /// The right CRC, of the bytes before it.
        expected: u16,
    },
    /// The body has the pattern of byte stuffing without the stuffing byte after it.
    Stuffing {
        /// Offset at which the stuffing byte is missing.
        at: usize,
    },
    /// The packet is not a status packet.
    Instruction {
        /// The instruction.
        found: u8,
    },
    /// A block of a fast status packet has the wrong device's ID.
    BlockId {
        /// Offset of the ID.
        at: usize,
        /// The ID found.
        found: u8,
        /// The ID that the block must have.
        expected: u8,
    },
}

impl FrameError {
    /// The offset of the first byte that shows the fault.
    #[must_use]
    pub const fn offset(&self) -> usize {
        match *self {
            Self::Header { at, .. }
            | Self::Crc { at, .. }
            | Self::Stuffing { at }
            | Self::BlockId { at, .. } => at,
            Self::Id { .. } => HEADER.len(),
            Self::Length { .. } => HEADER.len() + size_of::<u8>(),
            Self::Instruction { .. } => PREFIX,
            Self::Truncated { available, .. } => available,
            Self::Trailing { end, .. } => end,
        }
    }
}

impl fmt::Display for FrameError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Header { at, found, expected } => {
                write!(f, "header: byte {at} is {found:02X}, a packet has {expected:02X} there")
            }
            Self::Id { found } => {
                write!(f, "id: byte 4 is {found:02X}, an ID is 00 to FC, or FE for broadcast")
            }
            Self::Length { found, expected } => {
                write!(f, "length: bytes 5 and 6 say {found}, {expected} is expected")
            }
            Self::Truncated { available, needed } => {
                write!(f, "truncated: {available} bytes are there, {needed} are needed")
            }
            Self::Trailing { end, available } => write!(
                f,
                "trailing: the packet ends at byte {end}, but {available} bytes are there"
            ),
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
            Self::Stuffing { at } => {
                write!(f, "stuffing: FF FF FD in the body ends before byte {at}, which is not FD")
            }
            Self::Instruction { found } => {
                write!(f, "instruction: byte 7 is {found:02X}, a status packet has 55 there")
            }
            Self::BlockId { at, found, expected } => write!(
                f,
                "id: byte {at} is {found:02X}, the next block is that of device {expected:02X}"
            ),
        }
    }
}

impl core::error::Error for FrameError {}
