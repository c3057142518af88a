//! Checks of hosts on DYNAMIXEL Protocol 2.0 and its JA dialect.
//!
//! - calls: each call with a right answer, what comes after it, and calls that nothing answers;
//! - faults: answers to Read that are damaged, late, or of something else;
//! - writes: answers to Write that are damaged, or tell an error;
//! - several: devices that are missing, swapped or damaged among several.

mod calls;
mod faults;
mod several;
mod writes;

use actucheck_spec::model::HexBytes;
use actucheck_spec::wire::dynamixel2::reference::BROADCAST;
use actucheck_spec::wire::dynamixel2::{Packet, WIRE};

use crate::adapter::{Burst, Called, Question, Reported, Step, Trouble};
use crate::suite::Author;
use crate::suite::check::{Check, Demand};
use crate::suite::due::Due;
use crate::suite::plan::Family;

/// What else than an answer may be reported where what comes is none.
const NO_ANSWER: [Trouble; 2] = [Trouble::Corrupt, Trouble::Timeout];

pub(super) fn families(author: Author<'_>) -> Vec<Family<'_>> {
    vec![
        Family::of("dynamixel2.host.basic.", move || calls::basics(&author)),
        Family::of("dynamixel2.host.call.", move || calls::others(&author)),
        Family::of("dynamixel2.host.after.", move || calls::after(&author)),
        Family::of("dynamixel2.host.no-success.", move || calls::unsuccessful(&author)),
        Family::of("dynamixel2.host.read.", move || faults::checks(&author)),
        Family::of("dynamixel2.host.write.", move || writes::checks(&author)),
        Family::of("dynamixel2.host.sync-read.", move || several::sync(&author)),
        Family::of("dynamixel2.host.bulk-read.", move || several::bulk(&author)),
        Family::of("dynamixel2.host.fast-sync-read.", move || several::fast(&author)),
    ]
}

impl Author<'_> {
    /// Looks at what a host puts on the line for its last call.
    fn sent(&self, id: String, requirement: &str, steps: Vec<Step>) -> Check {
        self.check(id, requirement, Question::Converse { wire: WIRE, steps }, Demand::Send)
    }

    /// Looks at what a host returns of its last call.
    fn returned(&self, id: String, requirement: &str, steps: Vec<Step>, due: Due) -> Check {
        self.check(id, requirement, Question::Converse { wire: WIRE, steps }, Demand::Return(due))
    }
}

fn instruction(id: u8, instruction: u8, params: impl Into<Vec<u8>>) -> Packet {
    Packet::Instruction { id, instruction, params: params.into().into() }
}

/// The bytes of a packet.
fn frame(packet: Packet) -> Vec<u8> {
    WIRE.encode(&packet.into()).unwrap_or_default()
}

/// The bytes of a status packet.
fn status(id: u8, error: u8, params: &[u8]) -> Vec<u8> {
    frame(Packet::Status { id, error, params: params.to_vec().into() })
}

/// A Read of a device.
fn read(id: u8, address: u16, length: u16) -> Packet {
    instruction(id, 0x02, [address, length].map(u16::to_le_bytes).concat())
}

/// Bytes at once.
fn burst(bytes: impl Into<Vec<u8>>) -> Burst {
    later(0, bytes)
}

/// Bytes after some milliseconds.
fn later(after_ms: u32, bytes: impl Into<Vec<u8>>) -> Burst {
    Burst { after_ms, bytes: bytes.into().into() }
}

/// A call, and what answers it each time that it is sent.
fn step(packet: Packet, answers: Vec<Vec<Burst>>) -> Step {
    Step { packet: Called::from(packet), answers, late: HexBytes::default(), hurries: false }
}

/// What a device's answer says that holds data.
fn data(id: u8, data: &[u8]) -> Reported {
    Reported { id, data: Some(data.to_vec().into()), ..Reported::default() }
}

/// These devices are returned, and no error.
fn all(devices: impl Into<Vec<Reported>>) -> Due {
    Due { devices: Some(devices.into()), ..Due::default() }
}

/// The call tells of no device, or fails: a host need not await an answer that has no data.
fn untold() -> Due {
    Due { or: NO_ANSWER.to_vec(), ..all([]) }
}

/// The call tells that a device refused it, or does not tell anything.
fn refused(told: Reported) -> Due {
    Due { partly: true, or: vec![Trouble::Status], ..all([told]) }
}

/// The call fails, as it has no answer.
fn failed() -> Due {
    Due { or: NO_ANSWER.to_vec(), ..Due::default() }
}
