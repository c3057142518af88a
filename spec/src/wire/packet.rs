//! Packets of all wires as one object, whose `kind` determines the wire.

#[cfg(feature = "exports")]
use std::borrow::Cow;
use std::fmt;

#[cfg(feature = "exports")]
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{self, Deserialize, Deserializer, MapAccess, Visitor};
use serde_json::Value;

use super::{Context, Direction, Packet, Wire};

/// The fields of a packet, not read yet.
pub type Fields = serde_json::Map<String, Value>;

impl Packet {
    /// Its direction.
    #[must_use]
    pub fn direction(&self) -> Direction {
        self.wire().direction(self)
    }

    /// The facts that a reader needs in addition to the bytes.
    #[must_use]
    pub fn context(&self) -> Context {
        self.wire().context(self)
    }
}

impl<'de> Deserialize<'de> for Packet {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(Reader)
    }
}

struct Reader;

impl<'de> Visitor<'de> for Reader {
    type Value = Packet;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a packet: an object with a `kind`")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Packet, A::Error> {
        let mut fields = Fields::new();
        while let Some((name, value)) = map.next_entry::<String, Value>()? {
            if fields.contains_key(&name) {
                return Err(de::Error::custom(format_args!("duplicate field `{name}`")));
            }
            fields.insert(name, value);
        }
        let Some(kind) = fields.get("kind") else { return Err(de::Error::missing_field("kind")) };
        let kind = kind.as_str().unwrap_or_default();
        let Some(wire) = Wire::ALL.into_iter().find(|wire| wire.kinds().contains(&kind)) else {
            let kinds = Wire::ALL.map(|wire| wire.kinds().join(", ")).join(", ");
            let message = format_args!("unknown kind of packet `{kind}`; there are {kinds}");
            return Err(de::Error::custom(message));
        };
        wire.packet(fields).map_err(de::Error::custom)
    }
}

#[cfg(feature = "exports")]
impl JsonSchema for Packet {
    fn schema_name() -> Cow<'static, str> {
        "Packet".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let kinds: Vec<Value> =
            Wire::ALL.iter().flat_map(|wire| wire.exports().packet_schemas(generator)).collect();
        json_schema!({
            "description": "A packet by its fields, before stuffing and CRC. The same object stands \
                in the vectors' YAML and in the adapter protocol's JSON; its `kind` tells the wire.",
            "oneOf": kinds,
        })
    }
}
