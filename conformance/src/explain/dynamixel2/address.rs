//! Addresses in words.

use actucheck_codec::register::Device;

use crate::device::{KNOWN, Tables};

/// An address with its register, if the table of each device that it is for is known. If tables
/// differ, or one is not known, what each device has there is a remark.
pub(super) fn address_words(address: u16, whom: &[u8], tables: &Tables) -> String {
    let mut devices: Vec<_> = whom.iter().map(|id| tables.of(*id)).collect();
    devices.sort_by_key(|device| device.map(|device| device.id));
    devices.dedup();
    let note = if let [Some(device)] = *devices {
        register(device, address)
    } else {
        let known: Option<Vec<_>> = devices.into_iter().collect();
        remark(&known.unwrap_or_else(|| KNOWN.to_vec()), address)
    };
    note.map_or_else(|| address.to_string(), |note| format!("{address} ({note})"))
}

/// What a device has at an address. A table that has not every register does not say that there is
/// nothing.
fn register(device: &Device, address: u16) -> Option<String> {
    let name = device.name;
    let before = device.registers.iter().rev().find(|row| row.address <= address);
    match before.map(|row| (row.name, row.kind.size(), address - row.address)) {
        Some((register, _, 0)) => Some(format!("{register}, {name}")),
        Some((register, size, at)) if at < size => {
            Some(format!("byte {} of {register}, {name}", at + 1))
        }
        _ => device.complete.then(|| format!("no register of {name} begins there")),
    }
}

/// The registers that begin at an address: `if ja40 or ja-variant: Goal Position`.
fn remark(devices: &[&Device], address: u16) -> Option<String> {
    let mut found: Vec<(&str, Vec<&str>)> = Vec::new();
    for device in devices {
        let Some(row) = device.register(address) else { continue };
        match found.iter_mut().find(|(name, _)| *name == row.name) {
            Some((_, ids)) => ids.push(device.id),
            None => found.push((row.name, vec![device.id])),
        }
    }
    let words: Vec<_> =
        found.iter().map(|(name, ids)| format!("if {}: {name}", ids.join(" or "))).collect();
    (!words.is_empty()).then(|| words.join("; "))
}
