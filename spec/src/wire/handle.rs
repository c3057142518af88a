#[cfg(feature = "exports")]
use std::borrow::Cow;
use std::fmt;
use std::hash::{Hash, Hasher};
use std::ops::Deref;
use std::str::FromStr;

#[cfg(feature = "exports")]
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{self, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::Rules;

/// A wire: a packet format. Its [`Rules`] have what is specific to it. It is written as its id.
#[derive(Clone, Copy)]
pub struct Wire(&'static dyn Rules);

impl Wire {
    /// The handle of a wire with these rules.
    pub(super) const fn new(rules: &'static dyn Rules) -> Self {
        Self(rules)
    }

    /// The ids of all wires, for a message.
    fn ids() -> String {
        Self::ALL.map(|wire| wire.id()).join(", ")
    }
}

impl Deref for Wire {
    type Target = dyn Rules;
    fn deref(&self) -> &Self::Target {
        self.0
    }
}

impl Default for Wire {
    fn default() -> Self {
        let [first, ..] = Self::ALL;
        first
    }
}

impl PartialEq for Wire {
    fn eq(&self, other: &Self) -> bool {
        self.id() == other.id()
    }
}

impl Eq for Wire {}

impl Hash for Wire {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.id().hash(state);
    }
}

impl fmt::Debug for Wire {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.id())
    }
}

impl fmt::Display for Wire {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.id())
    }
}

impl FromStr for Wire {
    type Err = String;

    fn from_str(id: &str) -> Result<Self, String> {
        let wire = Self::ALL.into_iter().find(|wire| wire.id() == id);
        wire.ok_or_else(|| format!("unknown wire `{id}`; there are {}", Self::ids()))
    }
}

impl Serialize for Wire {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.id())
    }
}

impl<'de> Deserialize<'de> for Wire {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_str(Id)
    }
}

/// Reads an id. An error of a visitor has the place of the text.
struct Id;

impl Visitor<'_> for Id {
    type Value = Wire;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a wire: {}", Wire::ids())
    }

    fn visit_str<E: de::Error>(self, id: &str) -> Result<Wire, E> {
        id.parse().map_err(E::custom)
    }
}

#[cfg(feature = "exports")]
impl JsonSchema for Wire {
    fn schema_name() -> Cow<'static, str> {
        "Wire".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let ids = Self::ALL.map(|wire| {
            json_schema!({ "description": wire.title(), "type": "string", "const": wire.id() })
        });
        json_schema!({ "description": "A wire by its id.", "oneOf": ids })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wire_is_written_and_read_as_its_id() {
        for wire in Wire::ALL {
            let text = serde_json::to_string(&wire).unwrap();
            assert_eq!(text, format!("{:?}", wire.id()));
            assert_eq!(serde_json::from_str::<Wire>(&text).unwrap(), wire);
        }
        let error = serde_json::from_str::<Wire>("\"wireless\"").unwrap_err().to_string();
        assert!(error.starts_with("unknown wire `wireless`; there are dynamixel2, "), "{error}");
    }

    #[test]
    fn ids_are_given_once() {
        for (number, wire) in Wire::ALL.into_iter().enumerate() {
            assert_eq!(Wire::ALL.into_iter().position(|other| other == wire), Some(number));
        }
    }
}
