//! The mistakes that may explain bytes that are no packet.
//!
//! A wire lists the mistakes that senders and lines make, the likeliest first. A mistake fits if the
//! bytes would be a packet without it, which the reference model decides. None is certain: a CRC of 16
//! bits fits by chance once in 65,536 trials, so a mistake that has many ways is listed after those
//! that have few, and its words say how often it fits by chance.

mod answer;
mod crc;
pub(super) mod name;
mod text;

use std::fmt;

use actucheck_spec::wire::{Context, Direction, Wire};
use schemars::JsonSchema;
use serde::Serialize;

use super::Own;
use super::diff::spaced;

pub use self::answer::of_answer;
pub(super) use self::crc::ALGORITHMS;
use self::text::TEXT;

/// Longest run of bytes that is looked at: that of the longest packet.
const LONGEST: usize = 66 << 10;
/// Conditions of one mistake that are told.
const TOLD: usize = 3;
/// Trials of a mistake that is no search over all bytes, at most.
const FEW: u32 = 64;
/// Trials from which a fit by chance is worth a word: 1 in 100 wrong packets.
const MANY: u32 = CRCS / 100;
/// Numbers that a CRC of 16 bits has.
const CRCS: u32 = 1 << 16;

/// A mistake, and what must hold if it explains the bytes.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Fit {
    /// The mistake.
    pub mistake: &'static str,
    /// What must hold, in words: one of these. At most three are here. Of places that lead to the same
    /// packet, such as those of equal bytes in a row, only the first is told.
    pub conditions: Vec<String>,
    /// How many more there are.
    pub more: usize,
    /// How many were tried. Where a CRC decides, one in 65,536 trials fits by chance; where other bytes
    /// do, such as a length, their number says little.
    pub trials: u32,
    /// The packets that were meant, where they are known.
    #[serde(skip)]
    pub meant: Vec<Vec<u8>>,
}

/// Tries a mistake on bytes.
type Find = fn(&[u8], &mut Trials<'_>);

/// A mistake that may explain bytes.
pub(super) struct Mistake {
    name: &'static str,
    /// Whether a program makes it, not a line.
    by_program: bool,
    find: Find,
}

impl Mistake {
    /// One that a program makes.
    pub(super) const fn of_program(name: &'static str, find: Find) -> Self {
        Self { name, by_program: true, find }
    }

    /// One that a line makes, or who copies bytes.
    pub(super) const fn of_line(name: &'static str, find: Find) -> Self {
        Self { name, by_program: false, find }
    }

    /// Whether it fits bytes. `known` are the packets that likelier mistakes lead to.
    fn fit(&self, bytes: &[u8], is_packet: &dyn Fn(&[u8]) -> bool, known: &[Fit]) -> Option<Fit> {
        let mut trials = Trials { is_packet, count: 0, fits: Vec::new() };
        (self.find)(bytes, &mut trials);
        let Trials { count, mut fits, .. } = trials;
        if count > FEW {
            let known = |meant: &Vec<u8>| known.iter().any(|fit| fit.meant.contains(meant));
            fits.retain(|(meant, _)| !meant.as_ref().is_some_and(known));
        }
        let more = fits.len().saturating_sub(TOLD);
        let (meant, mut conditions): (Vec<_>, Vec<_>) = fits.into_iter().unzip();
        conditions.truncate(TOLD);
        let meant = meant.into_iter().flatten().collect();
        let fit = Fit { mistake: self.name, conditions, more, trials: count, meant };
        (!fit.conditions.is_empty()).then_some(fit)
    }
}

/// The trials of one mistake.
pub(super) struct Trials<'a> {
    is_packet: &'a dyn Fn(&[u8]) -> bool,
    count: u32,
    fits: Vec<(Option<Vec<u8>>, String)>,
}

