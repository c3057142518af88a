//! What must answer requests that write, where nobody is harmed: registers of the RAM area that may hold any value
//! of their range.

use actucheck_spec::model::{Access, Area, Register};
use actucheck_spec::wire::Fast;
use actucheck_spec::wire::dynamixel2::Packet;
use actucheck_spec::wire::dynamixel2::reference::{PREFIX, decode, register_number, repair};

use super::requests::{Due, Held};
use super::writable::{Writable, needs, writable};
use super::{BROADCAST, Talk, code, error};
use crate::adapter::{Permission, Permissions};
use crate::suite::Author;
use crate::suite::device::Target;

/// What a Write comes to.
enum Put {
    /// It is carried out.
    Taken(Write),
    /// It is refused, for a requirement and with an error number.
    Refused(u16, &'static str, u8),
}

/// Bytes for a register.
#[derive(Clone)]
pub(super) struct Write {
    pub(super) address: u16,
    pub(super) data: Vec<u8>,
}

/// A register that is written.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    pub(crate) address: u16,
    /// How many bytes it has.
    pub(crate) size: u16,
    /// The smallest and the largest value that it must take.
    pub(crate) min: i64,
    pub(crate) max: i64,
}

/// The registers of a device that may be written with [`Permission::WriteRam`].
pub(crate) fn places(author: Author<'_>, target: &Target<'_>) -> Vec<Place> {
    let talk = Talk { author, target: target.clone() };
    let place = |Writable { register, min, max }: Writable<'_>| Place {
        address: register.address,
        size: register.kind.size(),
        min,
        max,
    };
    writable(&talk).into_iter().filter(|one| needs_ram_only(&talk, one)).map(place).collect()
}

fn needs_ram_only(talk: &Talk<'_>, one: &Writable<'_>) -> bool {
    needs(talk, one.register) == Permissions::from([Permission::WriteRam])
}

/// The one with this address.
fn own<'a>(talk: &Talk<'a>, address: u16) -> Option<Writable<'a>> {
    let own = writable(talk).into_iter().find(|one| one.register.address == address);
    own.filter(|one| needs_ram_only(talk, one))
}

/// Whether a register is one of them.
pub(super) fn is_written(talk: &Talk<'_>, register: &Register) -> bool {
    own(talk, register.address).is_some()
}

/// Whether a register is for reading only, and holds what is measured: that is measured again, whatever was
/// written.
pub(crate) fn is_measured(register: &Register) -> bool {
    register.access == Access::R
        && register.area == Area::Ram
        && !matches!(register.name.as_str(), "Backup Ready" | "Registered Instruction")
}

/// Whether what begins with these bytes can only write what may be written, whatever its CRC is.
pub(super) fn is_harmless(talk: &Talk<'_>, bytes: &[u8]) -> bool {
    let length = bytes.get(PREFIX - 2..PREFIX).and_then(|length| length.try_into().ok());
    let size = length.map(|length| PREFIX + usize::from(u16::from_le_bytes(length)));
    let Some(frame) = size.and_then(|size| bytes.get(..size)) else { return false };
    let mut frame = frame.to_vec();
    repair(&mut frame);
    decode(&frame).is_ok_and(|packet| may_be_sent(talk, &packet))
}

fn may_be_sent(talk: &Talk<'_>, packet: &Packet) -> bool {
    let Packet::Instruction { id, instruction, params } = packet else { return false };
    let params = params.0.as_slice();
    let present = &talk.target.present;
    // Nobody keeps what other devices hold.
    let is_own = *id == talk.id() || !present.contains(id);
    let is_alone = *present == [talk.id()];
    match *instruction {
        code::WRITE | code::REG_WRITE => {
            is_own && (*id != BROADCAST || is_alone) && put(talk, params).is_some()
        }
        code::ACTION => is_own && *id != BROADCAST && params.is_empty(),
        code::SYNC_WRITE | code::FAST_SYNC_WRITE | code::BULK_WRITE => blocks(*instruction, params)
            .is_some_and(|blocks| {
                blocks.iter().all(|(id, params)| {
                    (*id == talk.id() || !present.contains(id)) && put(talk, params).is_some()
                })
            }),
        _ => false,
    }
}

/// What a Write with these parameters comes to, if the document says it.
fn put(talk: &Talk<'_>, params: &[u8]) -> Option<Put> {
    let (address, data) = params.split_first_chunk()?;
    let address = u16::from_le_bytes(*address);
    let device = talk.target.device?;
    let refused = |name, error| Some(Put::Refused(address, name, error));
    if data.is_empty() {
        return None;
    }
    let is_here = |register: &&Register| register.address == address;
    let Some(register) = device.registers.iter().find(is_here) else {
        let is_nowhere = address == u16::MAX && data.len() == 1 && device.complete;
        return refused("status-packet.error.write-access", error::ACCESS).filter(|_| is_nowhere);
    };
    let size = usize::from(register.kind.size());
    if is_measured(register) && data.len() == size {
        return refused("status-packet.error.write-access|table.read-only", error::ACCESS);
    }
    let Writable { min, max, .. } = own(talk, address)?;
    if data.len() < size {
        return refused("status-packet.error.data-length", error::DATA_LENGTH);
    }
    let is_inside = (min..=max).contains(&register_number(register, data));
    match (data.len() == size, is_inside) {
        (true, true) => Some(Put::Taken(Write { address, data: data.to_vec() })),
        (true, false) => refused("status-packet.error.data-range", error::DATA_RANGE),
        (false, _) => None,
    }
}

