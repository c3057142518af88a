//! Packets of every kind: built and read they are the same again, and arbitrary bytes are read as
//! the reference reads them.

use actucheck::reference::{self, BROADCAST, HEADER, PREFIX};
use actucheck_codec::dynamixel2::{
    ClearOption, ControlTableBackupOption, FactoryResetOption, Instruction,
};
use actucheck_codec::instruction::{
    Action, BulkRead, BulkWrite, Clear, ControlTableBackup, DeviceData, DeviceRange, DeviceWrite,
    FactoryReset, FastSyncRead, FastSyncWrite, Ping, Read, Reboot, RegWrite, SyncRead, SyncWrite,
    Write,
};
use actucheck_codec::status::{self, PingStatus, Status, StatusError};
use actucheck_codec::{
    BufferTooSmall, EncodeError, Frame, FrameError, Request, frame, ja40, layout,
};
use actucheck_spec::model::{Fault, Packet};
use arbitrary::{Result, Unstructured};

use crate::targets::shown;

/// The input is a packet, and then what a packet is made of.
///
/// # Panics
/// If the codec is wrong.
pub fn check(input: &[u8]) {
    read(input);
    let mut choices = Unstructured::new(input);
    // Choices may end early: then there is no packet.
    let _ = choices.ratio(1, 4).and_then(|status| {
        if status { build_status(&mut choices) } else { build_instruction(&mut choices) }
    });
}

/// Bytes are the packet, or have the fault, that the reference finds.
fn read(bytes: &[u8]) {
    let expected = reference::decode(bytes);
    let frame = match Frame::parse(bytes) {
        Ok(frame) => frame,
        Err(error) => {
            assert!(error.offset() <= bytes.len().max(PREFIX), "{error}");
            shown(&error);
            return assert_eq!(Err(fault(&error)), expected);
        }
    };
    let params: Vec<u8> = frame.params().collect();
    let found = match (frame.error(), frame.instruction()) {
        (Some(error), _) => {
            let params = params[1..].to_vec().into();
            Packet::Status { id: frame.id(), error: error.0, params }
        }
        (None, instruction) => {
            let (instruction, params) = (instruction.code(), params.clone().into());
            Packet::Instruction { id: frame.id(), instruction, params }
        }
    };
    assert_eq!(Ok(found), expected);

    assert_eq!(frame.params_len(), params.len());
    let mut scratch = vec![0; params.len()];
    assert_eq!(frame.copy_params(&mut scratch), Ok(&params[..]));
    let mut buffer = vec![0; bytes.len()];
    let again = frame::encode(frame.id(), frame.instruction(), &[&params], &mut buffer);
    assert_eq!(again, Ok(bytes));
    assert_eq!(Frame::parse(&buffer), Ok(frame));
    walk(frame.instruction(), &params);

    // An instruction that is understood says again what it was read from.
    if let Ok(request) = Request::parse(&frame, &mut scratch).inspect_err(shown) {
        assert_eq!(request.encode(frame.id(), &mut buffer), Ok(bytes), "{request:?}");
    }
    if let Ok(status) = frame.status().inspect_err(shown) {
        read_status(&status, frame.id(), &params);
    }
}

fn read_status(status: &Status<'_>, id: u8, params: &[u8]) {
    let (error, data) = params.split_first().unwrap();
    assert_eq!((status.id(), status.error().0), (id, *error));
    assert_eq!(status.error().alert(), error & 0x80 != 0);
    assert_eq!(status.error().number().code(), error & 0x7F);
    assert!(status.data().eq(data.iter().copied()));
    assert_eq!(status.copy_data(&mut vec![0; data.len()]), Ok(data));

    let value = status.value(ja40::PRESENT_POSITION).inspect_err(shown);
    assert_eq!(value.ok(), <[u8; 4]>::try_from(data).ok().map(i32::from_le_bytes));
    let ping = status.ping().inspect_err(shown);
    assert_eq!(ping.is_ok(), data.len() == PingStatus::SIZE);
    assert_eq!(PingStatus::parse(data).inspect_err(shown), ping);
}

/// The fields of the parameters lie one behind the other and end with them.
fn walk(instruction: Instruction, params: &[u8]) {
    let layout = instruction.parameters().unwrap_or_default();
    let mut end = 0;
    for item in layout::fields(layout, params) {
        match item {
            Ok(item) => {
                assert_eq!(item.offset, end);
                let number = |bytes: [u8; 2]| u16::from_le_bytes(bytes).into();
                if let Ok(bytes) = item.bytes.try_into() {
                    assert_eq!(item.number(), Some(number(bytes)));
                }
                end += item.bytes.len();
            }
            Err(error) => {
                shown(&error);
                return assert!(error.offset() <= params.len(), "{error}");
            }
        }
    }
    assert!(layout.is_empty() || end == params.len(), "{end} of {} bytes", params.len());
}

