//! A library with an open port.

use serde::Serialize;

use crate::{Call, Hex, Memory, Refusal};

/// A library with an open port; to drop it closes the port.
pub trait Port: Sized {
    /// Opens a port as the library's users do.
    ///
    /// # Errors
    /// If it cannot be opened: the error class `port`.
    fn open(path: &str, baud: u32) -> Result<Self, Refusal>;

    /// Opens a port in memory, for the op `exchange`.
    ///
    /// # Errors
    /// If the library takes no port but one of the system.
    fn on(_memory: Memory, _baud: u32) -> Result<Self, Refusal> {
        Err(Refusal::skipped("the library takes no port in memory"))
    }

    /// Makes a call. Returns what the library's user gets, an entry a device that answered.
    ///
    /// # Errors
    /// If the library reports a failure, or has no such function.
    fn call(&mut self, device: u8, call: &Call) -> Result<Vec<Reported>, Refusal>;
}

/// What the library's user gets of a device. What the library does not tell is `None`.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Reported {
    /// The device's ID.
    pub id: u8,
    /// The bytes that were read.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub data: Option<Hex>,
    /// Of a ping.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub model_number: Option<u16>,
    /// Of a ping.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub firmware_version: Option<u8>,
    /// The error number of the device's answer.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error: Option<u8>,
    /// Whether the answer had the alert.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub alert: Option<bool>,
}