/// What an instruction to several devices writes to each: its ID, and the parameters of a Write.
fn blocks(instruction: u8, params: &[u8]) -> Option<Vec<(u8, Vec<u8>)>> {
    let (head, mut rest) = if instruction == code::BULK_WRITE {
        (&[][..], params)
    } else {
        params.split_at_checked(4)?
    };
    let mut blocks = Vec::new();
    while !rest.is_empty() {
        let (id, block) = rest.split_first()?;
        let (range, block) =
            if head.is_empty() { block.split_at_checked(4)? } else { (head, block) };
        let (address, length) = range.split_at_checked(2)?;
        let length = u16::from_le_bytes(length.try_into().ok()?);
        let (data, behind) = block.split_at_checked(length.into())?;
        blocks.push((*id, [address, data].concat()));
        rest = behind;
    }
    (!blocks.is_empty()).then_some(blocks)
}

/// What must answer a packet that writes, if the documents say it, and what registers hold after it.
pub(super) fn due(talk: &Talk<'_>, packet: &Packet, held: &mut Held) -> Option<Due> {
    if !may_be_sent(talk, packet) {
        return None;
    }
    let Packet::Instruction { id, instruction, params } = packet else { return None };
    let params = params.0.as_slice();
    match (*id, *instruction) {
        (id, code::WRITE) if id == talk.id() => Some(written(talk, put(talk, params)?, held)),
        (BROADCAST, code::WRITE) => {
            let Put::Taken(write) = put(talk, params)? else { return None };
            held.take(write, "id.broadcast|packet.id.broadcast");
            Some(Due::new("response.broadcast.silence|response.broadcast", Vec::new()))
        }
        (id, code::REG_WRITE | code::ACTION) if id == talk.id() => {
            let is_known = talk.knows("Reg Write") && talk.knows("Action");
            registered(talk, *instruction, params, held).filter(|_| is_known)
        }
        (BROADCAST, code::SYNC_WRITE | code::FAST_SYNC_WRITE | code::BULK_WRITE) => {
            to_several(talk, *instruction, params, held)
        }
        (BROADCAST | 253.., _) => None,
        _ => Some(Due::new("packet.id.addressee|packet.addressee", Vec::new())),
    }
}

fn written(talk: &Talk<'_>, put: Put, held: &mut Held) -> Due {
    match put {
        Put::Taken(write) => {
            held.take(write, "write.effect");
            Due::new("write.status", vec![talk.refusal(error::NONE)])
        }
        Put::Refused(address, name, error) => {
            held.claims.insert(address, name);
            Due::new(name, vec![talk.refusal(error)])
        }
    }
}

/// Reg Write and Action. Which of two Reg Writes counts is unspecified, and whether one is refused at once.
fn registered(talk: &Talk<'_>, instruction: u8, params: &[u8], held: &mut Held) -> Option<Due> {
    let done = |names| Some(Due::new(names, vec![talk.refusal(error::NONE)]));
    if instruction == code::REG_WRITE {
        let Put::Taken(write) = put(talk, params)? else { return None };
        if held.waits.is_some() {
            return None;
        }
        held.claims.insert(write.address, "reg-write.deferred");
        held.waits = Some(write);
        return done("reg-write.status");
    }
    if let Some(write) = held.waits.take() {
        held.take(write, "action.effect");
        done("action.status")
    } else {
        let refusal = vec![talk.refusal(error::INSTRUCTION)];
        Some(Due::new("action.without-reg-write", refusal))
    }
}

/// Sync Write, Bulk Write and Fast Sync Write, of this device and of others that are not there.
fn to_several(talk: &Talk<'_>, instruction: u8, params: &[u8], held: &mut Held) -> Option<Due> {
    let (name, status, effect) = match instruction {
        code::SYNC_WRITE => ("Sync Write", "sync-write.silence", "sync-write.effect"),
        code::BULK_WRITE => ("Bulk Write", "bulk-write.silence", "bulk-write.effect"),
        _ => ("Fast Sync Write", "fast-sync-write.status", "fast-sync-write.effect"),
    };
    let blocks = blocks(instruction, params)?;
    let mut own = blocks.iter().filter(|(id, _)| *id == talk.id());
    let (mine, others) = (own.next(), own.next());
    let is_fast = instruction == code::FAST_SYNC_WRITE;
    if !talk.knows(name) || others.is_some() || is_fast && mine.is_some() && blocks.len() > 1 {
        return None;
    }
    let mut puts = blocks.iter().map(|(_, params)| put(talk, params));
    if !puts.all(|put| matches!(put, Some(Put::Taken(_)))) {
        return None;
    }
    let Some((_, params)) = mine else {
        return Some(Due::new(if is_fast { effect } else { status }, Vec::new()));
    };
    if let Some(Put::Taken(write)) = put(talk, params) {
        held.take(write, effect);
    }
    let answer = if is_fast { vec![talk.refusal(error::NONE)] } else { Vec::new() };
    let fast = is_fast.then(|| Fast { length: 0, ids: vec![talk.id()] });
    Some(Due { fast, ..Due::new(status, answer) })
}

impl Held {
    /// A register holds this from now on, as a requirement says.
    fn take(&mut self, write: Write, says: &'static str) {
        let Write { address, data } = write;
        self.claims.insert(address, says);
        self.written.insert(address, data);
    }
}
