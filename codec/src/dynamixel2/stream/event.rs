//! What comes out of a stream.

use core::fmt;

use crate::dynamixel2::{FastStatus, Frame, FrameError};

/// What the next bytes of a stream are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event<'a> {
    /// A packet.
    Frame(Frame<'a>),
    /// A status packet that several devices may have answered with together.
    FastStatus(RawFastStatus<'a>),
    /// Bytes that belong to no packet.
    Skipped {
        /// How many, from the byte at which the run begins up to the next header.
        bytes: u64,
        /// Why a packet does not begin with the first of them.
        reason: Reason,
    },
}

/// Why a packet does not begin where a run of skipped bytes begins.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Reason {
    /// There is no header.
    #[default]
    Garbage,
    /// The ID is neither that of a device nor the broadcast ID.
    Id,
    /// The length is less than a packet with such an instruction has.
    Length,
    /// The packet would be longer than the parser takes.
    Oversize,
    /// FF FF FD stands in the body without FD behind it.
    Stuffing,
    /// The CRC does not match.
    Crc,
    /// The bus went quiet before the packet was complete.
    Truncated,
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Garbage => "no header",
            Self::Id => "a header with an ID that no device has",
            Self::Length => "a header with a length that is too small",
            Self::Oversize => "a header with a length beyond the limit",
            Self::Stuffing => "a header, then FF FF FD without FD behind it",
            Self::Crc => "a packet with a wrong CRC",
            Self::Truncated => "a packet that the bus did not complete",
        })
    }
}

/// A status packet from the broadcast ID: header, length and last CRC are right.
///
/// No device has that ID, so this can only answer Fast Sync Read or Fast Sync Write. Such a
/// packet is not stuffed, and where its blocks and their CRCs lie is not written in it; it takes
/// the request to [`parse`](Self::parse) them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RawFastStatus<'a> {
    bytes: &'a [u8],
}

impl<'a> RawFastStatus<'a> {
    pub(super) const fn new(bytes: &'a [u8]) -> Self {
        Self { bytes }
    }

    /// The packet as it was on the wire.
    #[must_use]
    pub const fn bytes(&self) -> &'a [u8] {
        self.bytes
    }

    /// Reads it as the answer to an instruction for `length` bytes of data (0 for Fast Sync
    /// Write) from the devices `ids`.
    ///
    /// # Errors
    /// As [`FastStatus::parse`].
    pub fn parse(&self, length: u16, ids: &[u8]) -> Result<FastStatus<'a>, FrameError> {
        FastStatus::parse(self.bytes, length, ids)
    }
}
