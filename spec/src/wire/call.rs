use schemars::JsonSchema;
use serde::Serialize;

use crate::model::HexBytes;

/// A request as a call, for libraries that have one function per request instead of packets. It has
/// the fields of the request in the documents.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Call {
    /// The name of the request, such as `sync_read`.
    pub name: &'static str,
    /// Address of the first byte.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub address: Option<u16>,
    /// How many bytes, of each device if there are several.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub length: Option<u16>,
    /// The bytes to write.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub data: Option<HexBytes>,
    /// Which of its variants.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub option: Option<u8>,
    /// All of its parameters, where their meaning is a device's own.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub params: Option<HexBytes>,
    /// The devices, where nothing but their IDs differs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ids: Option<Vec<u8>>,
    /// The devices, each with what is meant for it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub devices: Option<Vec<Target>>,
}

/// One device in a call for several devices. The data of a write has its own length; a read has no
/// data.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Target {
    /// Its ID.
    pub id: u8,
    /// Address of the first byte.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub address: Option<u16>,
    /// How many bytes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub length: Option<u16>,
    /// The bytes to write.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub data: Option<HexBytes>,
}

impl Call {
    /// A call that has nothing but its name.
    #[must_use]
    pub fn named(name: &'static str) -> Self {
        Self { name, ..Self::default() }
    }
}
