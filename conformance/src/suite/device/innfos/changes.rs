//! What any requests may write to an actuator: values that do nothing by themselves while the power is off.

use actucheck_spec::Spec;
use actucheck_spec::wire::innfos::{Command, Format};

use super::writes::{POWER, pairs, values};

/// What a number may lack in its lowest bits, as an actuator may hold it as a float of 24 bits.
const FINE: i64 = 1 << 8;

/// A value that may be written, whatever others are.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    /// The command that writes it, and the one that reads it.
    pub(crate) write: u8,
    /// See `write`.
    pub(crate) read: u8,
    /// How many bytes it has.
    pub(crate) size: usize,
    /// The smallest number that is written, signed.
    pub(crate) min: i64,
    /// The largest.
    pub(crate) max: i64,
    /// Whether numbers between them are told again as they were written.
    pub(crate) has_others: bool,
    /// The requirement that says that it is told again.
    pub(super) told: &'static str,
}

/// The values that may be written.
pub(crate) fn places(spec: &Spec) -> Vec<Place> {
    pairs(spec).filter_map(place).collect()
}

/// The value that a command writes, if it may be written.
pub(super) fn place_of(spec: &Spec, command: u8) -> Option<Place> {
    pairs(spec).filter(|(write, _)| write.code == command).find_map(place)
}

fn place((write, read): (&Command, &Command)) -> Option<Place> {
    if write.name == POWER {
        return None;
    }
    let (told, ends) = values(write)?;
    let numbers = || ends.iter().map(|bytes| number(bytes));
    Some(Place {
        write: write.code,
        read: read.code,
        size: ends.first()?.len(),
        min: numbers().min()?,
        max: numbers().max()?,
        has_others: write.format != Some(Format::Scaled),
        told,
    })
}

impl Place {
    /// A number as it is written: one of the ends, or the next that may be between them.
    pub(crate) fn bytes(&self, number: i64) -> Vec<u8> {
        let is_end = number == self.min || number == self.max;
        let fine = if self.size > 2 && !is_end { FINE } else { 1 };
        let bytes = (number - number.rem_euclid(fine)).to_be_bytes();
        bytes.iter().skip(bytes.len().saturating_sub(self.size)).copied().collect()
    }

    /// Whether these bytes may be written.
    pub(super) fn takes(&self, bytes: &[u8]) -> bool {
        let number = number(bytes);
        let is_between = self.has_others && (self.min..=self.max).contains(&number);
        bytes.len() == self.size
            && (is_between || number == self.min || number == self.max)
            && self.bytes(number) == bytes
    }
}

/// A signed number, high byte first; a single byte is a flag, and never negative.
fn number(bytes: &[u8]) -> i64 {
    let sign = bytes.first().is_some_and(|first| first & 0x80 != 0 && bytes.len() > 1);
    bytes.iter().fold(if sign { -1 } else { 0 }, |number, byte| (number << 8) | i64::from(*byte))
}
