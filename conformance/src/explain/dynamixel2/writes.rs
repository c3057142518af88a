//! What is wrong in writing registers.

use actucheck_codec::register::{Access, Area, Device, RegisterError, Row};

use super::held::Held;
use super::warnings::Warnings;
use crate::names::as_word;

/// Bytes that are written to a device's control table.
#[derive(Clone, Copy)]
pub(super) struct Write<'a> {
    pub(super) id: u8,
    pub(super) table: &'static Device,
    pub(super) address: u16,
    pub(super) data: &'a [u8],
}

impl Warnings<'_> {
    /// What is wrong with a write.
    pub(super) fn write(&mut self, write: Write<'_>, held: &mut Held) {
        let Write { id, table, address, data } = write;
        if data.is_empty() {
            return;
        }
        self.table = Some(table);
        let mut locked = false;
        for row in held.touched(table, address, data.len()) {
            let (name, size) = (row.name, usize::from(row.kind.size()));
            if row.access == Access::ReadOnly {
                let text = format!("{name} is read-only");
                self.add(&["table.read-only", "status-packet.error.write-access"], text);
                continue;
            }
            // One register tells it for all.
            if row.area == Area::Eeprom
                && !locked
                && let Some(lock) = held.lock(id, table)
            {
                locked = true;
                let text = format!("{name} is in the EEPROM area, and {} was seen on", lock.name);
                let rules =
                    ["table.eeprom-lock", "torque-enable.lock", "status-packet.error.locked"];
                self.add(&rules, text);
            }
            let from = row.address.checked_sub(address).map(usize::from);
            if let Some(bytes) = from.and_then(|from| data.get(from..from + size)) {
                self.value(row, bytes, &|address| held.value(id, address));
            } else {
                let text = format!("{name} has {size} bytes, and not all of them are written");
                self.add(&["table.size", "status-packet.error.data-length"], text);
            }
        }
    }

    /// What is wrong with a register's value.
    fn value(&mut self, row: &Row, bytes: &[u8], held: &dyn Fn(u16) -> Option<i64>) {
        let Some(value) = row.decode(bytes) else { return };
        // Another range may apply.
        if row.meanings.iter().any(|meaning| held(meaning.when.address).is_none()) {
            return;
        }
        let Err(error) = row.check(value, held) else { return };
        // Where the documents disagree on a range, only a value without a name is warned of.
        if !row.settled && (row.values.is_empty() || row.value_name(value).is_some()) {
            return;
        }
        let limit = match error {
            RegisterError::OutOfRange { limit: Some(address), .. } => {
                self.table.and_then(|table| table.register(address))
            }
            _ => None,
        };
        if let Some(limit) = limit {
            let rule = format!("{}.error", as_word(limit.name));
            let text = format!("{error}, by {}", limit.name);
            self.add(&[&rule, "status-packet.error.data-limit"], text);
        } else {
            let name = as_word(row.name);
            let (range, values) = (format!("{name}.range"), format!("{name}.values"));
            self.add(&[&range, &values, "status-packet.error.data-range"], error.to_string());
        }
    }
}
