//! What the adapters in Rust share. An adapter implements [`Library`] for what it wraps, as far as
//! that goes, and hands it to [`serve`].

#![forbid(unsafe_code)]

mod hex;
mod identity;
mod packet;
mod serve;

use std::fmt::Display;

pub use hex::Hex;
pub use identity::{Identity, locked_version};
pub use packet::{Block, Call, Device, Fast, Packet};
pub use serve::serve;

/// A library under test, as far as it speaks the `dynamixel2` wire.
///
/// What an adapter does not implement is skipped; [`Identity::ops`] names what it does. Each call
/// begins afresh, and a panic in it is told as a finding.
pub trait Library {
    /// What the adapter says of the library.
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
    /// If the library rejects the packet, or has nothing that sends it.
    fn encode(_packet: &Packet) -> Result<Vec<u8>, Refusal> {
        Err(Refusal::no_function())
    }

    /// The packet that a frame is. `fast` tells what a fast status packet answers.
    ///
    /// # Errors
    /// If the library rejects the frame, or does not read such packets.
    fn decode(_frame: &[u8], _fast: Option<&Fast>) -> Result<Packet, Refusal> {
        Err(Refusal::no_function())
    }

    /// The good packets of a stream that arrives in these chunks.
    ///
    /// # Errors
    /// If the library does not read streams, or not this one.
    fn stream(_chunks: &[Hex]) -> Result<Vec<Packet>, Refusal> {
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
        /// What the library says.
        detail: String,
    },
    /// The library does not offer it, for this reason.
    Skipped(String),
}

impl Refusal {
    /// The library rejects the bytes or the packet, and says this.
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
