//! The fields of the op `value`: which register is asked, and which side of it is given.

use actucheck_spec::model::HexBytes;
use actucheck_spec::wire::Value;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A register of a device, by name and by address.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct RegisterOf {
    /// The device's id.
    pub device: String,
    /// The register's name.
    pub register: String,
    /// The address of its lowest byte.
    pub address: u16,
    /// How many bytes it has.
    pub size: u16,
    /// The name of the bits that are asked; absent if all of them are.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub field: Option<String>,
}

/// The side of a value that is given; the other one is asked.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Given {
    /// Its bytes.
    Bytes(HexBytes),
    /// Its meaning.
    Value(Value),
}
