//! The common parts of the adapters in Rust. An adapter implements [`Library`] for the library that
//! it wraps, and passes it to [`serve`].

#![forbid(unsafe_code)]

mod hex;
mod host;
mod identity;
mod memory;
mod packet;
mod port;
mod serve;
mod slave;

use std::fmt::Display;

pub use hex::Hex;
pub use identity::{Identity, locked_version};
pub use memory::Memory;
pub use packet::{Block, Call, Device, Fast, Packet};
pub use port::{Port, Reported};
pub use serve::serve;
pub use slave::Slave;

/// A library under test, on the wire `dynamixel2`.
///
/// Ops that an adapter does not implement are skipped; [`Identity::ops`] names those that it
/// implements. All but those of [`Port`] and [`Slave`] are independent of each other. A panic is reported as the
/// error class `internal`.
pub trait Library {
    /// The library with an open port, for the ops `open`, `call`, `exchange` and `close`.
    type Port: Port;

    /// The adapter's statement about the library.
    fn identity() -> Identity;

    /// The CRC of some bytes.
    ///
    /// # Errors
    /// If the library does not offer it.
    fn crc(_bytes: &[u8]) -> Result<u16, Refusal> {
        Err(Refusal::no_function())
    }

    /// The frame of a packet.
    ///
    /// # Errors
    /// If the library rejects the packet, or has no function that sends it.
    fn encode(_packet: &Packet) -> Result<Vec<u8>, Refusal> {
        Err(Refusal::no_function())
    }

    /// The packet in a frame. `fast` is the request that a fast status packet answers.
    ///
    /// # Errors
    /// If the library rejects the frame, or does not read such packets.
    fn decode(_frame: &[u8], _fast: Option<&Fast>) -> Result<Packet, Refusal> {
        Err(Refusal::no_function())
    }

    /// The valid packets of a stream that arrives in these chunks.
    ///
    /// # Errors
    /// If the library does not read streams, or not this one.
    fn stream(_chunks: &[Hex]) -> Result<Vec<Packet>, Refusal> {
        Err(Refusal::no_function())
    }

    /// A device of the library, for the op `device`. It is made once, when the first bytes come for it, and lives as
    /// long as the adapter.
    ///
    /// # Errors
    /// If the library has none.
    fn slave() -> Result<Box<dyn Slave>, Refusal> {
        Err(Refusal::no_function())
    }
}

/// Why a request has no result.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// The library rejects the bytes or the packet.
    Rejected {
        /// One of the adapter protocol's error classes.
        class: &'static str,
        /// The library's message.
        detail: String,
    },
    /// The library does not offer it, for this reason.
    Skipped(String),
}

impl Refusal {
    /// A rejection of the bytes or the packet, with the library's message.
    pub fn rejected(class: &'static str, detail: impl Display) -> Self {
        Self::Rejected { class, detail: detail.to_string() }
    }

    /// The library does not offer it, for this reason.
    pub fn skipped(reason: impl Display) -> Self {
        Self::Skipped(reason.to_string())
    }

    fn no_function() -> Self {
        Self::skipped("the library has no function for it")
    }
}
