//! What a device held before it was written to: a file, and the way back.
//!
//! The file has all that it takes to restore the device, also after a crash, so that nothing else is needed
//! then: not the spec, and no file of the user's.

mod file;
mod layout;
mod restore;

use actucheck_spec::model::HexBytes;
use actucheck_spec::schema::of_read;
use actucheck_spec::wire::Wire;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::adapter::Permissions;

pub use self::file::JournalError;
pub use self::layout::{Layout, Snapshot};
pub use self::restore::{
    Ask, RestoreError, reached, restore, restore_device, snapshot, stand_still,
};

/// The version of the format. It changes when a field is removed or gets another meaning, and when who does not
/// know a new field would leave a device unrestored.
pub const VERSION: u32 = 2;
/// The oldest version that is read. It has no neighbour.
pub const OLDEST: u32 = 1;

/// What a device held, and where it is.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Journal {
    /// The version of the format.
    pub version: u32,
    /// When it was written, in UTC as in RFC 3339.
    pub date: String,
    /// The protocol that the device speaks.
    pub wire: Wire,
    /// What the device is, for people.
    pub device: String,
    /// Its model number, as it told it.
    #[serde(default)]
    pub model_number: Option<u16>,
    /// Its ID.
    pub id: u8,
    /// The port, as the command line takes it; absent if it was a program.
    #[serde(default)]
    pub port: Option<String>,
    /// The rate of a serial port in bit/s.
    pub baud: u32,
    /// What the run was allowed to do.
    pub allowed: Permissions,
    /// Where the device's registers are, and which of them are restored.
    pub layout: Layout,
    /// What they held.
    pub held: Snapshot,
    /// Another device on the line that was written to.
    #[serde(default)]
    pub neighbour: Option<Neighbour>,
}

/// Another device on the line, and what it held. It is written to only while its torque is off, and nothing else
/// than its RAM area.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Neighbour {
    /// What it is, for people.
    pub device: String,
    /// Its model number, as it told it.
    #[serde(default)]
    pub model_number: Option<u16>,
    /// Its ID.
    pub id: u8,
    /// Where its registers are, and which of them are restored.
    pub layout: Layout,
    /// What they held.
    pub held: Snapshot,
}

/// A register: where it is.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Place {
    /// Its name.
    pub name: String,
    /// Its address.
    pub address: u16,
    /// How many bytes it has, 1 to 4.
    pub size: u16,
}

/// Bytes of the control table.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Run {
    /// Where they begin.
    pub address: u16,
    /// The bytes.
    pub data: HexBytes,
}

/// The name and the text of the JSON Schema of [`Journal`].
#[must_use]
pub fn schema() -> (&'static str, String) {
    ("journal", of_read::<Journal>())
}
