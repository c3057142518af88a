//! Packets and control tables of robot actuators, on two wires.
//!
//! | wire | module | what it carries |
//! |---|---|---|
//! | DYNAMIXEL Protocol 2.0 and its dialect, the JA actuators' protocol | [`dynamixel2`] | reads and writes of a control table, on a serial bus |
//! | INNFOS Ethernet protocol | [`innfos`] | commands with a value, in UDP datagrams |
//!
//! | to | see |
//! |---|---|
//! | read or set a register of a known device | [`ja40`], [`ja_variant`], [`xl330_m288`], [`xm430_w210`] |
//! | do so with a device of your own | [`register`], and `codec/examples/own-device` |
//! | read one packet, or find packets in a stream | [`dynamixel2::Frame`], [`dynamixel2::stream::Parser`] |
//! | build an instruction, or answer one | [`dynamixel2::instruction`], [`dynamixel2::status`] |
//! | build and read INNFOS messages | [`innfos::Message`] |
//! | compute the CRC alone | [`crc`] |
//! | pass every error on with `?` | [`Error`] |
//!
//! Instruction codes, layouts, registers and commands are generated from the documents' YAML when
//! the crate is built. Everything works on the caller's buffers: nothing is allocated. The feature
//! `std` only asks the processor at run time which instructions it has.
//!
//! No function panics for any bytes. Lengths from the wire are checked against the available bytes.
//! A buffer that is too small is an error that has the size needed. The content of a buffer is
//! unspecified after an error, and after the written bytes.
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
//! # Ok::<(), actucheck_codec::Error>(())
//! ```

#![cfg_attr(not(test), no_std)]
#![cfg_attr(docsrs, feature(doc_cfg))]

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

/// The code that the build script generates from the devices' YAML: one module per device.
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
