//! The wire's packets by their fields.

#[cfg(feature = "exports")]
use schemars::JsonSchema;
use serde::Deserialize;

use crate::model::HexBytes;
use crate::wire::Fast;

/// A packet, before stuffing and CRC.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum Packet {
    /// An instruction packet, which a host sends.
    Instruction {
        /// The ID of the device that it is for; 254 is the broadcast ID.
        id: u8,
        /// The instruction's code.
        instruction: u8,
        /// Everything between the instruction and the CRC.
        params: HexBytes,
    },
    /// A status packet, which a device answers.
    Status {
        /// The ID of the device that answers.
        id: u8,
        /// The whole error byte, alert bit included.
        error: u8,
        /// Everything between the error and the CRC.
        params: HexBytes,
    },
    /// A fast status packet, with which several devices answer Fast Sync Read or Fast Sync Write.
    FastStatus {
        /// One block per device, in the order of the request.
        blocks: Vec<Block>,
    },
}

impl Packet {
    /// For a fast status packet: the request that it answers.
    #[must_use]
    pub fn asked_for(&self) -> Option<Fast> {
        let Self::FastStatus { blocks } = self else { return None };
        let length = blocks.first().map_or(0, |block| block.data.len());
        let ids = blocks.iter().map(|block| block.id).collect();
        Some(Fast { length: u16::try_from(length).unwrap_or(u16::MAX), ids })
    }
}

impl Packet {
    /// The first field in which another packet differs, in words.
    pub(super) fn difference(&self, other: &Self) -> &'static str {
        match (self, other) {
            (Self::Instruction { id, .. }, Self::Instruction { id: other, .. })
            | (Self::Status { id, .. }, Self::Status { id: other, .. })
                if id != other =>
            {
                "ID"
            }
            (
                Self::Instruction { instruction, .. },
                Self::Instruction { instruction: other, .. },
            ) if instruction != other => "instruction",
            (Self::Status { error, .. }, Self::Status { error: other, .. }) if error != other => {
                "error"
            }
            (Self::Instruction { .. }, Self::Instruction { .. })
            | (Self::Status { .. }, Self::Status { .. }) => "parameters",
            (Self::FastStatus { .. }, Self::FastStatus { .. }) => "blocks",
            _ => "kind of packet",
        }
    }
}

/// One device's part of a fast status packet.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Block {
    /// The whole error byte, alert bit included.
    pub error: u8,
    /// The ID of the device that answers.
    pub id: u8,
    /// The data that was read; empty for Fast Sync Write.
    pub data: HexBytes,
}
