//! A packet as a call, for libraries that have functions instead of packets.

use crate::model::HexBytes;
use crate::wire::dynamixel2::reference::BROADCAST;
use crate::wire::dynamixel2::{Block, Packet};
use crate::wire::{Call, Target};

/// The call that sends this packet. It is a general one for every answer, and for an instruction that
/// has no call of its own or other parameters than that call.
#[must_use]
pub fn call(packet: &Packet) -> Call {
    match packet {
        Packet::Instruction { id, instruction, params } => own(*id, *instruction, params)
            .unwrap_or_else(|| Call {
                instruction: Some(*instruction),
                ..with_params(Call::general("instruction"), params)
            }),
        Packet::Status { error, params, .. } => {
            Call { error: Some(*error), ..with_params(Call::general("status"), params) }
        }
        Packet::FastStatus { blocks } => {
            let devices = Some(blocks.iter().map(answer).collect());
            Call { devices, ..Call::general("fast_status") }
        }
    }
}

fn answer(block: &Block) -> Target {
    let (error, data) = (Some(block.error), Some(block.data.clone()));
    Target { id: block.id, error, data, ..Target::default() }
}

/// The names of the calls that are not general.
pub const CALLS: [&str; 15] = [
    "ping",
    "read",
    "write",
    "reg_write",
    "action",
    "factory_reset",
    "reboot",
    "clear",
    "control_table_backup",
    "sync_read",
    "sync_write",
    "fast_sync_read",
    "fast_sync_write",
    "bulk_read",
    "bulk_write",
];

/// The instruction's own call; `None` if it has none, or its parameters do not fit.
fn own(id: u8, instruction: u8, params: &HexBytes) -> Option<Call> {
    let bytes = params.0.as_slice();
    match instruction {
        0x01 => plain("ping", bytes),
        0x02 => read("read", bytes),
        0x03 => write("write", bytes),
        0x04 => write("reg_write", bytes),
        0x05 => plain("action", bytes),
        0x06 => factory_reset(bytes),
        0x08 => plain("reboot", bytes),
        // The meaning of these bytes depends on the device; a call takes them as they are.
        0x10 => Some(with_params(Call::named("clear"), params)),
        0x20 => Some(with_params(Call::named("control_table_backup"), params)),
        // A call for several devices has no ID beside theirs.
        _ if id != BROADCAST => None,
        0x82 => sync_read("sync_read", bytes),
        0x83 => sync_write("sync_write", bytes),
        0x8A => sync_read("fast_sync_read", bytes),
        0x8B => sync_write("fast_sync_write", bytes),
        0x92 => to_each("bulk_read", bulk_read(bytes)?),
        0x93 => to_each("bulk_write", bulk_write(bytes)?),
        _ => None,
    }
}

fn plain(name: &'static str, params: &[u8]) -> Option<Call> {
    params.is_empty().then(|| Call::named(name))
}

fn with_params(call: Call, params: &HexBytes) -> Call {
    Call { params: Some(params.clone()), ..call }
}

fn factory_reset(params: &[u8]) -> Option<Call> {
    let [option] = *params else { return None };
    Some(Call { option: Some(option), ..Call::named("factory_reset") })
}

fn read(name: &'static str, params: &[u8]) -> Option<Call> {
    let (address, params) = number(params)?;
    let (length, []) = number(params)? else { return None };
    Some(Call { address: Some(address), length: Some(length), ..Call::named(name) })
}

fn write(name: &'static str, params: &[u8]) -> Option<Call> {
    let (address, data) = number(params)?;
    Some(Call { address: Some(address), data: Some(data.to_vec().into()), ..Call::named(name) })
}

fn sync_read(name: &'static str, params: &[u8]) -> Option<Call> {
    let (address, params) = number(params)?;
    let (length, ids) = number(params)?;
    if ids.is_empty() {
        return None;
    }
    let (address, length, ids) = (Some(address), Some(length), Some(ids.to_vec()));
    Some(Call { address, length, ids, ..Call::named(name) })
}

fn sync_write(name: &'static str, params: &[u8]) -> Option<Call> {
    let (address, params) = number(params)?;
    let (length, mut rest) = number(params)?;
    let mut devices = Vec::new();
    while let [id, behind @ ..] = rest {
        let (data, next) = behind.split_at_checked(length.into())?;
        let data = Some(data.to_vec().into());
        devices.push(Target { id: *id, data, ..Target::default() });
        rest = next;
    }
    let (address, length) = (Some(address), Some(length));
    Some(Call { address, length, ..to_each(name, devices)? })
}

/// `None` without a device.
fn to_each(name: &'static str, devices: Vec<Target>) -> Option<Call> {
    let devices = Some(devices).filter(|devices| !devices.is_empty())?;
    Some(Call { devices: Some(devices), ..Call::named(name) })
}

fn bulk_read(params: &[u8]) -> Option<Vec<Target>> {
    let mut devices = Vec::new();
    let mut rest = params;
    while let [id, behind @ ..] = rest {
        let (address, behind) = number(behind)?;
        let (length, next) = number(behind)?;
        let (address, length) = (Some(address), Some(length));
        devices.push(Target { id: *id, address, length, ..Target::default() });
        rest = next;
    }
    Some(devices)
}

fn bulk_write(params: &[u8]) -> Option<Vec<Target>> {
    let mut devices = Vec::new();
    let mut rest = params;
    while let [id, behind @ ..] = rest {
        let (address, behind) = number(behind)?;
        let (length, behind) = number(behind)?;
        let (data, next) = behind.split_at_checked(length.into())?;
        let (address, data) = (Some(address), Some(data.to_vec().into()));
        devices.push(Target { id: *id, address, data, ..Target::default() });
        rest = next;
    }
    Some(devices)
}

/// The first two bytes as a number, low byte first, and the rest.
fn number(bytes: &[u8]) -> Option<(u16, &[u8])> {
    let (number, rest) = bytes.split_first_chunk()?;
    Some((u16::from_le_bytes(*number), rest))
}
