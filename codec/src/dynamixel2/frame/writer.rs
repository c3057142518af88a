//! Writes the parts of a packet.

use super::length_field;
use crate::dynamixel2::HEADER;
use crate::dynamixel2::header::{CRC, PREFIX};
use crate::{BufferTooSmall, EncodeError, crc};

/// Writes a packet from front to back. When the buffer is full, it only counts.
pub(crate) struct Writer<'b> {
    buffer: &'b mut [u8],
    written: usize,
}

impl<'b> Writer<'b> {
    pub(crate) fn new(buffer: &'b mut [u8]) -> Self {
        Self::after(buffer, 0)
    }

    /// Continues after the bytes that are already written.
    pub(super) fn after(buffer: &'b mut [u8], written: usize) -> Self {
        Self { buffer, written }
    }

    /// Leaves space for header, ID and length.
    pub(crate) fn skip_prefix(&mut self) {
        self.written += PREFIX;
    }

    pub(crate) fn put(&mut self, byte: u8) {
        if let Some(slot) = self.buffer.get_mut(self.written) {
            *slot = byte;
        }
        self.written += 1;
    }

    pub(crate) fn put_all(&mut self, bytes: &[u8]) {
        let end = self.written + bytes.len();
        if let Some(slots) = self.buffer.get_mut(self.written..end) {
            slots.copy_from_slice(bytes);
        }
        self.written = end;
    }

    /// The number of bytes written; `None` if they did not fit.
    pub(super) fn written(&self) -> Option<usize> {
        Some(self.written).filter(|written| *written <= self.buffer.len())
    }

    /// Appends the CRC of all bytes written so far.
    pub(crate) fn put_crc(&mut self) {
        let crc = crc::umts(self.buffer.get(..self.written).unwrap_or_default());
        let [low, high] = crc.to_le_bytes();
        self.put(low);
        self.put(high);
    }

    /// Writes header, ID and length; nothing if they don't fit.
    pub(crate) fn put_prefix(&mut self, id: u8, length: u16) {
        let [length_low, length_high] = length.to_le_bytes();
        let [first, second, third, reserved] = HEADER;
        if let Some(prefix) = self.buffer.first_chunk_mut() {
            *prefix = [first, second, third, reserved, id, length_low, length_high];
        }
    }

    /// Fills in the prefix, appends the CRC; returns the frame.
    pub(super) fn finish(mut self, id: u8) -> Result<&'b [u8], EncodeError> {
        let length = length_field(self.written + CRC - PREFIX)?;
        self.put_prefix(id, length);
        self.put_crc();
        self.into_written()
    }

    pub(crate) fn into_written(self) -> Result<&'b [u8], EncodeError> {
        let too_small = BufferTooSmall { needed: self.written, available: self.buffer.len() };
        Ok(self.buffer.get(..self.written).ok_or(too_small)?)
    }
}
