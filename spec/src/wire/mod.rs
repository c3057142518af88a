//! The wires. The code of each wire is in its folder, and this file lists them.
//!
//! Code that works with any wire takes a [`Wire`]; [`Rules`] lists what a wire provides. To add a
//! wire, add a folder beside the others and a line to each list here.

mod call;
mod context;
pub mod dynamixel2;
#[cfg(feature = "exports")]
mod exports;
mod handle;
pub mod innfos;
mod message;
mod packet;
mod rules;
mod value;

#[cfg(feature = "exports")]
use schemars::JsonSchema;

pub use call::{Call, Target};
pub use context::{Context, Direction, Fast};
#[cfg(feature = "exports")]
pub use exports::Exports;
pub use handle::Wire;
pub use message::Message;
pub use packet::Fields;
pub use rules::{Ask, Cited, Rules};
pub use value::{Form, NotFinite, Number, Value};

use crate::load::{File, Reader};

impl Wire {
    /// Every wire. The first one is the default.
    pub const ALL: [Self; 2] = [dynamixel2::WIRE, innfos::WIRE];
}

/// The content of the files of `wires/`.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
pub struct Wires {
    /// DYNAMIXEL Protocol 2.0 and its JA dialect: instructions, error numbers.
    pub dynamixel2: File<dynamixel2::Dynamixel2>,
    /// The INNFOS Ethernet protocol: commands, formats, modes, alarms and models.
    pub innfos: File<innfos::Innfos>,
}

impl Wires {
    pub(crate) fn read(reader: &mut Reader<'_>) -> Option<Self> {
        let (dynamixel2, innfos) = (reader.wire(dynamixel2::WIRE), reader.wire(innfos::WIRE));
        Some(Self { dynamixel2: dynamixel2?, innfos: innfos? })
    }
}

/// A packet as its fields, before stuffing and CRC. The vectors' YAML and the adapter protocol's
/// JSON have the same object; its `kind` determines the wire.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "exports", derive(serde::Serialize), serde(untagged))]
pub enum Packet {
    /// Of DYNAMIXEL Protocol 2.0.
    Dynamixel2(dynamixel2::Packet),
    /// Of the INNFOS Ethernet protocol.
    Innfos(innfos::Packet),
}

impl Packet {
    /// The packet's wire.
    #[must_use]
    pub const fn wire(&self) -> Wire {
        match self {
            Self::Dynamixel2(_) => dynamixel2::WIRE,
            Self::Innfos(_) => innfos::WIRE,
        }
    }
}