/// The fault that the reference would name.
pub(super) const fn fault(error: &FrameError) -> Fault {
    match error {
        FrameError::Header { .. } => Fault::Header,
        FrameError::Id { .. } | FrameError::BlockId { .. } => Fault::Id,
        FrameError::Length { .. } => Fault::Length,
        FrameError::Truncated { .. } => Fault::Truncated,
        FrameError::Trailing { .. } => Fault::Trailing,
        FrameError::Crc { .. } => Fault::Crc,
        FrameError::Stuffing { .. } => Fault::Stuffing,
        FrameError::Instruction { .. } => Fault::Instruction,
    }
}

fn build_status(choices: &mut Unstructured<'_>) -> Result<()> {
    let [id, error] = choices.arbitrary()?;
    if choices.arbitrary()? {
        let (model_number, firmware_version) = choices.arbitrary()?;
        let ping = PingStatus { model_number, firmware_version };
        let [low, high] = model_number.to_le_bytes();
        let body = [0x55, error, low, high, firmware_version];
        built(
            id,
            &body,
            |buffer| ping.encode(id, StatusError(error), buffer),
            |frame| frame.status().unwrap().ping() == Ok(ping),
        );
    } else {
        let data = data(choices)?;
        let body = [&[0x55, error], data].concat();
        built(
            id,
            &body,
            |buffer| status::encode(id, StatusError(error), data, buffer),
            |frame| {
                let status = frame.status().unwrap();
                status.error().0 == error && status.data().eq(data.iter().copied())
            },
        );
    }
    Ok(())
}

/// An instruction of any kind, its parameters put together by hand beside it.
fn build_instruction(choices: &mut Unstructured<'_>) -> Result<()> {
    let id = choices.arbitrary()?;
    match choices.int_in_range(0..=9)? {
        0 => plain(id, 0x01, &[], &Request::Ping(Ping)),
        1 => plain(id, 0x05, &[], &Request::Action(Action)),
        2 => plain(id, 0x08, &[], &Request::Reboot(Reboot)),
        3 => {
            let (address, length) = choices.arbitrary()?;
            plain(id, 0x02, &head(address, length), &Request::Read(Read { address, length }));
        }
        4 => {
            let (address, data): (u16, _) = (choices.arbitrary()?, data(choices)?);
            let params = [&address.to_le_bytes(), data].concat();
            plain(id, 0x03, &params, &Request::Write(Write { address, data }));
            plain(id, 0x04, &params, &Request::RegWrite(RegWrite { address, data }));
        }
        5 => option(choices, id)?,
        6 => unknown(id, choices.arbitrary()?, data(choices)?),
        7 => sync(choices)?,
        8 => bulk_read(choices)?,
        _ => bulk_write(choices)?,
    }
    Ok(())
}

/// One that goes to an ID.
fn plain(id: u8, code: u8, params: &[u8], request: &Request<'_>) {
    let body = [&[code], params].concat();
    built(
        id,
        &body,
        |buffer| request.encode(id, buffer),
        |frame| Request::parse(frame, &mut vec![0; params.len()]).as_ref() == Ok(request),
    );
}

fn option(choices: &mut Unstructured<'_>, id: u8) -> Result<()> {
    let code = choices.arbitrary()?;
    let option = FactoryResetOption::from_code(code);
    plain(id, 0x06, &[code], &Request::FactoryReset(FactoryReset { option }));
    let key: [u8; 4] = choices.arbitrary()?;
    let params = [&[code], &key[..]].concat();
    let option = ControlTableBackupOption::from_code(code);
    let backup = ControlTableBackup { option, key };
    plain(id, 0x20, &params, &Request::ControlTableBackup(backup));
    let clear = Clear::Option { option: ClearOption::from_code(code), key: &key };
    plain(id, 0x10, &params, &Request::Clear(clear));
    plain(id, 0x10, &[], &Request::Clear(Clear::Bare));
    Ok(())
}

/// An instruction that no document has.
fn unknown(id: u8, code: u8, params: &[u8]) {
    if let Instruction::Unknown(code) = Instruction::from_code(code) {
        plain(id, code, params, &Request::Unknown { code, params });
    }
}

