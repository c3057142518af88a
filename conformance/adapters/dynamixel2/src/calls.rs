//! `encode`: the function of the library that sends an instruction.

use std::collections::BTreeSet;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};

use actucheck_adapter::{Call, Device, Refusal};
use dynamixel2::instructions::packet_id::BROADCAST;
use dynamixel2::instructions::{BulkReadData, BulkWriteData, FactoryResetKind, SyncWriteData};
use dynamixel2::{TransferError, WriteError};

use crate::line::{Buffered, broken};

/// The parameters that `clear_revolution_counter` sends.
const CLEAR_REVOLUTIONS: [u8; 5] = [0x01, 0x44, 0x58, 0x4C, 0x22];

/// Calls the function for the instruction; `None` if there is none.
pub(crate) fn send(bus: &mut Buffered, id: u8, call: &Call) -> Option<Result<(), Refusal>> {
    if for_several(call) && id != BROADCAST {
        return Some(Err(Refusal::skipped("the library sends it to the broadcast ID only")));
    }
    Some(match call {
        Call::Ping if id == BROADCAST => written(bus.scan()),
        Call::Ping => transferred(bus.ping(id)),
        Call::Read { address, length } => transferred(bus.read(id, *address, *length)),
        Call::Write { address, data } => transferred(bus.write(id, *address, data)),
        Call::RegWrite { address, data } => transferred(bus.reg_write(id, *address, data)),
        Call::Action => transferred(bus.action(id)),
        Call::FactoryReset { option } => match kind(*option) {
            Some(kind) => transferred(bus.factory_reset(id, kind)),
            None => Err(Refusal::skipped("the library has no such kind of factory reset")),
        },
        Call::Reboot => transferred(bus.reboot(id)),
        Call::Clear { params } if **params == CLEAR_REVOLUTIONS => {
            transferred(bus.clear_revolution_counter(id))
        }
        Call::Clear { .. } => Err(Refusal::skipped("the library clears the revolutions only")),
        Call::SyncRead { address, length, ids } => {
            transferred(bus.sync_read(ids, *address, *length))
        }
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
                Ok(result) => transferred(result),
                // The library refuses a repeated ID with a panic, as its documentation says.
                Err(_) if repeats(devices) => {
                    Err(Refusal::rejected("parameter", "panicked on an ID that is there twice"))
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
    })
}

/// Sends parameters as they are.
pub(crate) fn send_raw(
    bus: &mut Buffered,
    id: u8,
    instruction: u8,
    params: &[u8],
) -> Result<(), Refusal> {
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

/// The answer that the function waits for does not arrive: only sending counts.
fn transferred<T>(result: Result<T, TransferError>) -> Result<(), Refusal> {
    match result {
        Ok(_) | Err(TransferError::ReadError(_)) => Ok(()),
        Err(TransferError::WriteError(error)) => written(Err::<(), _>(error)),
    }
}

fn written<T>(result: Result<T, WriteError>) -> Result<(), Refusal> {
    match result {
        Ok(_) => Ok(()),
        Err(WriteError::BufferTooSmall(error)) => Err(Refusal::rejected("oversize", error)),
        Err(error) => Err(broken(error)),
    }
}
