//! Bulk instructions: registers of several devices, with an address and a length for each device.

use core::borrow::Borrow;

use super::RequestError;
use super::params::Params;
use crate::EncodeError;
use crate::dynamixel2::frame::{check_device, encode_with, len_of, length_field};
use crate::dynamixel2::{BROADCAST_ID, Instruction};

/// Reads registers of several devices, each of which answers with a status packet (DYNAMIXEL
/// Protocol 2.0, Bulk Read).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BulkRead<D> {
    /// The reads, in the order of the answers.
    pub devices: D,
}

/// The registers to read from a device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DeviceRange {
    /// The device.
    pub id: u8,
    /// The first byte's address.
    pub address: u16,
    /// The number of bytes.
    pub length: u16,
}

impl<D: IntoIterator<Item: Borrow<DeviceRange>> + Clone> BulkRead<D> {
    /// Builds the packet in `buffer`, 10 bytes and five more for each device, or more if it needs
    /// stuffing; returns the packet.
    ///
    /// # Errors
    /// If an ID is not a device's, otherwise as
    /// [`frame::encode`](crate::dynamixel2::frame::encode).
    pub fn encode<'b>(&self, buffer: &'b mut [u8]) -> Result<&'b [u8], EncodeError> {
        let devices = || self.devices.clone().into_iter().map(|device| *device.borrow());
        devices().try_for_each(|device| check_device(device.id))?;
        let params = |put: &mut dyn FnMut(&[u8])| {
            devices().for_each(|device| put(&head(device.id, device.address, device.length)));
        };
        encode_with(BROADCAST_ID, Instruction::BulkRead, params, buffer)
    }

    /// The size of the packet in bytes, including stuffing.
    ///
    /// # Errors
    /// As `encode`, except for the size of its buffer.
    pub fn encoded_len(&self) -> Result<usize, EncodeError> {
        len_of(|buffer| self.encode(buffer))
    }
}

impl<'a> BulkRead<RangeBlocks<'a>> {
    /// Reads its parameters.
    ///
    /// # Errors
    /// If they end within a device's block, or name an ID that no device has.
    pub fn parse(params: &'a [u8]) -> Result<Self, RequestError> {
        let devices = RangeBlocks(Params::new(params));
        let mut params = Params::new(params);
        while !params.rest().is_empty() {
            range(&mut params)?;
        }
        Ok(Self { devices })
    }
}

/// Writes registers of several devices, which don't answer (DYNAMIXEL Protocol 2.0, Bulk Write).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BulkWrite<D> {
    /// The writes.
    pub devices: D,
}

/// The data to write to a device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DeviceWrite<'a> {
    /// The device.
    pub id: u8,
    /// The first byte's address.
    pub address: u16,
    /// The bytes.
    pub data: &'a [u8],
}

impl<'d, D: IntoIterator<Item: Borrow<DeviceWrite<'d>>> + Clone> BulkWrite<D> {
    /// Builds the packet in `buffer`, 10 bytes, and five and its data more for each device, or
    /// more if it needs stuffing; returns the packet.
    ///
    /// # Errors
    /// If an ID is not a device's, otherwise as
    /// [`frame::encode`](crate::dynamixel2::frame::encode).
    pub fn encode<'b>(&self, buffer: &'b mut [u8]) -> Result<&'b [u8], EncodeError> {
        let devices = || self.devices.clone().into_iter().map(|device| *device.borrow());
        for device in devices() {
            check_device(device.id)?;
            length_field(device.data.len())?;
        }
        let params = |put: &mut dyn FnMut(&[u8])| {
            for device in devices() {
                // Checked above.
                let length = u16::try_from(device.data.len()).unwrap_or_default();
                put(&head(device.id, device.address, length));
                put(device.data);
            }
        };
        encode_with(BROADCAST_ID, Instruction::BulkWrite, params, buffer)
    }

    /// The size of the packet in bytes, including stuffing.
    ///
    /// # Errors
    /// As `encode`, except for the size of its buffer.
    pub fn encoded_len(&self) -> Result<usize, EncodeError> {
        len_of(|buffer| self.encode(buffer))
    }
}

impl<'a> BulkWrite<WriteBlocks<'a>> {
    /// Reads its parameters.
    ///
    /// # Errors
    /// If they end within a device's block, or name an ID that no device has.
    pub fn parse(params: &'a [u8]) -> Result<Self, RequestError> {
        let devices = WriteBlocks(Params::new(params));
        let mut params = Params::new(params);
        while !params.rest().is_empty() {
            write(&mut params)?;
        }
        Ok(Self { devices })
    }
}

fn head(id: u8, address: u16, length: u16) -> [u8; 5] {
    let ([a, b], [c, d]) = (address.to_le_bytes(), length.to_le_bytes());
    [id, a, b, c, d]
}

fn range(params: &mut Params<'_>) -> Result<DeviceRange, RequestError> {
    let (id, address, length) = (params.id()?, params.u16("address")?, params.u16("length")?);
    Ok(DeviceRange { id, address, length })
}

fn write<'a>(params: &mut Params<'a>) -> Result<DeviceWrite<'a>, RequestError> {
    let DeviceRange { id, address, length } = range(params)?;
    Ok(DeviceWrite { id, address, data: params.take("data", length.into())? })
}

/// The devices of a received [`BulkRead`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RangeBlocks<'a>(Params<'a>);

impl Iterator for RangeBlocks<'_> {
    type Item = DeviceRange;

    fn next(&mut self) -> Option<Self::Item> {
        range(&mut self.0).ok()
    }
}

/// The devices of a received [`BulkWrite`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WriteBlocks<'a>(Params<'a>);

impl<'a> Iterator for WriteBlocks<'a> {
    type Item = DeviceWrite<'a>;

    fn next(&mut self) -> Option<Self::Item> {
        write(&mut self.0).ok()
    }
}
