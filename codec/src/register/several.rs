//! The same register of several devices.

use core::borrow::Borrow;

use super::{Data, Register, RegisterError, Row, Value};
use crate::EncodeError;
use crate::dynamixel2::instruction::{FastSyncRead, SyncRead};
use crate::dynamixel2::{BROADCAST_ID, Instruction, frame};

impl<T: Value> Register<T> {
    /// The request to read it from several devices, each of which answers.
    #[must_use]
    pub const fn sync_read<I>(self, ids: I) -> SyncRead<I> {
        SyncRead { address: self.row.address, length: self.row.kind.size(), ids }
    }

    /// The same, with one common answer (JA40 document, §1.6.8).
    #[must_use]
    pub const fn fast_sync_read<I>(self, ids: I) -> FastSyncRead<I> {
        FastSyncRead { address: self.row.address, length: self.row.kind.size(), ids }
    }

    /// The request to write it on several devices, from pairs of an ID and a value. Bounds that are
    /// other registers' values are not checked, as each device has its own limits.
    ///
    /// ```
    /// use actucheck_codec::ja40;
    /// let mut buffer = [0; 64];
    /// let packet = ja40::GOAL_POSITION.sync_write([(1, 150), (2, -170)])?.encode(&mut buffer)?;
    /// assert_eq!(packet[7], 0x83); // Sync Write
    /// assert_eq!(packet[12..22], *b"\x01\x96\x00\x00\x00\x02\x56\xFF\xFF\xFF");
    /// # Ok::<(), actucheck_codec::Error>(())
    /// ```
    ///
    /// # Errors
    /// If the register is read-only or a value outside its range.
    pub fn sync_write<D>(self, devices: D) -> Result<RegisterSyncWrite<T, D>, RegisterError>
    where
        D: IntoIterator<Item: Borrow<(u8, T)>> + Clone,
    {
        for device in devices.clone() {
            let (_, value) = *device.borrow();
            self.row.encode(value.raw(), |_| None)?;
        }
        let instruction = Instruction::SyncWrite;
        Ok(RegisterSyncWrite { register: self, devices, instruction })
    }
}

/// The request to write a register of several devices, with checked values.
#[derive(Clone, Copy, Debug)]
pub struct RegisterSyncWrite<T, D> {
    register: Register<T>,
    devices: D,
    instruction: Instruction,
}

impl<T: Value, D: IntoIterator<Item: Borrow<(u8, T)>> + Clone> RegisterSyncWrite<T, D> {
    /// The same as a Fast Sync Write, which the devices answer together (JA40 document, §1.6.9).
    #[must_use]
    pub fn fast(self) -> Self {
        Self { instruction: Instruction::FastSyncWrite, ..self }
    }

    /// Builds the packet in `buffer`, 14 bytes, and an ID and a value more for each device, or more
    /// if it needs stuffing; returns the packet.
    ///
    /// # Errors
    /// If an ID is not a device's, otherwise as [`frame::encode`].
    pub fn encode<'b>(&self, buffer: &'b mut [u8]) -> Result<&'b [u8], EncodeError> {
        let Row { address, kind, .. } = *self.register.row;
        let devices = || self.devices.clone().into_iter().map(|device| *device.borrow());
        devices().try_for_each(|(id, _)| frame::check_device(id))?;
        let params = |put: &mut dyn FnMut(&[u8])| {
            put(&address.to_le_bytes());
            put(&kind.size().to_le_bytes());
            for (id, value) in devices() {
                put(&[id]);
                put(Data::of(kind, value.raw()).as_bytes());
            }
        };
        frame::encode_with(BROADCAST_ID, self.instruction, params, buffer)
    }

    /// The size of the packet in bytes, including stuffing.
    ///
    /// # Errors
    /// As [`RegisterSyncWrite::encode`], except for the size of its buffer.
    pub fn encoded_len(&self) -> Result<usize, EncodeError> {
        frame::len_of(|buffer| self.encode(buffer))
    }
}
