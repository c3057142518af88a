//! Instructions to several devices.

use actucheck_codec::EncodeError;
use actucheck_codec::dynamixel2::Request;
use actucheck_codec::dynamixel2::instruction::{
    BulkRead, BulkWrite, DeviceData, DeviceRange, DeviceWrite, FastSyncRead, FastSyncWrite,
    SyncRead, SyncWrite,
};
use actucheck_spec::wire::dynamixel2::reference::BROADCAST;
use arbitrary::{Result, Unstructured};

use super::build::{built, head};
use crate::targets::shown;

/// The same registers of several devices.
struct Sync<'a> {
    address: u16,
    length: u16,
    devices: Vec<DeviceData<'a>>,
    ids: Vec<u8>,
}

impl<'a> Sync<'a> {
    fn of(choices: &mut Unstructured<'a>) -> Result<Self> {
        let address = choices.arbitrary()?;
        let size = choices.int_in_range(0..=8)?;
        let mut devices = Vec::new();
        while devices.len() < 5 && choices.ratio(3, 4)? {
            devices.push(DeviceData { id: choices.arbitrary()?, data: choices.bytes(size)? });
        }
        let ids = devices.iter().map(|device| device.id).collect();
        Ok(Self { address, length: u16::try_from(size).unwrap(), devices, ids })
    }
}

/// Sync Read and Fast Sync Read differ in their code alone.
macro_rules! sync_read {
    ($function:ident, $instruction:ident, $code:literal) => {
        pub(super) fn $function(choices: &mut Unstructured<'_>) -> Result<()> {
            let Sync { address, length, ids, .. } = &Sync::of(choices)?;
            let read = $instruction { address: *address, length: *length, ids: &ids[..] };
            let params = [&head(*address, *length), &ids[..]].concat();
            let is_it = |request: &Request<'_>| {
                matches!(request, Request::$instruction(found) if *found == read)
            };
            broadcast($code, &params, ids, |buffer| read.encode(buffer), is_it);
            Ok(())
        }
    };
}

sync_read!(sync_read, SyncRead, 0x82);
sync_read!(fast_sync_read, FastSyncRead, 0x8A);

/// And so do Sync Write and Fast Sync Write.
macro_rules! sync_write {
    ($function:ident, $instruction:ident, $code:literal) => {
        pub(super) fn $function(choices: &mut Unstructured<'_>) -> Result<()> {
            let Sync { address, length, devices, ids } = &Sync::of(choices)?;
            let write = $instruction { address: *address, length: *length, devices };
            let blocks = devices.iter().flat_map(|device| [&[device.id], device.data].concat());
            let params: Vec<_> = head(*address, *length).into_iter().chain(blocks).collect();
            let is_it = |request: &Request<'_>| match request {
                Request::$instruction(found) => {
                    (found.address, found.length) == (*address, *length)
                        && found.devices.clone().eq(devices.iter().copied())
                }
                _ => false,
            };
            broadcast($code, &params, ids, |buffer| write.encode(buffer), is_it);
            wrong_length(*address, *length, devices);
            Ok(())
        }
    };
}

sync_write!(sync_write, SyncWrite, 0x83);
sync_write!(fast_sync_write, FastSyncWrite, 0x8B);

/// The devices' data have to be as long as is said.
fn wrong_length(address: u16, length: u16, devices: &[DeviceData<'_>]) {
    let Some(first) = devices.first().filter(|first| first.id <= 252) else { return };
    let (id, found, expected) = (first.id, first.data.len(), length + 1);
    let write = SyncWrite { address, length: expected, devices };
    let mut buffer = [0; 256];
    let built = write.encode(&mut buffer).inspect_err(shown);
    assert_eq!(built, Err(EncodeError::DataLength { id, found, expected }));
}

pub(super) fn bulk_read(choices: &mut Unstructured<'_>) -> Result<()> {
    let (mut devices, mut params) = (Vec::new(), Vec::new());
    while devices.len() < 6 && choices.ratio(3, 4)? {
        let (id, address, length) = choices.arbitrary()?;
        devices.push(DeviceRange { id, address, length });
        params.push(id);
        params.extend(head(address, length));
    }
    let ids: Vec<_> = devices.iter().map(|device| device.id).collect();
    let read = BulkRead { devices: &devices };
    broadcast(
        0x92,
        &params,
        &ids,
        |buffer| read.encode(buffer),
        |request| {
            matches!(request, Request::BulkRead(found)
            if found.devices.clone().eq(devices.iter().copied()))
        },
    );
    Ok(())
}

pub(super) fn bulk_write(choices: &mut Unstructured<'_>) -> Result<()> {
    let (mut devices, mut params) = (Vec::new(), Vec::new());
    while devices.len() < 6 && choices.ratio(3, 4)? {
        let (id, address) = choices.arbitrary()?;
        let size = choices.int_in_range(0..=6)?;
        let data = choices.bytes(size)?;
        devices.push(DeviceWrite { id, address, data });
        params.push(id);
        params.extend(head(address, u16::try_from(size).unwrap()));
        params.extend(data);
    }
    let ids: Vec<_> = devices.iter().map(|device| device.id).collect();
    let write = BulkWrite { devices: &devices };
    broadcast(
        0x93,
        &params,
        &ids,
        |buffer| write.encode(buffer),
        |request| {
            matches!(request, Request::BulkWrite(found)
            if found.devices.clone().eq(devices.iter().copied()))
        },
    );
    Ok(())
}

/// One that names its devices, which must be some.
fn broadcast(
    code: u8,
    params: &[u8],
    ids: &[u8],
    encode: impl Fn(&mut [u8]) -> std::result::Result<&[u8], EncodeError>,
    is_the_same: impl Fn(&Request<'_>) -> bool,
) {
    if let Some(found) = ids.iter().copied().find(|id| *id > 252) {
        let built = encode(&mut [0; 256]).inspect_err(shown).map(<[u8]>::to_vec);
        return assert_eq!(built, Err(EncodeError::Id { found }));
    }
    let body = [&[code], params].concat();
    built(BROADCAST, &body, encode, |frame| {
        let mut scratch = vec![0; params.len()];
        let request = Request::parse(frame, &mut scratch).unwrap();
        // It names its devices itself.
        assert_eq!(request.encode(1, &mut [0; 256]), Err(EncodeError::Id { found: 1 }));
        is_the_same(&request)
    });
}
