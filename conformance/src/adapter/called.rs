//! A packet in the words of a call.

use actucheck_spec::wire::{Call, Packet};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// A packet, with the call that sends it for libraries that have functions instead of packets.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Called {
    /// The packet.
    #[serde(flatten)]
    pub packet: Packet,
    /// The same as a call. It is missing in requests of version 1 only, if it is a general one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub call: Option<Call>,
}

impl<'de> Deserialize<'de> for Called {
    /// The call is derived from the packet again, as it has the same content.
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let mut fields = serde_json::Map::deserialize(deserializer)?;
        fields.remove("call");
        let packet: Packet =
            serde_json::from_value(Value::Object(fields)).map_err(serde::de::Error::custom)?;
        Ok(packet.into())
    }
}

impl<P: Into<Packet>> From<P> for Called {
    fn from(packet: P) -> Self {
        let packet = packet.into();
        Self { call: packet.wire().call(&packet), packet }
    }
}
