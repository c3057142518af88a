//! The adapter protocol's objects.

use serde::{Deserialize, Serialize};

use crate::Hex;

/// A packet as its fields.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Packet {
    /// An instruction packet, which a host sends.
    Instruction {
        /// The ID of the device that it is for.
        id: u8,
        /// The instruction's code.
        instruction: u8,
        /// Everything between the instruction and the CRC, before stuffing.
        params: Hex,
        /// The same request as a call.
        call: Call,
    },
    /// A status packet, which a device answers.
    Status {
        /// The ID of the device that answers.
        id: u8,
        /// The whole error byte, alert bit included.
        error: u8,
        /// Everything between the error and the CRC, before stuffing.
        params: Hex,
    },
    /// A fast status packet, with which several devices answer together.
    FastStatus {
        /// One block per device, in the order of the request.
        blocks: Vec<Block>,
    },
}

/// One device's part of a fast status packet.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize, Serialize)]
pub struct Block {
    /// The whole error byte.
    pub error: u8,
    /// The ID of the device that answers.
    pub id: u8,
    /// The data that was read.
    pub data: Hex,
}

/// An instruction as a call. Its fields have the names of the documents.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize, Serialize)]
#[serde(tag = "name", rename_all = "snake_case")]
#[allow(missing_docs)] // the variants are the instructions, the fields their parameters
pub enum Call {
    Ping,
    Read {
        address: u16,
        length: u16,
    },
    Write {
        address: u16,
        data: Hex,
    },
    RegWrite {
        address: u16,
        data: Hex,
    },
    Action,
    FactoryReset {
        option: Option<u8>,
    },
    Reboot,
    Clear {
        params: Hex,
    },
    ControlTableBackup {
        params: Hex,
    },
    SyncRead {
        address: u16,
        length: u16,
        ids: Vec<u8>,
    },
    FastSyncRead {
        address: u16,
        length: u16,
        ids: Vec<u8>,
    },
    SyncWrite {
        address: u16,
        length: u16,
        devices: Vec<Device>,
    },
    FastSyncWrite {
        address: u16,
        length: u16,
        devices: Vec<Device>,
    },
    BulkRead {
        devices: Vec<Device>,
    },
    BulkWrite {
        devices: Vec<Device>,
    },
    /// Any other instruction, or one with parameters that fit none of these.
    Instruction {
        instruction: u8,
        params: Hex,
    },
}

/// One device in a call for several devices. The instruction determines the fields in use; the
/// others are 0 or empty.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize, Serialize)]
pub struct Device {
    /// The device's ID.
    pub id: u8,
    /// The address to read or write.
    #[serde(default)]
    pub address: u16,
    /// How many bytes to read.
    #[serde(default)]
    pub length: u16,
    /// The data to write.
    #[serde(default)]
    pub data: Hex,
}

/// The request that a fast status packet answers.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
pub struct Fast {
    /// Bytes of data a block; 0 for Fast Sync Write.
    pub length: u16,
    /// The devices in the order of the request.
    pub ids: Vec<u8>,
}
