//! What registers hold, as far as a stream tells.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::RangeInclusive;
use std::ptr;

use actucheck_codec::dynamixel2::instruction::{DeviceData, DeviceWrite};
use actucheck_codec::dynamixel2::{BROADCAST_ID, Frame, Request};
use actucheck_codec::register::{Bound, Device, Range, Row};

use crate::device::Tables;

/// The values of registers on which rules about other registers depend, such as Torque Enable and the
/// limits.
#[derive(Default)]
pub(super) struct Held {
    values: BTreeMap<(u8, u16), i64>,
    /// Those registers, of each table in use.
    tables: Vec<(&'static Device, Vec<&'static Row>)>,
}

impl Held {
    /// What the register at this address of a device holds; of all devices, if each holds the same.
    pub(super) fn value(&self, id: u8, address: u16) -> Option<i64> {
        let mut values = ids(id).map(|id| self.values.get(&(id, address)).copied());
        let first = values.next()??;
        values.all(|value| value == Some(first)).then_some(first)
    }

    /// The register that keeps a device's EEPROM area read-only, if it was seen on.
    pub(super) fn lock(&self, id: u8, table: &Device) -> Option<&'static Row> {
        let address = table.eeprom_lock?;
        self.value(id, address).filter(|value| *value != 0)?;
        table.register(address)
    }

    /// Takes what a request changes.
    pub(super) fn request(&mut self, id: u8, request: &Request<'_>, tables: &Tables) {
        if tables.is_empty() {
            return;
        }
        match request {
            // It changes nothing until an Action.
            Request::RegWrite(_) => {}
            Request::Action(_)
            | Request::Reboot(_)
            | Request::FactoryReset(_)
            | Request::ControlTableBackup(_) => {
                self.values.retain(|(other, _), _| !ids(id).contains(other));
            }
            request => writes(id, request, |id, address, data| {
                for id in ids(id) {
                    if let Some(table) = tables.of(id) {
                        self.take(id, table, address, data);
                    }
                }
            }),
        }
    }

    /// Forgets what devices refused to write.
    pub(super) fn refused(&mut self, devices: &BTreeSet<u8>, request: &[u8], tables: &Tables) {
        let Ok(frame) = Frame::parse(request) else { return };
        let params: Vec<u8> = frame.params().collect();
        let Ok(request) = Request::of(frame.instruction(), &params) else { return };
        writes(frame.id(), &request, |id, address, data| {
            for id in ids(id).filter(|id| devices.contains(id)) {
                let Some(table) = tables.of(id) else { continue };
                for row in rows(&mut self.tables, table, address, data.len()) {
                    self.values.remove(&(id, row.address));
                }
            }
        });
    }

    /// Takes bytes that were written or read from `address` on.
    pub(super) fn take(&mut self, id: u8, table: &'static Device, address: u16, data: &[u8]) {
        for row in rows(&mut self.tables, table, address, data.len()) {
            let from = usize::from(row.address - address);
            let bytes = data.get(from..from + usize::from(row.kind.size()));
            if let Some(value) = bytes.and_then(|bytes| row.decode(bytes)) {
                self.values.insert((id, row.address), value);
            }
        }
    }
}

/// The devices that an ID means.
fn ids(id: u8) -> RangeInclusive<u8> {
    if id == BROADCAST_ID { 0..=BROADCAST_ID - 1 } else { id..=id }
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

/// The registers to which their table refers itself, of those that lie wholly within some bytes.
fn rows(
    tables: &mut Vec<(&'static Device, Vec<&'static Row>)>,
    table: &'static Device,
    address: u16,
    length: usize,
) -> impl Iterator<Item = &'static Row> {
    let known = tables.iter().position(|(known, _)| ptr::eq(*known, table));
    let index = known.unwrap_or_else(|| {
        tables.push((table, referred(table)));
        tables.len() - 1
    });
    let rows = tables.get(index).map_or(&[][..], |(_, rows)| rows);
    let first = rows.partition_point(|row| row.address < address);
    let end = usize::from(address) + length;
    let is_within =
        move |row: &&Row| usize::from(row.address) + usize::from(row.kind.size()) <= end;
    rows.get(first..).unwrap_or_default().iter().copied().take_while(is_within)
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
