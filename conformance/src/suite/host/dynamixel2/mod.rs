//! Checks of hosts on DYNAMIXEL Protocol 2.0 and its JA dialect.
//!
//! - calls: each call with a right answer, what comes after it, and calls that nothing answers;
//! - said: single sentences of the documents;
//! - vectors: the packets that the documents print;
//! - faults: answers of one device that are damaged, late, or of something else;
//! - several: devices that are missing, swapped or damaged among several;
//! - damaged: answers of several devices, damaged at each byte;
//! - found: what any call may return of any bytes, for conversations that no check foresees.

mod calls;
mod damaged;
mod faults;
pub(crate) mod found;
mod right;
mod said;
mod several;
mod vectors;

use actucheck_spec::wire::Call;
use actucheck_spec::wire::dynamixel2::reference::BROADCAST;
use actucheck_spec::wire::dynamixel2::{Block, Packet, WIRE};

use self::right::Right;
use super::{NO_ANSWER, all, burst, data, failed, later, step, untold};
use crate::adapter::{Reported, Trouble};
use crate::suite::Author;
use crate::suite::due::Due;
use crate::suite::plan::Family;

/// The one name that the basic checks of a call have.
pub(super) fn rests_on(call: &Call) -> Vec<String> {
    vec![call.name.replace('_', "-")]
}

pub(super) fn families(author: Author<'_>) -> Vec<Family<'_>> {
    let mut families = vec![
        Family::of("dynamixel2.host.basic.", move || calls::basics(&author)),
        Family::of("dynamixel2.host.said.", move || said::checks(&author)),
        Family::of("dynamixel2.host.vector.", move || vectors::checks(&author)),
        Family::of("dynamixel2.host.call.", move || calls::others(&author)),
        Family::of("dynamixel2.host.after.", move || calls::after(&author)),
    ];
    for right in calls::every() {
        let id = format!("dynamixel2.host.{}.", right.name());
        families.push(Family::of(id, move || {
            let mut checks = faults::checks(&author, &right);
            checks.extend(several::checks(&author, &right));
            checks.extend(damaged::checks(&author, &right));
            checks
        }));
    }
    families
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

/// A block of a fast status packet.
fn block(id: u8, data: &[u8]) -> Block {
    Block { error: 0, id, data: data.to_vec().into() }
}

/// A Read of a device.
fn read(id: u8, address: u16, length: u16) -> Packet {
    instruction(id, 0x02, [address, length].map(u16::to_le_bytes).concat())
}

/// The call tells that a device refused it, or does not tell anything.
fn refused(told: Reported) -> Due {
    Due { partly: true, or: vec![Trouble::Status], ..all([told]) }
}
