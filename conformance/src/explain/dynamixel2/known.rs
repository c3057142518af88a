//! The registers of a control table by address, as they are looked up for every packet.

use actucheck_codec::register::{Bound, Device, Range, Row};

/// A control table.
pub(super) struct Known {
    registers: &'static [&'static Row],
    /// For each address, the index of the first register that has this byte or a later one.
    first: Vec<usize>,
    /// For each address, whether the table refers to the register there.
    referred: Vec<bool>,
}

impl Known {
    pub(super) fn of(table: &'static Device) -> Self {
        let registers = table.registers;
        let mut first = Vec::new();
        for (index, row) in registers.iter().enumerate() {
            first.resize(end(row).max(first.len()), index);
        }
        let mut referred = vec![false; first.len()];
        for address in referred_by(table) {
            if let Some(referred) = referred.get_mut(usize::from(address)) {
                *referred = true;
            }
        }
        Self { registers, first, referred }
    }

    /// The registers that have some of the bytes from `address` on.
    pub(super) fn touched(
        &self,
        address: u16,
        length: usize,
    ) -> impl Iterator<Item = &'static Row> + use<> {
        let end = usize::from(address) + length;
        let first = self.first.get(usize::from(address));
        let rows = first.and_then(|first| self.registers.get(*first..)).unwrap_or_default();
        rows.iter().copied().take_while(move |row| usize::from(row.address) < end)
    }

    /// The registers to which the table refers itself, of those that lie wholly within some bytes.
    pub(super) fn referred(
        &self,
        address: u16,
        length: usize,
    ) -> impl Iterator<Item = &'static Row> {
        let is_referred = |row: &Row| self.referred.get(usize::from(row.address)) == Some(&true);
        let last = usize::from(address) + length;
        self.touched(address, length)
            .filter(move |row| row.address >= address && end(row) <= last && is_referred(row))
    }
}

/// The address after a register.
fn end(row: &Row) -> usize {
    usize::from(row.address) + usize::from(row.kind.size())
}

/// The addresses of registers on which rules about others depend.
fn referred_by(table: &Device) -> Vec<u16> {
    let bounds = |range: Range| match range {
        Range::Between { min, max } => [Some(min), Some(max)],
        Range::Any | Range::OneOf(_) => [None, None],
    };
    let mut addresses: Vec<_> = table.eeprom_lock.into_iter().collect();
    for row in table.registers {
        let ranges = row.meanings.iter().filter_map(|meaning| meaning.range);
        for bound in ranges.chain([row.range]).flat_map(bounds).flatten() {
            if let Bound::Register { address, .. } = bound {
                addresses.push(address);
            }
        }
        addresses.extend(row.meanings.iter().map(|meaning| meaning.when.address));
    }
    addresses
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::device::KNOWN;

    #[test]
    fn the_registers_of_some_bytes_are_those_of_a_walk_through_the_table() {
        for table in KNOWN {
            let known = Known::of(table);
            let referred = referred_by(table);
            for (address, length) in (0..800).flat_map(|at| [1, 2, 4, 30].map(|size| (at, size))) {
                let bytes = usize::from(address)..usize::from(address) + length;
                let all = || table.registers.iter().copied();
                let has =
                    |row: &&Row| usize::from(row.address) < bytes.end && bytes.start < end(row);
                assert!(known.touched(address, length).eq(all().filter(has)), "{bytes:?}");
                let within = |row: &&Row| row.address >= address && end(row) <= bytes.end;
                let whole = all().filter(within).filter(|row| referred.contains(&row.address));
                assert!(known.referred(address, length).eq(whole), "{bytes:?}");
            }
        }
    }
}
