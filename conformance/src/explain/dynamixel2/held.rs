//! What registers hold, as far as a stream tells.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::RangeInclusive;
use std::ptr;

use actucheck_codec::dynamixel2::instruction::{DeviceData, DeviceWrite};
use actucheck_codec::dynamixel2::{BROADCAST_ID, Frame, Request};
use actucheck_codec::register::{Device, Row};

use super::known::Known;
use crate::device::Tables;

/// By address, a list by ID.
type Values = BTreeMap<u16, Vec<Option<i64>>>;

/// Tables in use, by where they are.
type InUse = BTreeMap<*const Device, Known>;

/// The values of registers on which rules about other registers depend, such as Torque Enable and the
/// limits.
#[derive(Default)]
pub(super) struct Held {
    values: Values,
    tables: InUse,
}

impl Held {
    /// What the register at this address of a device holds; of all devices, if each holds the same.
    pub(super) fn value(&self, id: u8, address: u16) -> Option<i64> {
        let mut values = self.values.get(&address)?.get(places(id))?.iter();
        let first = (*values.next()?)?;
        values.all(|value| *value == Some(first)).then_some(first)
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
                for values in self.values.values_mut() {
                    values.get_mut(places(id)).unwrap_or_default().fill(None);
                }
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
                for row in known(&mut self.tables, table).referred(address, data.len()) {
                    if let Some(value) = place(&mut self.values, id, row.address) {
                        *value = None;
                    }
                }
            }
        });
    }

    /// Whether bytes from `address` on have a register on which rules depend.
    pub(super) fn needs(&mut self, table: &'static Device, address: u16, length: usize) -> bool {
        known(&mut self.tables, table).referred(address, length).next().is_some()
    }

    /// The registers that have some of the bytes from `address` on.
    pub(super) fn touched(
        &mut self,
        table: &'static Device,
        address: u16,
        length: usize,
    ) -> impl Iterator<Item = &'static Row> + use<> {
        known(&mut self.tables, table).touched(address, length)
    }

    /// Takes bytes that were written or read from `address` on.
    pub(super) fn take(&mut self, id: u8, table: &'static Device, address: u16, data: &[u8]) {
        for row in known(&mut self.tables, table).referred(address, data.len()) {
            let from = usize::from(row.address - address);
            let bytes = data.get(from..from + usize::from(row.kind.size()));
            if let Some(value) = bytes.and_then(|bytes| row.decode(bytes))
                && let Some(place) = place(&mut self.values, id, row.address)
            {
                *place = Some(value);
            }
        }
    }
}

/// The devices that an ID means.
fn ids(id: u8) -> RangeInclusive<u8> {
    if id == BROADCAST_ID { 0..=BROADCAST_ID - 1 } else { id..=id }
}

/// The places of those devices in a list by ID.
fn places(id: u8) -> RangeInclusive<usize> {
    let (first, last) = ids(id).into_inner();
    first.into()..=last.into()
}

/// The place of a value.
fn place(values: &mut Values, id: u8, address: u16) -> Option<&mut Option<i64>> {
    let values = values.entry(address).or_insert_with(|| vec![None; 256]);
    values.get_mut(usize::from(id))
}

fn known<'k>(tables: &'k mut InUse, table: &'static Device) -> &'k Known {
    tables.entry(ptr::from_ref(table)).or_insert_with(|| Known::of(table))
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