fn sync(choices: &mut Unstructured<'_>) -> Result<()> {
    let address = choices.arbitrary()?;
    let size = choices.int_in_range(0..=8)?;
    let mut devices = Vec::new();
    while devices.len() < 5 && choices.ratio(3, 4)? {
        devices.push(DeviceData { id: choices.arbitrary()?, data: choices.bytes(size)? });
    }
    let length = u16::try_from(size).unwrap();
    let ids: Vec<_> = devices.iter().map(|device| device.id).collect();

    let params = [&head(address, length), &ids[..]].concat();
    let read = SyncRead { address, length, ids: &ids[..] };
    broadcast(
        0x82,
        &params,
        &ids,
        |buffer| read.encode(buffer),
        |request| matches!(request, Request::SyncRead(found) if *found == read),
    );
    let read = FastSyncRead { address, length, ids: &ids[..] };
    broadcast(
        0x8A,
        &params,
        &ids,
        |buffer| read.encode(buffer),
        |request| matches!(request, Request::FastSyncRead(found) if *found == read),
    );

    wrong_length(address, length, &devices);
    let mut params = head(address, length).to_vec();
    params.extend(devices.iter().flat_map(|device| [&[device.id], device.data].concat()));
    let write = SyncWrite { address, length, devices: &devices };
    broadcast(
        0x83,
        &params,
        &ids,
        |buffer| write.encode(buffer),
        |request| {
            matches!(request, Request::SyncWrite(found) if (found.address, found.length)
            == (address, length) && found.devices.clone().eq(devices.iter().copied()))
        },
    );
    let write = FastSyncWrite { address, length, devices: &devices };
    broadcast(
        0x8B,
        &params,
        &ids,
        |buffer| write.encode(buffer),
        |request| {
            matches!(request, Request::FastSyncWrite(found) if (found.address, found.length)
            == (address, length) && found.devices.clone().eq(devices.iter().copied()))
        },
    );
    Ok(())
}

/// The devices' data have to be as long as is said.
fn wrong_length(address: u16, length: u16, devices: &[DeviceData<'_>]) {
    let Some(first) = devices.first().filter(|first| first.id <= 252) else { return };
    let (id, found, expected) = (first.id, first.data.len(), length + 1);
    let write = SyncWrite { address, length: expected, devices };
    let mut buffer = [0; 256];
    let built = write.encode(&mut buffer).inspect_err(shown);
    assert_eq!(built, Err(EncodeError::DataLength { id, found, expected }));
}

fn bulk_read(choices: &mut Unstructured<'_>) -> Result<()> {
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

fn bulk_write(choices: &mut Unstructured<'_>) -> Result<()> {
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

/// What is built is what the reference builds, of the very size that is said to be needed, and is
/// read again as the same.
fn built(
    id: u8,
    body: &[u8],
    encode: impl Fn(&mut [u8]) -> std::result::Result<&[u8], EncodeError>,
    is_the_same: impl Fn(&Frame<'_>) -> bool,
) {
    let expected = reference::frame(id, &reference::stuff(body));
    let mut buffer = vec![0; expected.len()];
    if id == 0xFD || id == 0xFF {
        return assert_eq!(encode(&mut buffer), Err(EncodeError::Id { found: id }));
    }
    assert_eq!(encode(&mut buffer), Ok(&expected[..]));
    let too_small = BufferTooSmall { needed: expected.len(), available: expected.len() - 1 };
    assert_eq!(encode(&mut buffer[1..]).inspect_err(shown), Err(EncodeError::Buffer(too_small)));
    assert!(is_the_same(&Frame::parse(&expected).unwrap()), "{expected:02x?}");
}

fn head(address: u16, length: u16) -> [u8; 4] {
    let ([a, b], [c, d]) = (address.to_le_bytes(), length.to_le_bytes());
    [a, b, c, d]
}

fn data<'a>(choices: &mut Unstructured<'a>) -> Result<&'a [u8]> {
    let size = choices.int_in_range(0..=80)?;
    choices.bytes(size.min(choices.len()))
}

/// Makes a packet of it that only its stuffing can be wrong with.
pub fn repair(input: &mut [u8]) {
    let Some(length) = input.len().checked_sub(PREFIX).filter(|length| *length > 2) else { return };
    let [low, high] = u16::try_from(length).unwrap_or(u16::MAX).to_le_bytes();
    input[..4].copy_from_slice(&HEADER);
    input[5..PREFIX].copy_from_slice(&[low, high]);
    if let Some((before, crc)) = input.split_last_chunk_mut::<2>() {
        *crc = reference::crc(before).to_le_bytes();
    }
}
