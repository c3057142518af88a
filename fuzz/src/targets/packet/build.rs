//! Packets that are built from choices, compared with the same packets built by hand.

use actucheck_codec::dynamixel2::instruction::{
    Action, Clear, ControlTableBackup, FactoryReset, Ping, Read, Reboot, RegWrite, Write,
};
use actucheck_codec::dynamixel2::status::{self, PingStatus, StatusError};
use actucheck_codec::dynamixel2::{
    ClearOption, ControlTableBackupOption, FactoryResetOption, Frame, Instruction, Request,
};
use actucheck_codec::{BufferTooSmall, EncodeError};
use actucheck_spec::wire::dynamixel2::reference;
use arbitrary::{Result, Unstructured};

use super::several;
use crate::targets::shown;

/// A status packet or an instruction of any kind.
pub(super) fn any(choices: &mut Unstructured<'_>) -> Result<()> {
    if choices.ratio(1, 4)? { build_status(choices) } else { build_instruction(choices) }
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

/// An instruction of any kind, with its parameters built by hand.
fn build_instruction(choices: &mut Unstructured<'_>) -> Result<()> {
    let id = choices.arbitrary()?;
    match choices.int_in_range(0..=12)? {
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
            if choices.arbitrary()? {
                plain(id, 0x03, &params, &Request::Write(Write { address, data }));
            } else {
                plain(id, 0x04, &params, &Request::RegWrite(RegWrite { address, data }));
            }
        }
        5 => option(choices, id)?,
        6 => unknown(id, choices.arbitrary()?, data(choices)?),
        7 => several::sync_read(choices)?,
        8 => several::sync_write(choices)?,
        9 => several::fast_sync_read(choices)?,
        10 => several::fast_sync_write(choices)?,
        11 => several::bulk_read(choices)?,
        _ => several::bulk_write(choices)?,
    }
    Ok(())
}

/// An instruction that is sent to an ID.
fn plain(id: u8, code: u8, params: &[u8], request: &Request<'_>) {
    let body = [&[code], params].concat();
    built(
        id,
        &body,
        |buffer| request.encode(id, buffer),
        |frame| Request::parse(frame, &mut vec![0; params.len()]).as_ref() == Ok(request),
    );
}

/// An instruction with an option and a key, or with the option alone.
fn option(choices: &mut Unstructured<'_>, id: u8) -> Result<()> {
    let (code, key): (u8, [u8; 4]) = choices.arbitrary()?;
    let params = [&[code], &key[..]].concat();
    match choices.int_in_range(0..=3)? {
        0 => {
            let option = FactoryResetOption::from_code(code);
            plain(id, 0x06, &[code], &Request::FactoryReset(FactoryReset { option }));
        }
        1 => {
            let option = ControlTableBackupOption::from_code(code);
            let backup = ControlTableBackup { option, key };
            plain(id, 0x20, &params, &Request::ControlTableBackup(backup));
        }
        2 => {
            let clear = Clear::Option { option: ClearOption::from_code(code), key: &key };
            plain(id, 0x10, &params, &Request::Clear(clear));
        }
        _ => plain(id, 0x10, &[], &Request::Clear(Clear::Bare)),
    }
    Ok(())
}

/// An instruction that no document has.
fn unknown(id: u8, code: u8, params: &[u8]) {
    if let Instruction::Unknown(code) = Instruction::from_code(code) {
        plain(id, code, params, &Request::Unknown { code, params });
    }
}

/// The built bytes are those of the reference, have exactly the size that an error states, and
/// decode to the same content.
pub(super) fn built(
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
    assert_eq!(encode(&mut vec![0; expected.len() + 80]), Ok(&expected[..]), "in a larger buffer");
    let too_small = BufferTooSmall { needed: expected.len(), available: expected.len() - 1 };
    assert_eq!(encode(&mut buffer[1..]).inspect_err(shown), Err(EncodeError::Buffer(too_small)));
    assert!(is_the_same(&Frame::parse(&expected).unwrap()), "{expected:02x?}");
}

pub(super) fn head(address: u16, length: u16) -> [u8; 4] {
    let ([a, b], [c, d]) = (address.to_le_bytes(), length.to_le_bytes());
    [a, b, c, d]
}

fn data<'a>(choices: &mut Unstructured<'a>) -> Result<&'a [u8]> {
    let size = choices.int_in_range(0..=80)?;
    choices.bytes(size.min(choices.len()))
}
