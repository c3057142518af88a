//! What a device's registers hold.

use std::ops::Range;
use std::sync::Arc;

use actucheck_codec::dynamixel2::ErrorNumber;
use actucheck_codec::register::{Access, Area, Bound, Range as Limits, Row};

use super::model::{self, Model};
use super::readings::{LimitRange, OpenRanges};
use super::shaft::mode;

/// The Status Return Level of devices that answer every instruction.
const ANSWERS_ALL: i64 = 2;

/// A control table with values.
#[derive(Clone, Debug)]
pub(super) struct Memory {
    model: Arc<Model>,
    bytes: Vec<u8>,
}

impl Memory {
    /// All registers with their initial values.
    pub(super) fn new(model: Arc<Model>) -> Self {
        let bytes = vec![0; model.size()];
        let mut memory = Self { model, bytes };
        memory.reset(|_| true);
        memory
    }

    /// Gives registers their initial values. What hosts can't write and no document states is no
    /// setting but a fact or a measurement, and stays.
    ///
    /// Where a document states none it is 0, or what is nearest to it within the register's range. A
    /// goal between a limit and its negative begins at the limit: with 0 the device would never move.
    pub(super) fn reset(&mut self, which: impl Fn(&Row) -> bool) {
        let is_setting = |row: &Row| row.access == Access::ReadWrite || row.initial.is_some();
        for row in self.model.table.registers.iter().filter(|row| is_setting(row) && which(row)) {
            self.put(row, row.initial.unwrap_or_else(|| self.unstated(row)));
        }
        if let (Some(row), Some(number)) =
            (self.model.roles.model_number, self.model.table.model_number)
        {
            self.put(row, number.into());
        }
    }

    /// The initial value of a register for which the documents state none. A device that answers
    /// nothing, or is in a mode that is not told, is no use to anybody.
    fn unstated(&self, row: &Row) -> i64 {
        let (min, max) = row.bounds(|address| self.at(address));
        let is_both_ways =
            matches!(row.range, Limits::Between { min: Bound::Register { negated: true, .. }, .. });
        let value = match row.name {
            "Status Return Level" => ANSWERS_ALL,
            "Operating Mode" => mode::POSITION,
            name if name.starts_with("Goal") && is_both_ways => max,
            _ => 0,
        };
        value.clamp(min, max.max(min))
    }

    /// What a register holds.
    pub(super) fn value(&self, row: &Row) -> i64 {
        let bytes = self.bytes.get(usize::from(row.address)..model::end(row));
        bytes.and_then(|bytes| row.decode(bytes)).unwrap_or_default()
    }

    /// What a register holds, if the device has it.
    pub(super) fn get(&self, row: Option<&Row>) -> Option<i64> {
        row.map(|row| self.value(row))
    }

    /// What the register at an address holds.
    fn at(&self, address: u16) -> Option<i64> {
        self.get(self.model.table.register(address))
    }

    /// Sets a register, whoever may write it. A value that it can't hold becomes the nearest.
    pub(super) fn put(&mut self, row: &Row, value: i64) {
        let (min, max) = row.kind.limits();
        let value = value.clamp(min, max).to_le_bytes();
        if let Some(bytes) = self.bytes.get_mut(usize::from(row.address)..model::end(row)) {
            let size = bytes.len();
            bytes.copy_from_slice(value.get(..size).unwrap_or_default());
        }
    }

    /// Sets a register if the device has it.
    pub(super) fn set(&mut self, row: Option<&Row>, value: i64) {
        if let Some(row) = row {
            self.put(row, value);
        }
    }

    /// The value of a register in the unit of one count; `None` if the device has no such register.
    pub(super) fn physical(&self, row: Option<&'static Row>) -> Option<(f64, &'static str)> {
        let row = row?;
        let unit = row.unit_while(|address| self.at(address))?;
        #[allow(clippy::cast_precision_loss)] // no register has more than 32 bits
        let value = self.value(row) as f64;
        Some((value * unit.factor, unit.symbol))
    }

    /// Sets a register to an amount in the unit of its count.
    pub(super) fn put_physical(&mut self, row: Option<&'static Row>, amount: f64) {
        if let Some((row, count)) = row.and_then(|row| Some((row, row.from_physical(amount)?))) {
            self.put(row, count);
        }
    }

    /// The bytes at addresses that all have a register.
    pub(super) fn read(&self, address: u16, length: u16) -> Result<Vec<u8>, ErrorNumber> {
        let mut read = Vec::new();
        for place in self.runs(address, length.into())? {
            let bytes = self.bytes.get(place.clone()).filter(|_| self.model.has(place));
            read.extend_from_slice(bytes.ok_or(ErrorNumber::AccessError)?);
        }
        Ok(read)
    }

