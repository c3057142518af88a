//! Finds packets in a stream of bytes that arrives in pieces.
//!
//! A [`Parser`] takes the received bytes and yields [`Event`]s: packets, and runs of bytes that
//! belong to no packet, with the reason. It has a fixed buffer, never allocates and never panics,
//! and its time grows linearly with the number of bytes, whatever they are.
//!
//! ```
//! use actucheck_codec::dynamixel2::stream::{Event, Parser};
//!
//! // Noise, a Ping whose last byte is broken, and a good one, in two pieces.
//! let pieces: [&[u8]; 2] = [
//!     b"\x00\x42\xFF\xFF\xFD\x00\x01\x03\x00\x01\x19\x00\xFF\xFF\xFD\x00",
//!     b"\x01\x03\x00\x01\x19\x4E",
//! ];
//! let mut parser = Parser::new();
//! let mut seen = Vec::new();
//! for piece in pieces {
//!     parser.feed(piece, |event| {
//!         seen.push(match event {
//!             Event::Frame(frame) => format!("{:?} to {}", frame.instruction(), frame.id()),
//!             Event::FastStatus(status) => format!("{} bytes", status.bytes().len()),
//!             Event::Skipped { bytes, reason } => format!("{bytes} skipped: {reason}"),
//!         });
//!     });
//! }
//! let expected = ["2 skipped: no header", "10 skipped: a packet with a wrong CRC", "Ping to 1"];
//! assert_eq!(seen, expected);
//! ```
//!
//! # What is a packet
//!
//! Reading begins at the first byte. At a header (FF FF FD 00), the bytes from it on are checked
//! against these rules, in the order of the bytes that can break them:
//!
//! 1. the ID is valid ([`Reason::Id`]);
//! 2. the length is at least 3 ([`Reason::Length`]) and the packet no longer than the parser's
//!    limit ([`Reason::Oversize`]);
//! 3. a status packet's length is at least 4, from the broadcast ID 5 ([`Reason::Length`]);
//! 4. every FF FF FD in the body is followed by FD, which is in the body too
//!    ([`Reason::Stuffing`]), unless it is a status packet from the broadcast ID, see below;
//! 5. the CRC matches ([`Reason::Crc`]).
//!
//! If all hold, the bytes are a packet and reading continues after it. As soon as a byte breaks a
//! rule, *the header was false, and reading continues at the second byte of the header*. The
//! documents leave this unspecified; to continue after the supposed packet would lose the valid
//! packets inside it whenever a length is damaged. If there is no header at a byte, reading
//! continues at the next byte.
//!
//! Because of rule 4 the parser does not wait for a wrong length: a header is FF FF FD without FD
//! after it, so the header of the next packet shows that a false header is false.
//!
//! # What is skipped
//!
//! Every byte is in exactly one event. A run of skipped bytes begins at a false header, with the
//! reason of that header, or at a byte without a header, with [`Reason::Garbage`]. It ends before
//! the next header, false or not. It is reported when that header is complete or the bus is quiet,
//! whichever comes first. So the events and their order depend only on the bytes and the quiet
//! times, not on the pieces in which the bytes arrive.
//!
//! # Quiet times
//!
//! [`Parser::idle`] tells the parser that the bus was quiet for longer than any pause inside a
//! packet. No packet continues after a quiet time: if more bytes would be needed, the header was
//! false ([`Reason::Truncated`]), and reading continues at its second byte as above. So a packet
//! after a quiet time is always received, and so is a packet inside an incomplete one.
//!
//! # Fast status packets
//!
//! Only the answers to Fast Sync Read and Fast Sync Write are status packets from the broadcast ID,
//! as no device has that ID. They are not stuffed, and have one CRC per device at places that only
//! the request determines. The parser checks the last CRC, which covers the whole packet, and
//! passes on the bytes as [`Event::FastStatus`]. Nothing inside such a packet can show that it is
//! false before it is complete, so a false header of this kind delays the following packets until
//! as many bytes have arrived as its length states, or until [`Parser::idle`].
//!
//! # The limit
//!
//! By chance one false header of this kind in 65,536 has a matching CRC, and the packets inside it
//! are lost. So a [`Parser`] has a limit, by default [`DEFAULT_MAX_PACKET`] bytes.

mod candidate;
mod checkpoints;
mod event;
mod input;
mod parser;
mod short;
#[cfg(test)]
mod tests;

#[cfg(any(test, feature = "meter"))]
pub use crate::simd::meter;
pub use event::{Event, RawFastStatus, Reason};
pub use parser::{DEFAULT_MAX_PACKET, Parser};

/// Bytes of a block, the unit of the buffer's size.
const BLOCK: usize = 64;
