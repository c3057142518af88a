//! Calls, and what the host sends for them.

use actucheck_spec::model::HexBytes;
use serde::Deserialize;

use super::faults::{Fault, Switch};
use super::inbox::LONGEST;
use super::packet::{BROADCAST, LARGEST_ID};

/// A call as the suite asks for it.
#[derive(Deserialize)]
#[serde(tag = "name", rename_all = "snake_case")]
pub(crate) enum Call {
    Ping { device: u8 },
    Read { device: u8, address: u16, length: u16 },
    Write { device: u8, address: u16, data: HexBytes },
    RegWrite { device: u8, address: u16, data: HexBytes },
    Action { device: u8 },
    FactoryReset { device: u8, option: u8 },
    Reboot { device: u8 },
    Clear { device: u8, params: HexBytes },
    ControlTableBackup { device: u8, params: HexBytes },
    SyncRead { address: u16, length: u16, ids: Vec<u8> },
    FastSyncRead { address: u16, length: u16, ids: Vec<u8> },
    SyncWrite { address: u16, length: u16, devices: Vec<Write> },
    FastSyncWrite { address: u16, length: u16, devices: Vec<Write> },
    BulkRead { devices: Vec<Read> },
    BulkWrite { devices: Vec<Write> },
}

/// What is for one device of several.
#[derive(Deserialize)]
pub(crate) struct Write {
    id: u8,
    /// Of a Bulk Write only.
    #[serde(default)]
    address: u16,
    data: HexBytes,
}

#[derive(Deserialize)]
pub(crate) struct Read {
    id: u8,
    address: u16,
    length: u16,
}

/// An instruction packet in parts.
pub(crate) struct Request {
    pub(crate) id: u8,
    pub(crate) instruction: u8,
    pub(crate) params: Vec<u8>,
    pub(crate) wanted: Wanted,
}

/// Who should answer, and with how many bytes of data.
pub(crate) enum Wanted {
    Nothing,
    One(u8, usize),
    /// The devices of a Sync Read or a Bulk Read.
    Each {
        devices: Vec<(u8, usize)>,
        by_position: bool,
    },
    /// Whoever is there.
    All(usize),
    /// These, in one packet.
    Fast {
        ids: Vec<u8>,
        length: usize,
    },
}

impl Wanted {
    /// Bytes of data in the first status packet.
    pub(crate) fn length(&self) -> usize {
        match self {
            Self::Nothing => 0,
            Self::One(_, length) | Self::All(length) | Self::Fast { length, .. } => *length,
            Self::Each { devices, .. } => devices.first().map_or(0, |(_, length)| *length),
        }
    }
}

/// Bytes of data that answer a Ping.
const PING: usize = 3;

impl Call {
    /// What is sent, or why nothing is.
    pub(crate) fn request(&self, on: Switch) -> Result<Request, String> {
        if self.devices() == Some(0) {
            return Err("no device".to_owned());
        }
        let request = match self {
            Self::Ping { device: BROADCAST } => Request {
                id: BROADCAST,
                instruction: 0x01,
                params: vec![],
                wanted: Wanted::All(PING),
            },
            Self::Ping { device } => {
                let wanted = Wanted::One(*device, PING);
                Request { id: *device, instruction: 0x01, params: vec![], wanted }
            }
            Self::Read { device, address, length } => {
                if *device == BROADCAST && !on.is(Fault::ReadFromAll) {
                    return Err("no device answers a Read to the broadcast ID".to_owned());
                }
                let params = [address.to_le_bytes(), length.to_le_bytes()].concat();
                let wanted = Wanted::One(*device, (*length).into());
                Request { id: *device, instruction: 0x02, params, wanted }
            }
            Self::Write { device, address, data } => {
                let high_first = on.is(Fault::WriteAddressHighByteFirst);
                let address =
                    if high_first { address.to_be_bytes() } else { address.to_le_bytes() };
                order(*device, 0x03, [&address, &*data.0].concat())
            }
            Self::RegWrite { device, address, data } => {
                let instruction = if on.is(Fault::RegWriteAsWrite) { 0x03 } else { 0x04 };
                order(*device, instruction, [&address.to_le_bytes(), &*data.0].concat())
            }
            Self::Action { device } => {
                let to_all = on.is(Fault::ActionToAll);
                order(if to_all { BROADCAST } else { *device }, 0x05, vec![])
            }
            Self::FactoryReset { device, option } => {
                let all = on.is(Fault::FactoryResetAll);
                order(*device, 0x06, vec![if all { 0xFF } else { *option }])
            }
            Self::Reboot { device } => order(*device, 0x08, vec![]),
            Self::Clear { device, params } => order(*device, 0x10, params.0.clone()),
            Self::ControlTableBackup { device, params } => order(*device, 0x20, params.0.clone()),
            Self::SyncRead { address, length, ids } => {
                let to_first = on.is(Fault::SyncToFirst);
                let id = if to_first { ids.first().copied() } else { None };
                let devices = ids.iter().map(|id| (*id, usize::from(*length))).collect();
                let wanted = Wanted::Each { devices, by_position: on.is(Fault::SyncByPosition) };
                let params = sync_read(*address, *length, ids);
                Request { id: id.unwrap_or(BROADCAST), instruction: 0x82, params, wanted }
            }
            Self::FastSyncRead { address, length, ids } => {
                let wanted = Wanted::Fast { ids: ids.clone(), length: (*length).into() };
                let params = sync_read(*address, *length, ids);
                Request { id: BROADCAST, instruction: 0x8A, params, wanted }
            }
            Self::SyncWrite { address, length, devices } => {
                order(BROADCAST, 0x83, sync_write(on, *address, *length, devices)?)
            }
            Self::FastSyncWrite { address, length, devices } => {
                let ids = devices.iter().map(|device| device.id).collect();
                let params = sync_write(on, *address, *length, devices)?;
                let wanted = Wanted::Fast { ids, length: 0 };
                let instruction = if on.is(Fault::FastWriteAsWrite) { 0x83 } else { 0x8B };
                Request { id: BROADCAST, instruction, params, wanted }
            }
            Self::BulkRead { devices } => {
                let params = bulk_read(on, devices)?;
                let one_length = on.is(Fault::BulkReadOneLength);
                let length = |at: usize| devices[if one_length { 0 } else { at }].length.into();
                let devices =
                    devices.iter().enumerate().map(|(at, device)| (device.id, length(at)));
                let by_position = on.is(Fault::BulkByPosition);
                let wanted = Wanted::Each { devices: devices.collect(), by_position };
                Request { id: BROADCAST, instruction: 0x92, params, wanted }
            }
            Self::BulkWrite { devices } => order(BROADCAST, 0x93, bulk_write(on, devices)?),
        };
        let smallest = u8::from(on.is(Fault::RefusesIdZero));
        if !(smallest..=LARGEST_ID).contains(&request.id) && request.id != BROADCAST {
            return Err(format!("{} is no ID", request.id));
        }
        // Half of it may be stuffing.
        if request.params.len().max(request.wanted.length()) > LONGEST / 2 {
            return Err(format!("more than {} bytes", LONGEST / 2));
        }
        Ok(request)
    }

