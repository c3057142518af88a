//! What a host sends.

use std::time::Duration;

use actucheck_spec::model::{Access, Device, HexBytes, Register};
use actucheck_spec::wire::Direction;
use actucheck_spec::wire::dynamixel2::Packet;
use actucheck_spec::wire::dynamixel2::reference::{self, BROADCAST, Event, events, register_bytes};
use actucheck_spec::wire::innfos::{self, Innfos};
use arbitrary::{Result, Unstructured};

use super::{DEVICES, LONGEST, SPEC};

/// Something that is sent, after some time.
#[derive(Debug)]
pub(super) struct Step {
    pub(super) wait: Duration,
    pub(super) bytes: Vec<u8>,
}

impl Step {
    pub(super) fn choose(choices: &mut Unstructured<'_>) -> Result<Self> {
        let wait = Duration::from_millis(u64::from(choices.arbitrary::<u8>()?).pow(2) / 16);
        let bytes = match choices.int_in_range(0..=9)? {
            0..=4 => write(choices)?,
            5 => write_to_several(choices)?,
            6 => read_of_several(choices)?,
            7 => with_option(choices)?,
            8 => plain(choices)?,
            _ => noise(choices)?,
        };
        Ok(Self { wait, bytes })
    }
}

fn instruction(id: u8, instruction: u8, params: Vec<u8>) -> Vec<u8> {
    let params = HexBytes(params);
    reference::encode(&Packet::Instruction { id, instruction, params }).unwrap()
}

/// An ID of a device, one that no device has, or the broadcast ID.
fn id(choices: &mut Unstructured<'_>) -> Result<u8> {
    choices.choose(&[1, 2, 3, 4, 5, 6, BROADCAST]).copied()
}

/// A value near the ends of ranges, or any.
fn value(choices: &mut Unstructured<'_>) -> Result<i64> {
    Ok(match choices.int_in_range(0..=3)? {
        0 => choices.int_in_range(-3..=20)?,
        1 => *choices.choose(&[64, 224, 2000, 4095, 4096, 6000, 16384, -16384, 32767, 32768])?,
        2 => choices.arbitrary::<u16>()?.into(),
        _ => choices.arbitrary::<i32>()?.into(),
    })
}

/// A register that hosts may write, but none after which a device no longer answers to its ID.
fn writable<'s>(choices: &mut Unstructured<'_>, device: &'s Device) -> Result<&'s Register> {
    let silences = |row: &Register| ["ID", "Status Return Level"].contains(&row.name.as_str());
    let is_meant = |row: &&Register| row.access == Access::Rw && !silences(row);
    let rows: Vec<_> = device.registers.iter().filter(is_meant).collect();
    choices.choose(&rows).copied()
}

/// Write or Reg Write of a register.
fn write(choices: &mut Unstructured<'_>) -> Result<Vec<u8>> {
    let device = SPEC.device(choices.choose(&DEVICES)?).unwrap();
    let register = writable(choices, device)?;
    let data = register_bytes(register, value(choices)?);
    let params = [&register.address.to_le_bytes()[..], &data].concat();
    Ok(instruction(id(choices)?, *choices.choose(&[3, 3, 3, 4])?, params))
}

/// Sync Write, Bulk Write or Fast Sync Write of a register.
fn write_to_several(choices: &mut Unstructured<'_>) -> Result<Vec<u8>> {
    let device = SPEC.device(choices.choose(&DEVICES)?).unwrap();
    let register = writable(choices, device)?;
    let code = *choices.choose(&[0x83, 0x93, 0x8B])?;
    // A fast answer ends before a device that does not know the instruction.
    let devices = if code == 0x8B { 3 } else { 5 };
    let head = [register.address.to_le_bytes(), register.kind.size().to_le_bytes()].concat();
    let mut params = if code == 0x93 { Vec::new() } else { head.clone() };
    for id in some(choices, devices)? {
        params.push(id);
        if code == 0x93 {
            params.extend_from_slice(&head);
        }
        params.extend(register_bytes(register, value(choices)?));
    }
    Ok(instruction(BROADCAST, code, params))
}

