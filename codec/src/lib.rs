//! Packets and control tables of robot actuators.
//!
//! The wire is DYNAMIXEL Protocol 2.0 and its dialect, the JA actuators' protocol; [`innfos`] is
//! another, with UDP below it. Instruction codes, layouts, registers and commands are generated at
//! build time from the documents' YAML. Everything works on the caller's buffers: no allocation, no
//! `std` but for the feature of that name, which asks the processor what it can do.
//!
//! No function of this crate panics, whatever bytes it is given. Lengths that come from the wire
//! are checked against the bytes that are there; a buffer that is too small is an error that
//! tells the size needed.
//!
//! ```
//! use actucheck_codec::dynamixel2::{Frame, Instruction};
//! use actucheck_codec::ja40;
//!
//! // Write 2,000 to Goal Position of device 1 (JA40 document, §1.6.3).
//! let mut buffer = [0; 32];
//! let packet = ja40::GOAL_POSITION.write(1, 2000)?.encode(&mut buffer)?;
//! assert_eq!(packet, b"\xFF\xFF\xFD\x00\x01\x09\x00\x03\x34\x02\xD0\x07\x00\x00\x1E\xC9");
//!
//! // And the other way.
//! let frame = Frame::parse(packet)?;
//! assert_eq!((frame.id(), frame.instruction()), (1, Instruction::Write));
//! let reply = b"\xFF\xFF\xFD\x00\x01\x08\x00\x55\x00\x94\x6C\x00\x00\xF5\xAF";
//! let position = Frame::parse(reply)?.status()?.value(ja40::PRESENT_POSITION)?;
//! assert_eq!(position, 27_796);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![cfg_attr(not(test), no_std)]

#[cfg(feature = "std")]
extern crate std;

pub mod crc;
pub mod dynamixel2;
mod error;
pub mod innfos;
pub mod layout;
mod number;
pub mod register;
mod simd;

/// What the build script makes of the devices' YAML: a module a device.
#[allow(
    unused_imports,             // a small device has no use for every type
    clippy::unreadable_literal, // numbers keep the form that they have in the YAML
    clippy::match_same_arms,    // an arm a row, whatever the other rows say
    clippy::too_many_lines,     // tables are as long as the documents' are
    clippy::identity_op,        // bit 0 is shifted like any other
    clippy::match_wildcard_for_single_variants // sometimes one value has no row
)]
mod generated {
    include!(concat!(env!("OUT_DIR"), "/devices.rs"));
}

pub use error::{BufferTooSmall, EncodeError, Error};
pub use generated::*;
