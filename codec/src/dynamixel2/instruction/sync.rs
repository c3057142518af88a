//! Sync instructions: the same registers of several devices.

use core::borrow::Borrow;

use super::RequestError;
use super::params::Params;
use crate::EncodeError;
use crate::dynamixel2::frame::{check_device, encode_with, len_of};
use crate::dynamixel2::{BROADCAST_ID, FastStatus, FrameError, Instruction};

macro_rules! read {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub struct $name<I> {
            /// The first byte's address.
            pub address: u16,
            /// The number of bytes per device.
            pub length: u16,
            /// The devices, in the order of their answers.
            pub ids: I,
        }

        impl<I: IntoIterator<Item: Borrow<u8>> + Clone> $name<I> {
            /// Builds the packet in `buffer`, 14 bytes and one more for each device, or more if it
            /// needs stuffing; returns the packet.
            ///
            /// # Errors
            /// If an ID is not a device's, otherwise as
            /// [`frame::encode`](crate::dynamixel2::frame::encode).
            pub fn encode<'b>(&self, buffer: &'b mut [u8]) -> Result<&'b [u8], EncodeError> {
                let ids = || self.ids.clone().into_iter().map(|id| *id.borrow());
                ids().try_for_each(check_device)?;
                let params = |put: &mut dyn FnMut(&[u8])| {
                    put(&head(self.address, self.length));
                    ids().for_each(|id| put(&[id]));
                };
                encode_with(BROADCAST_ID, Instruction::$name, params, buffer)
            }

            /// The size of the packet in bytes, including stuffing.
            ///
            /// # Errors
            /// As `encode`, except for the size of its buffer.
            pub fn encoded_len(&self) -> Result<usize, EncodeError> {
                len_of(|buffer| self.encode(buffer))
            }
        }

        impl<'a> $name<&'a [u8]> {
            /// Reads its parameters.
            ///
            /// # Errors
            /// If they are fewer than four bytes, or name an ID that no device has.
            pub fn parse(params: &'a [u8]) -> Result<Self, RequestError> {
                let mut params = Params::new(params);
                let (address, length) = (params.u16("address")?, params.u16("length")?);
                let ids = params.rest();
                while !params.rest().is_empty() {
                    params.id()?;
                }
                Ok(Self { address, length, ids })
            }
        }
    };
}

read! {
    /// Reads the same registers of several devices, each of which answers with a status packet
    /// (DYNAMIXEL Protocol 2.0, Sync Read).
    ///
    /// ```
    /// use actucheck_codec::dynamixel2::instruction::SyncRead;
    /// use actucheck_codec::dynamixel2::Frame;
    /// use actucheck_codec::xm430_w210;
    /// let mut buffer = [0; 32];
    /// let packet = SyncRead { address: 132, length: 4, ids: [1, 2] }.encode(&mut buffer)?;
    /// assert_eq!(packet, b"\xFF\xFF\xFD\x00\xFE\x09\x00\x82\x84\x00\x04\x00\x01\x02\xCE\xFA");
    ///
    /// let answer = b"\xFF\xFF\xFD\x00\x01\x08\x00\x55\x00\xA6\x00\x00\x00\x8C\xC0";
    /// let status = Frame::parse(answer)?.status()?;
    /// assert_eq!((status.id(), status.value(xm430_w210::PRESENT_POSITION)?), (1, 166));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    SyncRead
}

read! {
    /// Reads the same registers of several devices, which answer with one packet together:
    /// [`FastStatus`](crate::dynamixel2::FastStatus) (JA40 document, §1.6.8).
    FastSyncRead
}

impl<I: IntoIterator<Item: Borrow<u8>> + Clone> FastSyncRead<I> {
    /// Reads the packet with which the devices answer.
    ///
    /// ```
    /// use actucheck_codec::ja40;
    /// let request = ja40::PRESENT_POSITION.fast_sync_read([1, 2]);
    /// let packet = b"\xFF\xFF\xFD\x00\xFE\x11\x00\x55\
    ///     \x00\x01\xD0\x07\x00\x00\x0C\x83\
    ///     \x00\x02\x09\x00\x00\x00\x11\x40";
    /// for block in request.answer(packet)?.blocks() {
    ///     println!("{}: {}", block.id, block.value(ja40::PRESENT_POSITION)?);
    /// }
    /// # Ok::<(), actucheck_codec::Error>(())
    /// ```
    ///
    /// # Errors
    /// The first rule that the bytes break, with the offset.
    pub fn answer<'a>(&self, bytes: &'a [u8]) -> Result<FastStatus<'a>, FrameError> {
        let ids = || self.ids.clone().into_iter().map(|id| *id.borrow());
        FastStatus::of(bytes, self.length, ids)
    }
}

