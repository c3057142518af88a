//! An instruction packet as a call, for libraries that have one function per instruction instead of
//! packets.

use crate::wire::dynamixel2::Packet;
use crate::wire::{Call, Target};

/// The call that sends this packet; `None` if it is no instruction packet, has an unknown
/// instruction, or its parameters do not fit the instruction.
#[must_use]
pub fn call(packet: &Packet) -> Option<Call> {
    let Packet::Instruction { instruction, params, .. } = packet else { return None };
    let params = params.0.as_slice();
    match *instruction {
        0x01 => plain("ping", params),
        0x02 => read("read", params),
        0x03 => write("write", params),
        0x04 => write("reg_write", params),
        0x05 => plain("action", params),
        0x06 => factory_reset(params),
        0x08 => plain("reboot", params),
        // The meaning of these bytes depends on the device; a call takes them as they are.
        0x10 => Some(with_params("clear", params)),
        0x20 => Some(with_params("control_table_backup", params)),
        0x82 => sync_read("sync_read", params),
        0x83 => sync_write("sync_write", params),
        0x8A => sync_read("fast_sync_read", params),
        0x8B => sync_write("fast_sync_write", params),
        0x92 => Some(to_each("bulk_read", bulk_read(params)?)),
        0x93 => Some(to_each("bulk_write", bulk_write(params)?)),
        _ => None,
    }
}

fn plain(name: &'static str, params: &[u8]) -> Option<Call> {
    params.is_empty().then(|| Call::named(name))
}

fn with_params(name: &'static str, params: &[u8]) -> Call {
    Call { params: Some(params.to_vec().into()), ..Call::named(name) }
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
    Some(Call { address, length, ..to_each(name, devices) })
}

fn to_each(name: &'static str, devices: Vec<Target>) -> Call {
    let devices = Some(devices).filter(|devices| !devices.is_empty());
    Call { devices, ..Call::named(name) }
}
fn bulk_read(params: &[u8]) -> Option<Vec<Target>> {
    let mut devices = Vec::new();
    let mut rest = params;
    while let [id, behind @ ..] = rest {
        let (address, behind) = number(behind)?;
        let (length, next) = number(behind)?;
        let (address, length) = (Some(address), Some(length));
        devices.push(Target { id: *id, address, length, data: None });
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
        let data = Some(data.to_vec().into());
        devices.push(Target { id: *id, address: Some(address), length: None, data });
        rest = next;
    }
    Some(devices)
}

/// The first two bytes as a number, low byte first, and the rest.
fn number(bytes: &[u8]) -> Option<(u16, &[u8])> {
    let (number, rest) = bytes.split_first_chunk()?;
    Some((u16::from_le_bytes(*number), rest))
}
