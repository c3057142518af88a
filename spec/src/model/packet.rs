use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::HexBytes;

/// A packet by its fields, before stuffing and CRC. The same object stands in the vectors' YAML
/// and in the adapter protocol's JSON.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum Packet {
    /// What a host sends.
    Instruction {
        /// Whom it is for; 254 is the broadcast ID.
        id: u8,
        /// The instruction's code.
        instruction: u8,
        /// Everything between the instruction and the CRC.
        params: HexBytes,
    },
    /// What a device answers.
    Status {
        /// Who answers.
        id: u8,
        /// The whole error byte, alert bit included.
        error: u8,
        /// Everything between the error and the CRC.
        params: HexBytes,
    },
    /// What several devices answer together to Fast Sync Read or Fast Sync Write.
    FastStatus {
        /// One block a device, in the order asked for.
        blocks: Vec<Block>,
    },
    /// INNFOS: what a host sends.
    Request {
        /// Whom it is for; 0 is the broadcast address.
        address: u8,
        /// The command's code.
        command: u8,
        /// Everything between the length and the CRC.
        data: HexBytes,
    },
    /// INNFOS: what a device answers.
    Reply {
        /// Who answers.
        address: u8,
        /// The code of the command that it answers.
        command: u8,
        /// Everything between the length and the CRC.
        data: HexBytes,
    },
}

/// One device's part of a fast status packet.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Block {
    /// The whole error byte, alert bit included.
    pub error: u8,
    /// Who answers.
    pub id: u8,
    /// What was read; empty for Fast Sync Write.
    pub data: HexBytes,
}