    /// How many devices it lists, if it has a list.
    fn devices(&self) -> Option<usize> {
        match self {
            Self::SyncRead { ids, .. } | Self::FastSyncRead { ids, .. } => Some(ids.len()),
            Self::SyncWrite { devices, .. }
            | Self::FastSyncWrite { devices, .. }
            | Self::BulkWrite { devices } => Some(devices.len()),
            Self::BulkRead { devices } => Some(devices.len()),
            _ => None,
        }
    }

    /// Whether it reads values.
    pub(crate) fn reads(&self) -> bool {
        matches!(
            self,
            Self::Read { .. }
                | Self::SyncRead { .. }
                | Self::FastSyncRead { .. }
                | Self::BulkRead { .. }
        )
    }
}

/// An instruction that is answered without data, if it is answered.
fn order(id: u8, instruction: u8, params: Vec<u8>) -> Request {
    let wanted = if id == BROADCAST { Wanted::Nothing } else { Wanted::One(id, 0) };
    Request { id, instruction, params, wanted }
}

fn sync_read(address: u16, length: u16, ids: &[u8]) -> Vec<u8> {
    [&address.to_le_bytes(), &length.to_le_bytes(), ids].concat()
}

fn sync_write(on: Switch, address: u16, length: u16, devices: &[Write]) -> Result<Vec<u8>, String> {
    let mut params = [address.to_le_bytes(), length.to_le_bytes()].concat();
    for device in devices {
        let first = on.is(Fault::SyncWriteFirstData);
        let data = if first { &devices[0].data.0 } else { &device.data.0 };
        if data.len() != usize::from(length) {
            return Err(format!("{length} bytes are for each device"));
        }
        params.push(device.id);
        params.extend(data);
    }
    Ok(params)
}

fn bulk_read(on: Switch, devices: &[Read]) -> Result<Vec<u8>, String> {
    let repeats = on.is(Fault::BulkReadRepeats);
    if !repeats && has_twice(devices.iter().map(|device| device.id)) {
        return Err("a Bulk Read names no device twice".to_owned());
    }
    let mut params = Vec::new();
    for device in devices {
        let first = on.is(Fault::BulkReadFirstAddress);
        let address = if first { devices[0].address } else { device.address };
        params.push(device.id);
        params.extend([address.to_le_bytes(), device.length.to_le_bytes()].concat());
    }
    Ok(params)
}

fn bulk_write(on: Switch, devices: &[Write]) -> Result<Vec<u8>, String> {
    if has_twice(devices.iter().map(|device| device.id)) {
        return Err("a Bulk Write names no device twice".to_owned());
    }
    let mut params = Vec::new();
    for device in devices {
        let one = on.is(Fault::BulkWriteOneLength);
        let data = if one { &devices[0].data.0 } else { &device.data.0 };
        let length = u16::try_from(data.len()).map_err(|error| error.to_string())?;
        params.push(device.id);
        params.extend([device.address.to_le_bytes(), length.to_le_bytes()].concat());
        params.extend(&device.data.0);
    }
    Ok(params)
}

fn has_twice(ids: impl Iterator<Item = u8>) -> bool {
    let mut seen = Vec::new();
    for id in ids {
        if seen.contains(&id) {
            return true;
        }
        seen.push(id);
    }
    false
}