    /// The addresses that addresses of the control table stand for.
    fn runs(&self, address: u16, length: usize) -> Result<Vec<Range<usize>>, ErrorNumber> {
        let place = place(address, length);
        if place.end > self.model.size() {
            return Err(ErrorNumber::AccessError);
        }
        Ok(self.model.indirect.runs(place, |row| self.value(row)))
    }

    /// Sets bytes, whoever may write them.
    pub(super) fn preset(&mut self, address: u16, data: &[u8]) {
        self.replace(place(address, data.len()), data);
    }

    /// Whether registers hold these bytes, and hosts may have written them where they may write at all.
    pub(super) fn holds(&self, address: u16, data: &[u8]) -> bool {
        let place = place(address, data.len());
        let may_hold = |row: &&Row| row.access == Access::ReadOnly || self.judge(row).is_ok();
        let length = u16::try_from(data.len()).unwrap_or(u16::MAX);
        self.read(address, length).is_ok_and(|held| held == data)
            && self.model.rows(&place).iter().all(may_hold)
    }

    /// Writes whole registers, all of them or none.
    pub(super) fn write(&mut self, address: u16, data: &[u8]) -> Result<(), ErrorNumber> {
        let runs = self.runs(address, data.len())?;
        let before = (runs.len() > 1).then(|| self.bytes.clone());
        let mut rest = data;
        for run in runs {
            let (these, others) = rest.split_at_checked(run.len()).unwrap_or_default();
            rest = others;
            if let Err(error) = self.write_run(run, these) {
                if let Some(before) = before {
                    self.bytes = before;
                }
                return Err(error);
            }
        }
        Ok(())
    }

    /// Writes registers that are next to each other. If several things are wrong, an address or the lock
    /// counts first, then the length, then the values in their order.
    fn write_run(&mut self, place: Range<usize>, data: &[u8]) -> Result<(), ErrorNumber> {
        let rows = self.model.rows(&place);
        let is_closed = |row: &&Row| row.access == Access::ReadOnly || self.is_locked(row);
        if !self.model.has(place.clone()) || rows.iter().any(is_closed) {
            return Err(ErrorNumber::AccessError);
        }
        let is_cut =
            |row: &&Row| usize::from(row.address) < place.start || model::end(row) > place.end;
        if data.is_empty() || rows.iter().any(is_cut) {
            return Err(ErrorNumber::DataLengthError);
        }
        let before = self.replace(place.clone(), data);
        let refused = rows.iter().find_map(|row| self.judge(row).err());
        if let Some(number) = refused {
            self.replace(place, &before);
            return Err(number);
        }
        self.settle();
        Ok(())
    }

    /// Takes registers back into ranges that other registers have made smaller.
    pub(super) fn settle(&mut self) {
        for row in &Arc::clone(&self.model).bounded {
            let (min, max) = row.bounds(|address| self.at(address));
            if min <= max {
                self.put(row, self.value(row).clamp(min, max));
            }
        }
    }

    /// Whether a write would be carried out.
    pub(super) fn check(&self, address: u16, data: &[u8]) -> Result<(), ErrorNumber> {
        self.clone().write(address, data)
    }

    fn is_locked(&self, row: &Row) -> bool {
        let lock = || self.model.table.eeprom_lock.and_then(|address| self.at(address));
        row.area == Area::Eeprom && lock().is_some_and(|lock| lock != 0)
    }

    /// Whether a register may have the value that it has. If the documents don't settle its range, it
    /// may have each value that they name, or all bits that they name, or only what is printed.
    fn judge(&self, row: &Row) -> Result<(), ErrorNumber> {
        let value = self.value(row);
        let readings = self.model.readings;
        if row.settled || readings.open_ranges == OpenRanges::Printed {
            row.check(value, |address| self.at(address)).map_err(|error| match error.number() {
                ErrorNumber::DataRangeError
                    if row.name.ends_with("Limit")
                        && readings.limit_range == LimitRange::DataLimitError =>
                {
                    ErrorNumber::DataLimitError
                }
                number => number,
            })
        } else if row.value_name(value).is_some()
            || row.values.is_empty() && (row.bits.is_empty() || value & !named(row) == 0)
        {
            Ok(())
        } else {
            Err(ErrorNumber::DataRangeError)
        }
    }

    fn replace(&mut self, place: Range<usize>, data: &[u8]) -> Vec<u8> {
        let Some(bytes) = self.bytes.get_mut(place) else { return Vec::new() };
        let before = bytes.to_vec();
        bytes.iter_mut().zip(data).for_each(|(byte, new)| *byte = *new);
        before
    }
}

/// The bits of a register that have a name.
fn named(row: &Row) -> i64 {
    row.bits.iter().fold(0, |named, bits| named | model::mask(bits.lowest, bits.width))
}

fn place(address: u16, length: usize) -> Range<usize> {
    let start = usize::from(address);
    start..start.saturating_add(length)
}
