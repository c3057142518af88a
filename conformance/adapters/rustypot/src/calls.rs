//! The function of the library that makes a call.

use std::error::Error;

use actucheck_adapter::{Call, Hex, Refusal, Reported};
use rustypot::{DynamixelProtocolHandler, StatusError};
use serialport::SerialPort;

const BROADCAST: u8 = 0xFE;

/// Why a call returns nothing.
pub(crate) enum Failure {
    /// The library has no function for it.
    Missing(Refusal),
    /// A function that says whether there was a good answer says that there was none.
    NoAnswer,
    Failed(Box<dyn Error>),
}

impl From<Refusal> for Failure {
    fn from(refusal: Refusal) -> Self {
        Self::Missing(refusal)
    }
}

impl From<Box<dyn Error>> for Failure {
    fn from(error: Box<dyn Error>) -> Self {
        Self::Failed(error)
    }
}

/// Calls the function for the instruction, and returns what it returns. Where there are two, it is the
/// one that returns the device's error as well.
pub(crate) fn make(
    port: &mut dyn SerialPort,
    id: u8,
    call: &Call,
) -> Result<Vec<Reported>, Failure> {
    let handler = DynamixelProtocolHandler::v2();
    if for_several(call) && id != BROADCAST {
        return Err(Refusal::skipped("the library sends it to the broadcast ID only").into());
    }
    Ok(match call {
        Call::Ping if id == BROADCAST => {
            handler.broadcast_ping(port)?.into_iter().map(only).collect()
        }
        Call::Ping => answered(id, handler.ping(port, id)?)?,
        Call::Read { address, length } => {
            let (address, length) = (address_of(*address)?, length_of(*length)?);
            vec![with_data(id, handler.read_with_error(port, id, address, length)?)]
        }
        Call::Write { address, data } => {
            let error = handler.write_with_error(port, id, address_of(*address)?, data)?;
            vec![with_error(id, error)]
        }
        Call::FactoryReset { option } => {
            let (id_only, id_and_baud_rate) = kept(*option)?;
            handler.factory_reset(port, id, id_only, id_and_baud_rate)?;
            vec![only(id)]
        }
        Call::Reboot => answered(id, handler.reboot(port, id)?)?,
        Call::SyncRead { address, length, ids } => {
            let (address, length) = (address_of(*address)?, length_of(*length)?);
            each(ids, handler.sync_read_with_error(port, ids, address, length)?)
        }
        Call::FastSyncRead { address, length, ids } => {
            let (address, length) = (address_of(*address)?, length_of(*length)?);
            let handler = handler.with_fast_sync_read();
            each(ids, handler.sync_read_with_error(port, ids, address, length)?)
        }
        Call::SyncWrite { address, devices, .. } => {
            let ids: Vec<_> = devices.iter().map(|device| device.id).collect();
            let data: Vec<_> = devices.iter().map(|device| device.data.to_vec()).collect();
            handler.sync_write(port, &ids, address_of(*address)?, &data)?;
            Vec::new()
        }
        Call::RegWrite { .. }
        | Call::Action
        | Call::Clear { .. }
        | Call::ControlTableBackup { .. }
        | Call::FastSyncWrite { .. }
        | Call::BulkRead { .. }
        | Call::BulkWrite { .. } => {
            let reason = "the library has no function for this instruction";
            return Err(Refusal::skipped(reason).into());
        }
        Call::Instruction { .. } => {
            let reason = "the library sends no packet but by a function for it";
            return Err(Refusal::skipped(reason).into());
        }
    })
}

fn answered(id: u8, is_answered: bool) -> Result<Vec<Reported>, Failure> {
    if is_answered { Ok(vec![only(id)]) } else { Err(Failure::NoAnswer) }
}

fn each(ids: &[u8], answers: Vec<(Vec<u8>, StatusError)>) -> Vec<Reported> {
    ids.iter().zip(answers).map(|(id, answer)| with_data(*id, answer)).collect()
}

fn with_data(id: u8, (data, error): (Vec<u8>, StatusError)) -> Reported {
    Reported { data: Some(Hex(data)), ..with_error(id, error) }
}

fn with_error(id: u8, error: StatusError) -> Reported {
    let number = Some(error.v2_instruction_error()).filter(|number| *number != 0);
    Reported { error: number, alert: Some(error.v2_alert()), ..only(id) }
}

fn only(id: u8) -> Reported {
    Reported { id, ..Reported::default() }
}

fn for_several(call: &Call) -> bool {
    matches!(call, Call::SyncRead { .. } | Call::FastSyncRead { .. } | Call::SyncWrite { .. })
}

fn address_of(address: u16) -> Result<u8, Refusal> {
    u8::try_from(address).map_err(|_| Refusal::skipped("the library takes addresses up to 255"))
}

/// A number of bytes to read, in the library's type.
pub(crate) fn length_of(length: u16) -> Result<u8, Refusal> {
    u8::try_from(length).map_err(|_| Refusal::skipped("the library reads up to 255 bytes"))
}

/// The settings that a factory reset keeps: the ID alone, or the ID and the baud rate.
fn kept(option: Option<u8>) -> Result<(bool, bool), Refusal> {
    match option {
        Some(0xFF) => Ok((false, false)),
        Some(0x01) => Ok((true, false)),
        Some(0x02) => Ok((true, true)),
        _ => Err(Refusal::skipped("the library has no such kind of factory reset")),
    }
}
