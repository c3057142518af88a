#[cfg(feature = "exports")]
use schemars::JsonSchema;
use serde::Deserialize;

use super::{Direction, Number, Value};

/// What a packet says: a command, and its value by name or in the document's unit.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
pub struct Message {
    /// A request of a host, or a reply of a device.
    pub direction: Direction,
    /// The address that a request is for, or that sends a reply.
    pub address: u8,
    /// The code of the command.
    pub command: u8,
    /// What is written or was read, or how a write went; absent if there is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<Value>,
}

impl Message {
    /// The same with other names.
    #[must_use]
    pub fn map_names(self, other: impl Fn(String) -> String) -> Self {
        let value = self.value.map(|value| match value {
            Value::Name(name) => Value::Name(other(name)),
            Value::Flags(names) => Value::Flags(names.into_iter().map(other).collect()),
            number @ Value::Number(_) => number,
        });
        Self { value, ..self }
    }

    /// Whether it is the same as `other`, or has a number that is less than `within` away.
    #[must_use]
    pub fn is_near(&self, other: &Self, within: Number) -> bool {
        let value = match (&self.value, &other.value) {
            (Some(value), Some(other)) => value.is_near(other, within),
            (value, other) => value == other,
        };
        let of = |message: &Self| (message.direction, message.address, message.command);
        value && of(self) == of(other)
    }
}
