//! The reference model: slow and obviously right. It follows the documents byte by byte and yields
//! expected results.
//!
//! It shares no code with the codec or the generator. A reader with the documents at hand must be
//! able to see that it is right; speed is not a goal.

mod call;
mod packet;
mod stream;
mod value;

pub use call::{CALLS, call};
pub use packet::{
    crc, crc_behind, decode, decode_fast, encode, frame, is_unspecified, part, repair, stuff,
    unstuff,
};
pub use stream::{
    Event, events, holds_unspecified, is_certain, lacks_bytes, missing, packets,
    packets_behind_lengths,
};
pub use value::{half_a_count, register_bytes, register_number, register_value};

/// The first bytes of every packet.
pub const HEADER: [u8; 4] = [0xFF, 0xFF, 0xFD, 0x00];
/// The pattern of byte stuffing.
pub const PATTERN: [u8; 3] = [0xFF, 0xFF, 0xFD];
/// The instruction of a status packet.
pub const STATUS: u8 = 0x55;
/// The ID that every device obeys.
pub const BROADCAST: u8 = 0xFE;
/// Bytes of header, ID and length.
pub const PREFIX: usize = 7;
