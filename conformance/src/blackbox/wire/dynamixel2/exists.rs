//! Which packets the documents have. The others are not judged.

use actucheck_spec::Spec;
use actucheck_spec::wire::Call;
use actucheck_spec::wire::dynamixel2::reference::{self, BROADCAST};
use actucheck_spec::wire::dynamixel2::{Instruction, Packet};

/// The parameters that the documents print, where an instruction has no others.
pub(super) const FACTORY_RESET: [&[u8]; 3] = [&[0xFF], &[0x01], &[0x02]];
pub(super) const CLEAR: [&[u8]; 1] = [&[0x01, 0x44, 0x58, 0x4C, 0x22]];
pub(super) const BACKUP: [&[u8]; 2] =
    [&[0x01, 0x43, 0x54, 0x52, 0x4C], &[0x02, 0x43, 0x54, 0x52, 0x4C]];

/// The instructions to one device that a host may send to all.
const TO_ALL: [&str; 4] = ["Ping", "Write", "Reg Write", "Action"];

/// The row of an instruction.
pub(super) fn row(spec: &Spec, code: u8) -> Option<&Instruction> {
    spec.wires.dynamixel2.content.instructions.iter().find(|row| row.code == code)
}

/// Whether a device may have this ID.
pub(super) const fn is_device(id: u8) -> bool {
    id < BROADCAST - 1
}

/// Whether a host may send this instruction packet. Status packets may have any parameters.
pub(super) fn exists(spec: &Spec, packet: &Packet) -> bool {
    let Packet::Instruction { id, instruction, params } = packet else { return true };
    let Some(row) = row(spec, *instruction) else { return false };
    let call = reference::call(packet);
    let addressed = match *id {
        BROADCAST => row.broadcast_only || TO_ALL.contains(&row.name.as_str()),
        id => !row.broadcast_only && is_device(id),
    };
    let params = params.0.as_slice();
    let printed = match call.name {
        "factory_reset" => FACTORY_RESET.contains(&params),
        "clear" => CLEAR.contains(&params),
        "control_table_backup" => BACKUP.contains(&params),
        _ => true,
    };
    !call.is_general
        && addressed
        && printed
        && names_devices(row.broadcast_only, &call)
        && names_bytes(&call)
}

/// Whether a call names at least one device, if it is for several, and none twice.
fn names_devices(several: bool, call: &Call) -> bool {
    let devices = call.devices.iter().flatten().map(|device| device.id);
    let mut ids: Vec<u8> = call.ids.iter().flatten().copied().chain(devices).collect();
    let named = ids.len();
    ids.sort_unstable();
    ids.dedup();
    ids.len() == named && ids.iter().all(|id| is_device(*id)) && (!several || named > 0)
}

/// Whether a call reads or writes at least one byte wherever it does.
fn names_bytes(call: &Call) -> bool {
    let devices = call.devices.iter().flatten();
    let lengths = devices.clone().filter_map(|device| device.length).chain(call.length);
    let data = devices.filter_map(|device| device.data.as_ref()).chain(&call.data);
    lengths.into_iter().all(|length| length > 0) && data.into_iter().all(|data| !data.is_empty())
}
