//! Fast status packets, with which several devices answer Fast Sync Read or Fast Sync Write
//! together (JA40 document, §1.6.8 and §1.6.9).
//!
//! Each device appends a block: error, ID, data, CRC. A CRC covers everything before it, including
//! the CRCs of earlier blocks; the last CRC is that of the packet. There is no stuffing.
//!
//! A block that answers Fast Sync Write has no data in the JA40 document. Later devices of the same
//! maker add their present position: read such an answer with the size of the position as `length`.

use super::frame::{Parts, Writer, length_field};
use super::header::PREFIX;
use super::{BROADCAST_ID, FrameError, Instruction, StatusError};
use crate::register::{Register, RegisterError, Value};
use crate::{EncodeError, crc};

/// Bytes of a block in addition to its data: error, ID and CRC.
const BLOCK_OVERHEAD: usize = 4;

/// One device's part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Block<'a> {
    /// The device's error byte.
    pub error: StatusError,
    /// The device.
    pub id: u8,
    /// The data that was read; for Fast Sync Write empty, or the data that the device adds.
    pub data: &'a [u8],
}

impl Block<'_> {
    /// The value of a register, if the block has exactly its bytes.
    ///
    /// # Errors
    /// If the number of bytes is not that of the register.
    pub fn value<T: Value>(&self, register: Register<T>) -> Result<T, RegisterError> {
        register.decode(self.data)
    }
}

/// A fast status packet in which everything is right: header, length, IDs and every CRC.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FastStatus<'a> {
    blocks: &'a [u8],
    data_len: usize,
}

impl<'a> FastStatus<'a> {
    /// Reads `bytes`, the one packet that answers an instruction for `length` bytes of data (0 for
    /// Fast Sync Write) from the devices `ids`, in this order. If the request is still available,
    /// use [`FastSyncRead::answer`](super::instruction::FastSyncRead::answer).
    ///
    /// ```
    /// use actucheck_codec::dynamixel2::FastStatus;
    /// use actucheck_codec::ja40;
    /// // What devices 1 and 2 answer to a Fast Sync Read of Present Position, 4 bytes.
    /// let packet = b"\xFF\xFF\xFD\x00\xFE\x11\x00\x55\
    ///     \x00\x01\xD0\x07\x00\x00\x0C\x83\
    ///     \x00\x02\x09\x00\x00\x00\x11\x40";
    /// let mut positions = Vec::new();
    /// for block in FastStatus::parse(packet, 4, &[1, 2])?.blocks() {
    ///     assert!(!block.error.alert());
    ///     positions.push((block.id, block.value(ja40::PRESENT_POSITION)?));
    /// }
    /// assert_eq!(positions, [(1, 2000), (2, 9)]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// The first rule that the bytes break, with the offset.
    pub fn parse(bytes: &'a [u8], length: u16, ids: &[u8]) -> Result<Self, FrameError> {
        Self::of(bytes, length, || ids.iter().copied())
    }

    /// The same, with the devices from a function that lists them.
    pub(crate) fn of<I: Iterator<Item = u8>>(
        bytes: &'a [u8],
        length: u16,
        ids: impl Fn() -> I,
    ) -> Result<Self, FrameError> {
        let parts = Parts::split(bytes)?;
        let (code, blocks) = parts.body.split_first().unwrap_or((&0, &[]));
        if Instruction::from_code(*code) != Instruction::Status {
            return Err(FrameError::Instruction { found: *code });
        }
        if parts.header.id != BROADCAST_ID {
            return Err(FrameError::Id { found: parts.header.id });
        }
        let block_len = BLOCK_OVERHEAD + usize::from(length);
        let devices = ids().count();
        let (found, expected) =
            (parts.body.len() + 2, block_len.saturating_mul(devices).saturating_add(1));
        if found != expected || devices == 0 {
            return Err(FrameError::Length { found, expected });
        }
        // The last block's CRC is the packet's, so `blocks` ends two bytes before the packet's end.
        parts.check_crc()?;
        let mut start = PREFIX + 1;
        for (block, id) in blocks.chunks(block_len).zip(ids()) {
            if let [_, found, ..] = block
                && *found != id
            {
                return Err(FrameError::BlockId { at: start + 1, found: *found, expected: id });
            }
            let at = start + block_len - 2;
            if let (Some(before), Some([low, high])) = (bytes.get(..at), block.get(block_len - 2..))
            {
                let (found, expected) = (u16::from_le_bytes([*low, *high]), crc::umts(before));
                if found != expected {
                    return Err(FrameError::Crc { at, found, expected });
                }
            }
            start += block_len;
        }
        Ok(Self { blocks, data_len: length.into() })
    }

    /// The blocks, in the order of the request.
    pub fn blocks(&self) -> impl Iterator<Item = Block<'a>> + use<'a> {
        let data_len = self.data_len;
        self.blocks.chunks(BLOCK_OVERHEAD + data_len).filter_map(move |block| {
            let (head, rest) = block.split_first_chunk::<2>()?;
            let [error, id] = *head;
            Some(Block { error: StatusError(error), id, data: rest.get(..data_len)? })
        })
    }
}

/// Builds a fast status packet in `buffer`; returns the packet. All blocks have data of the same
/// size.
///
/// # Errors
/// If the packet would be longer than its length field can say, or `buffer` is too small; the error
/// has the size needed.
pub fn encode<'b>(blocks: &[Block<'_>], buffer: &'b mut [u8]) -> Result<&'b [u8], EncodeError> {
    let data: usize = blocks.iter().map(|block| block.data.len()).sum();
    let length = length_field(1 + blocks.len() * BLOCK_OVERHEAD + data)?;
    let mut writer = Writer::new(buffer);
    writer.put_prefix(BROADCAST_ID, length);
    writer.skip_prefix();
    writer.put(Instruction::Status.code());
    for block in blocks {
        writer.put(block.error.0);
        writer.put(block.id);
        writer.put_all(block.data);
        writer.put_crc();
    }
    writer.into_written()
}