impl Trials<'_> {
    /// Fits if `meant` is a packet.
    pub(super) fn packet(&mut self, meant: Vec<u8>, condition: impl FnOnce() -> String) {
        self.packet_if(true, meant, condition);
    }

    /// Fits if `holds`, and `meant` is a packet.
    pub(super) fn packet_if(
        &mut self,
        holds: bool,
        meant: Vec<u8>,
        condition: impl FnOnce() -> String,
    ) {
        self.count += 1;
        let known = |(other, _): &(Option<Vec<u8>>, _)| other.as_ref() == Some(&meant);
        if holds && !self.fits.iter().any(known) && (self.is_packet)(&meant) {
            self.fits.push((Some(meant), condition()));
        }
    }

    /// Tries a number as the CRC, its low byte first, then its high byte.
    pub(super) fn crc(
        &mut self,
        sent: [u8; 2],
        number: u16,
        right: u16,
        meant: &[u8],
        condition: &str,
    ) {
        // The right one is another mistake's.
        if number == right {
            return;
        }
        self.count += 2;
        let order = if sent == number.to_le_bytes() {
            ""
        } else if sent == number.to_be_bytes() {
            ", and its two bytes are swapped"
        } else {
            return;
        };
        // Each number that fits is told, though all lead to the same packet.
        if (self.is_packet)(meant) {
            self.fits.push((Some(meant.to_vec()), format!("{condition}{order}")));
        }
    }

    /// Without each of the bytes but the last: without that it is a packet with a byte after it.
    pub(super) fn without_each(&mut self, bytes: &[u8]) {
        for (at, byte) in bytes.iter().enumerate().take(bytes.len().saturating_sub(1)) {
            let mut meant = bytes.to_vec();
            meant.remove(at);
            self.packet(meant, || format!("byte {at}, {byte:02X}, is one too many"));
        }
    }

    /// A packet, and what comes after it.
    pub(super) fn without_end(&mut self, packet: &[u8], after: &[u8]) {
        let condition = || match after.len() {
            1 => "the last byte is no part of it".to_owned(),
            count => format!("the last {count} bytes are no part of it"),
        };
        self.packet_if(!after.is_empty(), packet.to_vec(), condition);
    }

    /// Fits if `example`, which differs from the packet that was meant, is a packet too.
    pub(super) fn like(&mut self, example: &[u8], condition: &str) {
        self.count += 1;
        if (self.is_packet)(example) {
            self.fits.push((None, condition.to_owned()));
        }
    }

    /// Fits, though the packet that was meant is not known.
    pub(super) fn fits(&mut self, condition: String) {
        self.count += 1;
        self.fits.push((None, condition));
    }

    /// Says how many ways there are, if a search leaves out what can't fit.
    pub(super) fn ways(&mut self, count: usize) {
        self.count = u32::try_from(count).unwrap_or(u32::MAX);
    }
}

/// The mistakes that fit these bytes, the likeliest first. None for a packet, and for bytes that look
/// like none.
#[must_use]
pub fn fits(wire: Wire, bytes: &[u8], context: &Context) -> Vec<Fit> {
    let Some(own) = Own::of(wire) else { return Vec::new() };
    let is_packet = |bytes: &[u8]| is_packet(wire, bytes, context);
    if bytes.len() > LONGEST || is_packet(bytes) {
        return Vec::new();
    }
    let mut found: Vec<Fit> = Vec::new();
    for mistake in own.mistakes.iter().chain([&TEXT]) {
        found.extend(mistake.fit(bytes, &is_packet, &found));
    }
    found
}

/// Whether the reference model finds one whole packet; of any direction if that is not known.
fn is_packet(wire: Wire, bytes: &[u8], context: &Context) -> bool {
    let is = |context: &Context| wire.decode(bytes, context).is_ok();
    if context.direction.is_some() || wire.tells_direction() {
        return is(context);
    }
    Direction::ALL.into_iter().any(|direction| is(&direction.into()))
}

impl fmt::Display for Fit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("fits if ")?;
        let last = self.conditions.len().saturating_sub(1);
        for (index, condition) in self.conditions.iter().enumerate() {
            let between = match index {
                0 => "",
                _ if index == last && self.more == 0 => ", or ",
                _ => ", ",
            };
            write!(f, "{between}{condition}")?;
        }
        match self.more {
            0 => {}
            1 => f.write_str(", or in 1 more way")?,
            more => write!(f, ", or in one of {more} more ways")?,
        }
        match (self.trials, CRCS / self.trials.max(1)) {
            (..MANY, _) => Ok(()),
            (trials, 0 | 1) => {
                let chance = (trials + CRCS / 2) / CRCS;
                write!(f, " ({trials} were tried, so about {chance} fit by chance)")
            }
            (trials, one) => {
                write!(f, " ({trials} were tried, so 1 in {one} wrong packets fits by chance)")
            }
        }
    }
}

/// Bytes as they are named in a condition.
pub(super) fn hex(bytes: &[u8]) -> String {
    spaced(bytes).to_uppercase()
}

/// `2 less` or `1 more`, from one number to another.
pub(super) fn difference(number: usize, other: usize) -> String {
    let word = if number < other { "less" } else { "more" };
    format!("{} {word}", number.abs_diff(other))
}
