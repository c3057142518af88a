//! Packets out of a stream of bytes that arrives in pieces.
//!
//! A [`Parser`] is fed with whatever was received and gives [`Event`]s: packets, and runs of
//! bytes that belong to none, with the reason. It has a fixed buffer, never allocates, never
//! panics, and takes a time that grows linearly with the bytes, whatever they are.
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
//! Reading begins at the first byte. Where a header (FF FF FD 00) stands, the bytes from it on are
//! held against these rules, in the order of the bytes that can break them:
//!
//! 1. the ID is one ([`Reason::Id`]);
//! 2. the length is at least 3 ([`Reason::Length`]) and the packet no longer than the parser's
//!    limit ([`Reason::Oversize`]);
//! 3. a status packet's length is at least 4, from the broadcast ID 5 ([`Reason::Length`]);
//! 4. behind every FF FF FD in the body stands FD, and that in the body ([`Reason::Stuffing`]),
//!    unless it is a status packet from the broadcast ID, see below;
//! 5. the CRC matches ([`Reason::Crc`]).
//!
//! If all hold, the bytes are a packet and reading goes on behind it. If one is broken, as soon as
//! a byte breaks it, *the header was false and reading goes on at the byte behind the header's
//! first one*. The documents leave this open; to go on behind the supposed packet would lose the
//! good packets inside it whenever a length is damaged. Where no header stands, reading goes on at
//! the next byte.
//!
//! Rule 4 is why the parser does not wait for a length that lies: a header is FF FF FD without FD
//! behind it, so the next packet proves a false header false.
//!
//! # What is skipped
//!
//! Every byte is in exactly one event. A run of skipped bytes begins at a false header, and has
//! its reason, or where no header stands, as [`Reason::Garbage`]; it ends before the next header,
//! false or not. It is reported when that header is complete or the bus is quiet, whichever is
//! first. So the events, and their order, depend on the bytes and the quiet times alone and not on
//! the pieces in which the bytes came.
//!
//! # Quiet times
//!
//! [`Parser::idle`] tells the parser that the bus was quiet for longer than a packet pauses. No
//! packet reaches across: where more bytes would be needed to tell, the header was false
//! ([`Reason::Truncated`]), and reading goes on behind its first byte as above. So a packet after
//! a quiet time is always received, and so is one inside what was cut off.
//!
//! # Fast status packets
//!
//! Only the answers to Fast Sync Read and Fast Sync Write are status packets from the broadcast
//! ID, as no device has that ID. They are not stuffed, and hold a CRC a device at places that only
//! the request tells. The parser checks the last CRC, which is over the whole packet, and hands
//! the bytes on as [`Event::FastStatus`]. Nothing inside such a packet proves it false before it is
//! complete, so a false header of this kind delays what is behind it until as many bytes have come
//! as it claims, or [`Parser::idle`].
//!
//! # The limit
//!
//! By chance one false header of this kind in 65,536 has a CRC that matches, and swallows what it
//! claims; so a [`Parser`] has a limit, [`DEFAULT_MAX_PACKET`] bytes if nothing else is said.

mod candidate;
mod checkpoints;
mod event;
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
