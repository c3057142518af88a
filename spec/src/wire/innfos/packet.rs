//! The wire's packets by their fields.

#[cfg(feature = "exports")]
use schemars::JsonSchema;
use serde::Deserialize;

use crate::model::HexBytes;
use crate::wire::Direction;

/// A packet, before the CRC.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Packet {
    /// A request of a host, or a reply of a device.
    #[serde(rename = "kind")]
    pub direction: Direction,
    /// The address that a request is for, where 0 is the broadcast address, or that sends a reply.
    pub address: u8,
    /// The code of the command.
    pub command: u8,
    /// Everything between the length and the CRC.
    pub data: HexBytes,
}
