#[cfg(feature = "exports")]
use schemars::JsonSchema;
use serde::Serialize;

use crate::model::HexBytes;

/// What is sent as a call, for libraries that have functions instead of packets. It has the fields of
/// the documents, or for what fits none of their calls the fields of the packet.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "exports", derive(JsonSchema))]
pub struct Call {
    /// Its name, such as `sync_read`; of a general call `instruction`, `status`, `fast_status`,
    /// `request` or `reply`.
    pub name: &'static str,
    /// Whether it is a general call, which takes any content.
    #[serde(skip)]
    pub is_general: bool,
    /// The instruction's code, in a general call.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub instruction: Option<u8>,
    /// The command's code, in a general call.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub command: Option<u8>,
    /// The whole error byte of an answer.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error: Option<u8>,
    /// Address of the first byte.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub address: Option<u16>,
    /// How many bytes, of each device if there are several.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub length: Option<u16>,
    /// The bytes to write; in a general call all that the packet carries.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub data: Option<HexBytes>,
    /// Which of its variants.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub option: Option<u8>,
    /// All of its parameters, where their meaning is a device's own, and in a general call.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub params: Option<HexBytes>,
    /// The devices, where nothing but their IDs differs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ids: Option<Vec<u8>>,
    /// The devices, each with what is meant for it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub devices: Option<Vec<Target>>,
}

/// One device in a call for several devices, or in an answer of several devices. The data of a write
/// has its own length; a read has no data.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "exports", derive(JsonSchema))]
pub struct Target {
    /// Its ID.
    pub id: u8,
    /// The whole error byte of its answer.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error: Option<u8>,
    /// Address of the first byte.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub address: Option<u16>,
    /// How many bytes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub length: Option<u16>,
    /// The bytes to write, or those that were read.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub data: Option<HexBytes>,
}

impl Call {
    /// A call that has nothing but its name.
    #[must_use]
    pub fn named(name: &'static str) -> Self {
        Self { name, ..Self::default() }
    }

    /// A general call, without its fields.
    #[must_use]
    pub fn general(name: &'static str) -> Self {
        Self { is_general: true, ..Self::named(name) }
    }
}
