//! The INNFOS Ethernet protocol: frames in UDP datagrams to an Ethernet control board.
//!
//! | header | address | command | length | data | CRC | end |
//! |---|---|---|---|---|---|---|
//! | EE | 1 byte | 1 byte | 2 bytes, high byte first | `length` bytes | 2 bytes, or none | ED |
//!
//! A [`Frame`] is the checked view of such bytes; a [`Message`] is what they mean: a [`Command`]
//! with a [`Value`] of the type that the document's tables give it. A frame does not state its
//! direction, so the caller gives the [`Direction`] (INNFOS document, Communication protocol format).
//!
//! ```
//! use actucheck_codec::innfos::{Command, Frame, Iq24, Direction, Message, Value};
//!
//! // The actuator 6 turns to one revolution.
//! let position = Iq24::from_f64(1.0).map(Value::Iq24);
//! let mut buffer = [0; 16];
//! let frame = Message::request(6, Command::WritePosition, position).encode(&mut buffer)?;
//! assert_eq!(frame, b"\xEE\x06\x0A\x00\x04\x01\x00\x00\x00\x01\xD8\xED");
//!
//! // And the other way.
//! let message = Message::parse(&Frame::parse(Direction::Request, frame)?)?;
//! assert_eq!((message.command, message.value), (Command::WritePosition, position));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod command;
mod datagram;
mod error;
mod fixed;
mod frame;
mod message;
mod value;

/// The code that the build script generates from the wire's YAML.
#[allow(
    unreachable_pub,            // its contents are exported below
    unused_imports,             // a small wire has no use for every type
    clippy::unreadable_literal, // numbers keep the form that they have in the YAML
    clippy::match_same_arms,    // an arm a row, whatever the other rows say
    clippy::too_many_lines      // tables are as long as the documents' are
)]
mod generated {
    include!(concat!(env!("OUT_DIR"), "/innfos.rs"));
}

pub use command::{Actuator, CommandRow, Format, FullScale, Operation};
pub use datagram::{Frames, frames};
pub use error::{FrameError, MessageError};
pub use fixed::{Iq8, Iq24};
pub use frame::{Direction, Frame, encode, encoded_len};
pub use generated::innfos::*;
pub use message::Message;
pub use value::{Data, Flag, Mac, Value};
