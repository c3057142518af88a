//! The function of the library that makes a call.

use std::collections::BTreeSet;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};

use actucheck_adapter::{Call, Device, Hex, Reported};
use dynamixel2::instructions::packet_id::BROADCAST;
use dynamixel2::instructions::{
    BulkReadData, BulkWriteData, FactoryResetKind, Ping, SyncWriteData,
};
use dynamixel2::{Response, TransferError, WriteError};

use crate::line::Buffered;

/// The parameters that `clear_revolution_counter` sends.
const CLEAR_REVOLUTIONS: [u8; 5] = [0x01, 0x44, 0x58, 0x4C, 0x22];

/// Why a call returns nothing.
pub(crate) enum Failure {
    /// The library has no function for it, for this reason.
    Missing(&'static str),
    /// The library refuses it with a panic, as its documentation says.
    Refused(&'static str),
    Failed(TransferError),
}

impl<E: Into<TransferError>> From<E> for Failure {
    fn from(error: E) -> Self {
        Self::Failed(error.into())
    }
}

/// Calls the function for the instruction, and returns what it returns; `None` if there is none.
pub(crate) fn make(
    bus: &mut Buffered,
    id: u8,
    call: &Call,
) -> Option<Result<Vec<Reported>, Failure>> {
    if for_several(call) && id != BROADCAST {
        return Some(Err(Failure::Missing("the library sends it to the broadcast ID only")));
    }
    let result = match call {
        Call::Ping if id == BROADCAST => scan(bus),
        Call::Ping => bus.ping(id).map(|response| vec![found(&response)]).map_err(Failure::from),
        Call::Read { address, length } => one(bus.read(id, *address, *length)),
        Call::Write { address, data } => done(bus.write(id, *address, data)),
        Call::RegWrite { address, data } => done(bus.reg_write(id, *address, data)),
        Call::Action => done(bus.action(id)),
        Call::FactoryReset { option } => match kind(*option) {
            Some(kind) => done(bus.factory_reset(id, kind)),
            None => Err(Failure::Missing("the library has no such kind of factory reset")),
        },
        Call::Reboot => done(bus.reboot(id)),
        Call::Clear { params } if **params == CLEAR_REVOLUTIONS => {
            done(bus.clear_revolution_counter(id))
        }
        Call::Clear { .. } => Err(Failure::Missing("the library clears the revolutions only")),
        Call::SyncRead { address, length, ids } => each(bus.sync_read(ids, *address, *length)),
        Call::SyncWrite { address, length, devices } => {
            let data = devices
                .iter()
                .map(|device| SyncWriteData { motor_id: device.id, data: device.data.to_vec() });
            written(bus.sync_write(*address, *length, data))
        }
        Call::BulkRead { devices } => {
            let reads = devices.iter().map(|device| BulkReadData {
                motor_id: device.id,
                address: device.address,
                count: device.length,
            });
            let reads: Vec<_> = reads.collect();
            match catch_unwind(AssertUnwindSafe(|| bus.bulk_read(&reads))) {
                Ok(result) => each(result),
                Err(_) if repeats(devices) => {
                    Err(Failure::Refused("panicked on an ID that is there twice"))
                }
                Err(panic) => resume_unwind(panic),
            }
        }
        Call::BulkWrite { devices } => {
            let writes = devices.iter().map(|device| BulkWriteData {
                motor_id: device.id,
                address: device.address,
                data: device.data.to_vec(),
            });
            written(bus.bulk_write(&writes.collect::<Vec<_>>()))
        }
        Call::ControlTableBackup { .. }
        | Call::FastSyncRead { .. }
        | Call::FastSyncWrite { .. }
        | Call::Instruction { .. } => return None,
    };
    Some(result)
}

/// Sends parameters as they are.
pub(crate) fn send_raw(
    bus: &mut Buffered,
    id: u8,
    instruction: u8,
    params: &[u8],
) -> Result<Vec<Reported>, Failure> {
    let copied = |buffer: &mut [u8]| buffer.copy_from_slice(params);
    written(bus.write_instruction(id, instruction, params.len(), copied))
}

fn for_several(call: &Call) -> bool {
    use Call::{BulkRead, BulkWrite, SyncRead, SyncWrite};
    matches!(call, SyncRead { .. } | SyncWrite { .. } | BulkRead { .. } | BulkWrite { .. })
}

fn repeats(devices: &[Device]) -> bool {
    let ids: BTreeSet<_> = devices.iter().map(|device| device.id).collect();
    ids.len() < devices.len()
}

fn kind(option: Option<u8>) -> Option<FactoryResetKind> {
    match option? {
        0xFF => Some(FactoryResetKind::ResetAll),
        0x01 => Some(FactoryResetKind::KeepId),
        0x02 => Some(FactoryResetKind::KeepIdAndBaudRate),
        _ => None,
    }
}

/// All that answer within the time that all devices have together.
fn scan(bus: &mut Buffered) -> Result<Vec<Reported>, Failure> {
    let found = bus.scan()?.into_iter().map(|response| Ok(found(&response?)));
    found.collect::<Result<_, TransferError>>().map_err(Failure::from)
}

fn found(response: &Response<Ping>) -> Reported {
    let Ping { model, firmware } = response.data;
    let (model_number, firmware_version) = (Some(model), Some(firmware));
    Reported { model_number, firmware_version, ..reported(response) }
}

/// Devices with data.
fn each(result: Result<Vec<Response<Vec<u8>>>, TransferError>) -> Result<Vec<Reported>, Failure> {
    let with_data = |response: Response<Vec<u8>>| Reported {
        data: Some(Hex(response.data.clone())),
        ..reported(&response)
    };
    Ok(result?.into_iter().map(with_data).collect())
}

fn one(result: Result<Response<Vec<u8>>, TransferError>) -> Result<Vec<Reported>, Failure> {
    each(result.map(|response| vec![response]))
}

/// The library makes up an answer of the broadcast ID, which is that of no device.
fn done(result: Result<Response<()>, TransferError>) -> Result<Vec<Reported>, Failure> {
    let response = result?;
    Ok(if response.motor_id == BROADCAST { Vec::new() } else { vec![reported(&response)] })
}

fn reported<T>(response: &Response<T>) -> Reported {
    Reported { id: response.motor_id, alert: Some(response.alert), ..Reported::default() }
}

fn written(result: Result<(), WriteError>) -> Result<Vec<Reported>, Failure> {
    Ok(result.map(|()| Vec::new())?)
}
