//! The wire's packets by their fields.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::model::HexBytes;
use crate::wire::Direction;

/// A packet, before the CRC.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Packet {
    /// What a host sends, or what a device answers.
    #[serde(rename = "kind")]
    pub direction: Direction,
    /// Whom a request is for, where 0 is the broadcast address; who sends a reply.
    pub address: u8,
    /// The code of the command that is asked or answered.
    pub command: u8,
    /// Everything between the length and the CRC.
    pub data: HexBytes,
}
