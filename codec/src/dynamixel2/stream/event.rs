//! The events of a stream.

use core::fmt;

use crate::dynamixel2::{FastStatus, Frame, FrameError};

/// The meaning of the next bytes of a stream.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event<'a> {
    /// A packet.
    Frame(Frame<'a>),
    /// A fast status packet, with which several devices may have answered together.
    FastStatus(RawFastStatus<'a>),
    /// Bytes that belong to no packet.
    Skipped {
        /// The number of bytes, from the beginning of the run up to the next header.
        bytes: u64,
        /// Why no packet begins at the first of them.
        reason: Reason,
    },
}

/// Why no packet begins at the beginning of a run of skipped bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Reason {
    /// There is no header.
    #[default]
    Garbage,
    /// The ID is neither a device's ID nor the broadcast ID.
    Id,
    /// The length is too small for a packet with this instruction.
    Length,
    /// The packet would be longer than the parser's limit.
    Oversize,
    /// The body has FF FF FD without FD after it.
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
            Self::Stuffing => "a header, then FF FF FD without FD after it",
            Self::Crc => "a packet with a wrong CRC",
            Self::Truncated => "a packet that the bus did not complete",
        })
    }
}

/// A status packet from the broadcast ID: header, length and last CRC are right.
///
/// No device has that ID, so this can only be the answer to Fast Sync Read or Fast Sync Write. Such
/// a packet is not stuffed and does not state where its blocks and their CRCs are;
/// [`parse`](Self::parse) needs the request.
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
