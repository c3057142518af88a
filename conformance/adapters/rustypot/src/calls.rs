//! `encode`: the function of the library that sends an instruction.

use actucheck_adapter::{Call, Refusal};
use rustypot::DynamixelProtocolHandler;

use crate::memory_port::MemoryPort;
use crate::refusal;

const BROADCAST: u8 = 0xFE;

/// The bytes that the library sends in the call for the instruction. The answer that it may wait
/// for does not arrive.
pub(crate) fn sent(id: u8, call: &Call) -> Result<Vec<u8>, Refusal> {
    let handler = DynamixelProtocolHandler::v2();
    let port = &mut MemoryPort::default();
    if for_several(call) && id != BROADCAST {
        return Err(Refusal::skipped("the library sends it to the broadcast ID only"));
    }
    let failed = match call {
        Call::Ping if id == BROADCAST => handler.broadcast_ping(port).err(),
        Call::Ping => handler.ping(port, id).err(),
        Call::Read { address, length } => {
            handler.read(port, id, address_of(*address)?, length_of(*length)?).err()
        }
        Call::Write { address, data } => handler.write(port, id, address_of(*address)?, data).err(),
        Call::FactoryReset { option } => {
            let (id_only, id_and_baud_rate) = kept(*option)?;
            handler.factory_reset(port, id, id_only, id_and_baud_rate).err()
        }
        Call::Reboot => handler.reboot(port, id).err(),
        Call::SyncRead { address, length, ids } => {
            handler.sync_read(port, ids, address_of(*address)?, length_of(*length)?).err()
        }
        Call::FastSyncRead { address, length, ids } => {
            handler.fast_sync_read(port, ids, address_of(*address)?, length_of(*length)?).err()
        }
        Call::SyncWrite { address, devices, .. } => {
            let ids: Vec<_> = devices.iter().map(|device| device.id).collect();
            let data: Vec<_> = devices.iter().map(|device| device.data.to_vec()).collect();
            handler.sync_write(port, &ids, address_of(*address)?, &data).err()
        }
        Call::RegWrite { .. }
        | Call::Action
        | Call::Clear { .. }
        | Call::ControlTableBackup { .. }
        | Call::FastSyncWrite { .. }
        | Call::BulkRead { .. }
        | Call::BulkWrite { .. } => {
            return Err(Refusal::skipped("the library has no function for this instruction"));
        }
        Call::Instruction { .. } => {
            return Err(Refusal::skipped("the library sends no packet but by a function for it"));
        }
    };
    match failed {
        Some(error) if port.written.is_empty() => Err(refusal(error.as_ref())),
        _ => Ok(port.written.clone()),
    }
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