/// Sync Read, Fast Sync Read or Bulk Read.
fn read_of_several(choices: &mut Unstructured<'_>) -> Result<Vec<u8>> {
    let code = *choices.choose(&[0x82, 0x8A, 0x92])?;
    let mut range = || -> Result<Vec<u8>> {
        let address: u16 = choices.int_in_range(0..=900)?;
        let length: u16 = choices.int_in_range(0..=12)?;
        Ok([address.to_le_bytes(), length.to_le_bytes()].concat())
    };
    let head = range()?;
    let mut params = if code == 0x92 { Vec::new() } else { head.clone() };
    for id in some(choices, 5)? {
        params.push(id);
        if code == 0x92 {
            params.extend_from_slice(&head);
        }
    }
    Ok(instruction(BROADCAST, code, params))
}

/// Some of the first devices, in several orders.
fn some(choices: &mut Unstructured<'_>, devices: u8) -> Result<Vec<u8>> {
    let mut ids: Vec<u8> = (1..=devices).collect();
    let first = choices.choose_index(ids.len())?;
    ids.rotate_left(first);
    ids.truncate(choices.int_in_range(1..=ids.len())?);
    Ok(ids)
}

/// Factory Reset, but for the option that sets IDs back, Clear, or Control Table Backup.
fn with_option(choices: &mut Unstructured<'_>) -> Result<Vec<u8>> {
    let option = choices.int_in_range(1..=3)?;
    let (code, params) = match choices.int_in_range(0..=2)? {
        0 => (0x06, vec![option]),
        1 => (0x10, vec![option, 0x44, 0x58, 0x4C, 0x22]),
        _ => (0x20, [&[option], &b"CTRL"[..]].concat()),
    };
    Ok(instruction(id(choices)?, code, params))
}

/// An instruction with any parameters.
fn plain(choices: &mut Unstructured<'_>) -> Result<Vec<u8>> {
    let code = *choices.choose(&[1, 2, 5, 8, 9, 0x10, 0x82, 0x92, 0x9A])?;
    let params = bytes(choices, 12)?;
    Ok(instruction(id(choices)?, code, params))
}

/// Bytes that are no packet, or a packet whose CRC is wrong.
fn noise(choices: &mut Unstructured<'_>) -> Result<Vec<u8>> {
    if choices.arbitrary()? {
        let mut packet = plain(choices)?;
        packet.last_mut().into_iter().for_each(|byte| *byte ^= 0x10);
        return Ok(packet);
    }
    let mut bytes = bytes(choices, 40)?;
    if events(&bytes, true, LONGEST).iter().any(|event| matches!(event, Event::Packet(..))) {
        bytes.clear();
    }
    Ok(bytes)
}

fn bytes(choices: &mut Unstructured<'_>, most: usize) -> Result<Vec<u8>> {
    let count = choices.int_in_range(0..=most)?;
    choices.bytes(count.min(choices.len())).map(<[u8]>::to_vec)
}

/// Requests of the document's tables, or any bytes.
pub(super) fn datagram(choices: &mut Unstructured<'_>, innfos: &Innfos) -> Result<Vec<u8>> {
    if choices.ratio(1, 8)? {
        return bytes(choices, 40);
    }
    let mut datagram = Vec::new();
    for _ in 0..choices.int_in_range(1..=3)? {
        let row = choices.choose(&innfos.commands)?;
        let size = usize::from(row.size_in(Direction::Request).unwrap_or_default());
        let mut data = vec![0; size];
        choices.fill_buffer(&mut data)?;
        let address = *choices.choose(&[0, 6, 7, 8])?;
        let packet = innfos::Packet {
            direction: Direction::Request,
            address,
            command: row.code,
            data: data.into(),
        };
        datagram.extend(innfos::reference::encode(&packet).unwrap());
    }
    Ok(datagram)
}
