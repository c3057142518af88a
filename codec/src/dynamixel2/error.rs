//! What can be wrong with a packet that was received.

use core::fmt;

use super::HEADER;
use super::header::PREFIX;

/// Why bytes are no frame. Offsets count from the first byte of the frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrameError {
    /// A byte of the header is another.
    Header {
        /// Where.
        at: usize,
        /// The byte there.
        found: u8,
        /// The byte that a header has there.
        expected: u8,
    },
    /// The ID is neither that of a device nor the broadcast ID.
    Id {
        /// The ID.
        found: u8,
    },
    /// The length field is one that such a packet can't have.
    Length {
        /// What the field says.
        found: usize,
        /// What it says at least, or exactly where the packet's size is known beforehand.
        expected: usize,
    },
    /// The bytes end early.
    Truncated {
        /// Bytes that are there.
        available: usize,
        /// Bytes that the frame has, or the header has if even that is incomplete.
        needed: usize,
    },
    /// Bytes follow the frame.
    Trailing {
        /// Bytes that the frame has.
        end: usize,
        /// Bytes that are there.
        available: usize,
    },
    /// The CRC does not match.
    Crc {
        /// Where it stands.
        at: usize,
        /// The CRC there.
        found: u16,
        /// The CRC of the bytes before it.
        expected: u16,
    },
    /// The pattern of byte stuffing stands in the body without the byte that belongs behind it.
    Stuffing {
        /// Where that byte is missing.
        at: usize,
    },
    /// The instruction is not that of a status packet.
    Instruction {
        /// The instruction.
        found: u8,
    },
    /// A block of a fast status packet is another device's.
    BlockId {
        /// Where the ID stands.
        at: usize,
        /// The ID there.
        found: u8,
        /// The ID of the device whose turn it is.
        expected: u8,
    },
}

impl FrameError {
    /// The offset of the byte that gives the frame away.
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
