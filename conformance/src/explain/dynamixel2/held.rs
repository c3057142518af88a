//! What registers hold, as far as a stream tells.

use std::collections::HashMap;
use std::ops::RangeInclusive;
use std::ptr;

use actucheck_codec::dynamixel2::instruction::{DeviceData, DeviceWrite};
use actucheck_codec::dynamixel2::{BROADCAST_ID, Frame, Request};
use actucheck_codec::register::{Bound, Device, Range, Row};

/// The values of registers on which rules about other registers depend, such as Torque Enable and the
/// limits.
#[derive(Default)]
pub(super) struct Held {
    values: HashMap<(u8, u16), i64>,
    /// Those registers, of each table in use.
    tables: Vec<(&'static Device, Vec<&'static Row>)>,
}

impl Held {
    /// What the register at this address of a device holds.
    pub(super) fn value(&self, id: u8, address: u16) -> Option<i64> {
        self.values.get(&(id, address)).copied()
    }

    /// The register that keeps a device's EEPROM area read-only, if it was seen on.
    pub(super) fn lock(&self, id: u8, table: &Device) -> Option<&'static Row> {
        let address = table.eeprom_lock?;
        let is_on = self.value(id, address).is_some_and(|value| value != 0);
        table.register(address).filter(|_| is_on)
    }

    /// Takes what a request changes.
    pub(super) fn request(
        &mut self,
        id: u8,
        request: &Request<'_>,
        table: impl Fn(u8) -> Option<&'static Device>,
    ) {
        match request {
            // What it writes is held from the next Action on, or never.
            Request::RegWrite(write) => {
                if let Some(table) = table(id) {
                    self.forget_in(id, table, write.address, write.data.len());
                }
            }
            Request::Reboot(_) | Request::FactoryReset(_) | Request::ControlTableBackup(_) => {
                self.forget(id);
            }
            request => writes(id, request, |id, address, data| {
                if let Some(table) = table(id) {
                    self.take(id, table, address, data.len(), || data.to_vec());
                }
            }),
        }
    }

    /// Forgets what a device refused to write.
    pub(super) fn refused(&mut self, id: u8, table: &'static Device, request: &[u8]) {
        let Ok(frame) = Frame::parse(request) else { return };
        let params: Vec<u8> = frame.params().collect();
        let Ok(request) = Request::of(frame.instruction(), &params) else { return };
        writes(id, &request, |_, address, data| self.forget_in(id, table, address, data.len()));
    }

    /// Takes `length` bytes that were written or read from `address` on.
    pub(super) fn take(
        &mut self,
        id: u8,
        table: &'static Device,
        address: u16,
        length: usize,
        data: impl Fn() -> Vec<u8>,
    ) {
        let Self { values, tables } = self;
        for row in rows(tables, table).iter().filter(|row| is_within(row, address, length)) {
            let from = usize::from(row.address - address);
            let data = data();
            let bytes = data.get(from..from + usize::from(row.kind.size()));
            let Some(value) = bytes.and_then(|bytes| row.decode(bytes)) else { continue };
            values.extend(ids(id).map(|id| ((id, row.address), value)));
        }
    }

    /// Forgets what some bytes of a device's table held.
    pub(super) fn forget_in(
        &mut self,
        id: u8,
        table: &'static Device,
        address: u16,
        length: usize,
    ) {
        let Self { values, tables } = self;
        for row in rows(tables, table).iter().filter(|row| is_within(row, address, length)) {
            values.retain(|(other, at), _| *at != row.address || !ids(id).contains(other));
        }
    }

    /// Forgets what a device held.
    pub(super) fn forget(&mut self, id: u8) {
        self.values.retain(|(other, _), _| !ids(id).contains(other));
    }
}

/// The devices that an ID means.
fn ids(id: u8) -> RangeInclusive<u8> {
    if id == BROADCAST_ID { 0..=BROADCAST_ID } else { id..=id }
}

/// Calls `each` with ID, address and data of every write in a request.
pub(super) fn writes(id: u8, request: &Request<'_>, mut each: impl FnMut(u8, u16, &[u8])) {
    match request {
        Request::Write(write) => each(id, write.address, write.data),
        Request::RegWrite(write) => each(id, write.address, write.data),
        Request::SyncWrite(write) => {
            write.devices.clone().for_each(|DeviceData { id, data }| each(id, write.address, data));
        }
        Request::FastSyncWrite(write) => {
            write.devices.clone().for_each(|DeviceData { id, data }| each(id, write.address, data));
        }
        Request::BulkWrite(write) => write
            .devices
            .clone()
            .for_each(|DeviceWrite { id, address, data }| each(id, address, data)),
        _ => {}
    }
}

/// The registers of a table to which it refers itself.
fn rows<'a>(
    tables: &'a mut Vec<(&'static Device, Vec<&'static Row>)>,
    table: &'static Device,
) -> &'a [&'static Row] {
    let known = tables.iter().position(|(known, _)| ptr::eq(*known, table));
    let index = known.unwrap_or_else(|| {
        tables.push((table, referred(table)));
        tables.len() - 1
    });
    tables.get(index).map_or(&[], |(_, rows)| rows)
}

fn referred(table: &Device) -> Vec<&'static Row> {
    let bounds = |range: Range| match range {
        Range::Between { min, max } => [Some(min), Some(max)],
        Range::Any | Range::OneOf(_) => [None, None],
    };
    let mut addresses: Vec<_> = table.eeprom_lock.into_iter().collect();
    for row in table.registers {
        let ranges = row.meanings.iter().filter_map(|meaning| meaning.range);
        for bound in ranges.chain([row.range]).flat_map(bounds).flatten() {
            if let Bound::Register { address, .. } = bound {
                addresses.push(address);
            }
        }
        addresses.extend(row.meanings.iter().map(|meaning| meaning.when.address));
    }
    let referred = |row: &&'static Row| addresses.contains(&row.address);
    table.registers.iter().copied().filter(referred).collect()
}

fn is_within(row: &Row, address: u16, length: usize) -> bool {
    let offset = row.address.checked_sub(address).map(usize::from);
    offset.is_some_and(|offset| offset + usize::from(row.kind.size()) <= length)
}
