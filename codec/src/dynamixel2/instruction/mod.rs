//! Instructions, one type each: a host builds them, and a device reads them.
//!
//! An instruction for one device or for all devices is built with `encode(id, buffer)`. An
//! instruction that names its devices in its parameters is sent to the broadcast ID and is built
//! with `encode(buffer)`. Devices come from any iterator that can be cloned, or from an array or
//! slice. The bytes after the packet in the buffer are overwritten.
//!
//! ```
//! use actucheck_codec::dynamixel2::instruction::{DeviceData, Ping, SyncWrite};
//! let mut buffer = [0; 64];
//! assert_eq!(Ping.encode(1, &mut buffer)?, b"\xFF\xFF\xFD\x00\x01\x03\x00\x01\x19\x4E");
//!
//! let devices = [(1, 150_i32.to_le_bytes()), (2, 170_i32.to_le_bytes())];
//! let devices = devices.iter().map(|(id, data)| DeviceData { id: *id, data });
//! let packet = SyncWrite { address: 116, length: 4, devices }.encode(&mut buffer)?;
//! assert_eq!(packet.len(), 24);
//! # Ok::<(), actucheck_codec::EncodeError>(())
//! ```
//!
//! [`Request::parse`] reads any instruction.

mod bulk;
mod error;
mod memory;
mod option;
mod params;
mod plain;
mod request;
mod sync;

pub use bulk::{BulkRead, BulkWrite, DeviceRange, DeviceWrite, RangeBlocks, WriteBlocks};
pub use error::RequestError;
pub use memory::{Read, RegWrite, Write};
pub use option::{Clear, ControlTableBackup, FactoryReset};
pub use plain::{Action, Ping, Reboot};
pub use request::Request;
pub use sync::{DataBlocks, DeviceData, FastSyncRead, FastSyncWrite, SyncRead, SyncWrite};

/// Implements `encode` for an instruction that is sent to an ID.
macro_rules! addressed {
    ($name:ident $(<$lifetime:lifetime>)?) => {
        impl $(<$lifetime>)? $name $(<$lifetime>)? {
            /// Builds the packet for device `id`, or for all with the broadcast ID 254, in
            /// `buffer`; returns the packet.
            ///
            /// # Errors
            /// As [`frame::encode`](crate::dynamixel2::frame::encode).
            pub fn encode<'b>(
                &self,
                id: u8,
                buffer: &'b mut [u8],
            ) -> Result<&'b [u8], crate::EncodeError> {
                let instruction = crate::dynamixel2::Instruction::$name;
                self.with_params(|params| crate::dynamixel2::frame::encode(id, instruction, params, buffer))
            }

            /// The size of the packet in bytes, including stuffing.
            ///
            /// # Errors
            /// If it would be longer than its length field can say.
            pub fn encoded_len(&self) -> Result<usize, crate::EncodeError> {
                crate::dynamixel2::frame::len_of(|buffer| self.encode(0, buffer))
            }
        }
    };
}

use addressed;