/// A device, and the data to write to it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DeviceData<'a> {
    /// The device.
    pub id: u8,
    /// The bytes.
    pub data: &'a [u8],
}

macro_rules! write {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub struct $name<D> {
            /// The first byte's address.
            pub address: u16,
            /// The number of bytes per device.
            pub length: u16,
            /// The devices with their data.
            pub devices: D,
        }

        impl<'d, D: IntoIterator<Item: Borrow<DeviceData<'d>>> + Clone> $name<D> {
            /// Builds the packet in `buffer`, 14 bytes and `1 + length` more for each device, or
            /// more if it needs stuffing; returns the packet.
            ///
            /// # Errors
            /// If an ID is not a device's, or a device's data is not `length` bytes, otherwise as
            /// [`frame::encode`](crate::dynamixel2::frame::encode).
            pub fn encode<'b>(&self, buffer: &'b mut [u8]) -> Result<&'b [u8], EncodeError> {
                let devices = || self.devices.clone().into_iter().map(|device| *device.borrow());
                devices().try_for_each(|device| device.check(self.length))?;
                let params = |put: &mut dyn FnMut(&[u8])| {
                    put(&head(self.address, self.length));
                    for device in devices() {
                        put(&[device.id]);
                        put(device.data);
                    }
                };
                encode_with(BROADCAST_ID, Instruction::$name, params, buffer)
            }

            /// The size of the packet in bytes, including stuffing.
            ///
            /// # Errors
            /// As `encode`, except for the size of its buffer.
            pub fn encoded_len(&self) -> Result<usize, EncodeError> {
                len_of(|buffer| self.encode(buffer))
            }
        }

        impl<'a> $name<DataBlocks<'a>> {
            /// Reads its parameters.
            ///
            /// # Errors
            /// If they end within a device's data, or name an ID that no device has.
            pub fn parse(params: &'a [u8]) -> Result<Self, RequestError> {
                let mut params = Params::new(params);
                let (address, length) = (params.u16("address")?, params.u16("length")?);
                let devices = DataBlocks { blocks: params.rest(), length: length.into() };
                while !params.rest().is_empty() {
                    params.id()?;
                    params.take("data", length.into())?;
                }
                Ok(Self { address, length, devices })
            }
        }
    };
}

write! {
    /// Writes the same registers of several devices, which don't answer (DYNAMIXEL Protocol 2.0,
    /// Sync Write).
    SyncWrite
}

write! {
    /// Writes the same registers of several devices, which answer with one packet together:
    /// [`FastStatus`](crate::dynamixel2::FastStatus) (JA40 document, §1.6.9).
    FastSyncWrite
}

impl<'d, D: IntoIterator<Item: Borrow<DeviceData<'d>>> + Clone> FastSyncWrite<D> {
    /// Reads the packet with which the devices answer: each with an error byte, without data.
    ///
    /// # Errors
    /// The first rule that the bytes break, with the offset.
    pub fn answer<'a>(&self, bytes: &'a [u8]) -> Result<FastStatus<'a>, FrameError> {
        let ids = || self.devices.clone().into_iter().map(|device| device.borrow().id);
        FastStatus::of(bytes, 0, ids)
    }
}

fn head(address: u16, length: u16) -> [u8; 4] {
    let ([a, b], [c, d]) = (address.to_le_bytes(), length.to_le_bytes());
    [a, b, c, d]
}

impl DeviceData<'_> {
    fn check(self, expected: u16) -> Result<(), EncodeError> {
        check_device(self.id)?;
        let (id, found) = (self.id, self.data.len());
        if found == usize::from(expected) {
            Ok(())
        } else {
            Err(EncodeError::DataLength { id, found, expected })
        }
    }
}

/// The devices of a received [`SyncWrite`] or [`FastSyncWrite`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DataBlocks<'a> {
    blocks: &'a [u8],
    length: usize,
}

impl<'a> Iterator for DataBlocks<'a> {
    type Item = DeviceData<'a>;

    fn next(&mut self) -> Option<Self::Item> {
        let (id, rest) = self.blocks.split_first()?;
        let (data, blocks) = rest.split_at_checked(self.length)?;
        self.blocks = blocks;
        Some(DeviceData { id: *id, data })
    }
}
