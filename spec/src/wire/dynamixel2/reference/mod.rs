//! The slow, obviously right model: what the documents say, a byte at a time, for expected results.
//!
//! It shares no code with the codec and none with the generator: whoever reads it beside the
//! documents must be able to see that it is right. Speed is no aim.

mod call;
mod packet;
mod stream;

pub use call::call;
pub use packet::{
    crc, decode, decode_fast, encode, frame, is_unspecified, part, repair, stuff, unstuff,
};
pub use stream::{Event, events, is_certain, packets, packets_behind_lengths};

/// What every packet begins with.
pub const HEADER: [u8; 4] = [0xFF, 0xFF, 0xFD, 0x00];
/// The bytes that byte stuffing looks for.
pub const PATTERN: [u8; 3] = [0xFF, 0xFF, 0xFD];
/// The instruction of a status packet.
pub const STATUS: u8 = 0x55;
/// The ID that every device obeys.
pub const BROADCAST: u8 = 0xFE;
/// Bytes of header, ID and length.
pub const PREFIX: usize = 7;
