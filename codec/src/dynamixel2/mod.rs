//! DYNAMIXEL Protocol 2.0 and its dialect, the JA actuators' protocol.
//!
//! | header | ID | length | instruction | parameters | CRC |
//! |---|---|---|---|---|---|
//! | FF FF FD 00 | 1 byte | 2 bytes | 1 byte | any | 2 bytes |
//!
//! Numbers have their low byte first. The length counts everything after itself, including stuffing
//! (JA40 document, §1.4; DYNAMIXEL Protocol 2.0, Instruction Packet).
//!
//! | to | see |
//! |---|---|
//! | read a whole packet | [`Frame::parse`] |
//! | find packets in the bytes that a port receives | [`stream::Parser`] |
//! | build an instruction | [`instruction`], or a register's [`read`](crate::register::Register::read) and [`write`](crate::register::Register::write) |
//! | read an instruction, as a device does | [`Request::parse`] |
//! | build and read a device's answer | [`status`], [`fast_status`] |
//! | do only byte stuffing | [`stuffing`] |

mod error;
pub mod fast_status;
pub mod frame;
mod header;
pub mod instruction;
pub mod status;
pub mod stream;
pub mod stuffing;

/// The code that the build script generates from the wire's YAML.
#[allow(
    unreachable_pub,            // its contents are exported below
    clippy::unreadable_literal, // numbers keep the form that they have in the YAML
    clippy::match_same_arms,    // an arm a row, whatever the other rows say
    clippy::too_many_lines      // tables are as long as the documents' are
)]
mod generated {
    include!(concat!(env!("OUT_DIR"), "/dynamixel2.rs"));
}

pub use error::FrameError;
pub use fast_status::FastStatus;
pub use frame::Frame;
pub use generated::dynamixel2::*;
pub use instruction::{Request, RequestError};
pub use status::{Kind, Status, StatusError};
