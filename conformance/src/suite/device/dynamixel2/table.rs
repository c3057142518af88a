//! The control table: every register can be read, and some hold what the document says.

use actucheck_spec::model::{Area, Device, Register};

use super::{Talk, asked, named, word};
use crate::adapter::Bits;
use crate::suite::check::Check;
use crate::suite::wanted::Part;

/// Bits of a register that hold one of some values, whatever the device does.
struct Held {
    /// The document that says so.
    document: &'static str,
    register: &'static str,
    /// What the check is called after the register.
    name: &'static str,
    requirement: &'static str,
    lowest: u8,
    width: u8,
    one_of: &'static [u64],
}

impl Held {
    const fn new(
        document: &'static str,
        (register, name): (&'static str, &'static str),
        requirement: &'static str,
        (lowest, width): (u8, u8),
        one_of: &'static [u64],
    ) -> Self {
        Self { document, register, name, requirement, lowest, width, one_of }
    }

    /// What a register of so many bytes holds.
    fn part(&self, size: u16) -> Part {
        let (lowest, width, one_of) = (self.lowest, self.width, self.one_of.to_vec());
        Part::Bits { size: size.into(), has: Bits { lowest, width, one_of } }
    }
}

const DRIVE_MODE: (&str, &str) = ("Drive Mode", "bits");
const UNUSED: &str = "drive-mode.unused-bits";
const MOVING_STATUS: (&str, &str) = ("Moving Status", "bits");
const PROFILE: &str = "moving-status.profile";
const TICK: (&str, &str) = ("Realtime Tick", "bits");
const TICKS: &str = "realtime-tick.value";
const BACKUP: (&str, &str) = ("Backup Ready", "value");
const BACKUP_READY: &str = "backup.ready";
const ALARMS: &str = "Hardware Error Status";
const NO_ALARM: &str = "hardware-error.unused-bits";

const HELD: [Held; 12] = [
    Held::new("ja40", BACKUP, BACKUP_READY, (0, 8), &[0, 1]),
    Held::new("ja-variant", BACKUP, BACKUP_READY, (0, 8), &[0, 1]),
    Held::new("ja40", DRIVE_MODE, UNUSED, (3, 5), &[0]),
    Held::new("ja-variant", DRIVE_MODE, UNUSED, (2, 6), &[0]),
    Held::new("ja40", MOVING_STATUS, PROFILE, (4, 2), &[0, 1, 3]),
    Held::new("ja-variant", MOVING_STATUS, PROFILE, (4, 2), &[0, 1, 3]),
    // The highest bit of 32,767 is bit 14.
    Held::new("ja40", TICK, TICKS, (15, 1), &[0]),
    Held::new("ja-variant", TICK, TICKS, (15, 1), &[0]),
    Held::new("ja40", (ALARMS, "bit-0"), NO_ALARM, (0, 1), &[0]),
    Held::new("ja40", (ALARMS, "bit-4"), NO_ALARM, (4, 1), &[0]),
    Held::new("ja-variant", (ALARMS, "bit-0"), NO_ALARM, (0, 1), &[0]),
    Held::new("ja-variant", (ALARMS, "bit-1"), NO_ALARM, (1, 1), &[0]),
];

pub(super) fn checks(talk: &Talk<'_>) -> Vec<Check> {
    let Some(device) = talk.target.device else { return Vec::new() };
    let registers = device.registers.iter().map(|register| readable(talk, register));
    let whole = [longest(talk, device), neighbours(talk, device), part(talk, device)];
    registers.chain(whole.into_iter().flatten()).chain(held(talk)).collect()
}

fn readable(talk: &Talk<'_>, register: &Register) -> Check {
    let size = register.kind.size();
    let table = match register.area {
        Area::Eeprom => "table.registers",
        Area::Ram => "table.ram-registers",
    };
    talk.check(
        named(&format!("table.{}/read", word(&register.name))),
        &[table, "read.status"],
        vec![asked(talk.read(register.address, size), 1)],
        vec![vec![vec![talk.done(Part::Any(size.into()))]]],
    )
}

/// The most neighbouring registers, in one Read.
fn longest(talk: &Talk<'_>, device: &Device) -> Option<Check> {
    let mut runs: Vec<(u16, u16)> = Vec::new();
    for register in &device.registers {
        let size = register.kind.size();
        match runs.last_mut() {
            Some((start, length)) if *start + *length == register.address => *length += size,
            _ => runs.push((register.address, size)),
        }
    }
    let (address, length) = runs.into_iter().max_by_key(|(_, length)| *length)?;
    Some(talk.check(
        named("table.longest-run/read"),
        &["read.status"],
        vec![asked(talk.read(address, length), 1)],
        vec![vec![vec![talk.done(Part::Any(length.into()))]]],
    ))
}

/// Two registers of the EEPROM area that are neighbours, in one Read and the second alone.
fn neighbours(talk: &Talk<'_>, device: &Device) -> Option<Check> {
    let mut pairs = device.registers.iter().zip(device.registers.iter().skip(1));
    let (first, second) = pairs.find(|(first, second)| {
        second.area == Area::Eeprom && first.address + first.kind.size() == second.address
    })?;
    let (from, count) = (first.kind.size(), second.kind.size());
    let part = Part::Same { step: 0, from: from.into(), count: count.into() };
    Some(talk.check(
        named("table.neighbours/order"),
        &["read.status"],
        vec![
            asked(talk.read(first.address, from + count), 1),
            asked(talk.read(second.address, count), 1),
        ],
        vec![vec![vec![talk.done(Part::Any((from + count).into()))]], vec![vec![talk.done(part)]]],
    ))
}

/// A byte out of the middle of a register.
fn part(talk: &Talk<'_>, device: &Device) -> Option<Check> {
    let register = device.registers.iter().find(|register| register.kind.size() == 4)?;
    let read = talk.read(register.address + 1, 1);
    Some(talk.record(
        named("table.part-of-a-register/read"),
        &["read.parameters"],
        vec![talk.packet_then_ping(read)],
        "How does it answer a Read of one byte within a register?",
    ))
}

fn held(talk: &Talk<'_>) -> Vec<Check> {
    let document = talk.document();
    let own = HELD.iter().filter(|held| document == Some(held.document));
    own.filter_map(|held| has_bits(talk, held)).collect()
}

/// What a register must hold, if the document says so of some of its bits.
pub(super) fn bits(talk: &Talk<'_>, register: &Register) -> Option<Part> {
    let document = talk.document();
    let is_own = |held: &&Held| document == Some(held.document) && held.register == register.name;
    HELD.iter().find(is_own).map(|held| held.part(register.kind.size()))
}

fn has_bits(talk: &Talk<'_>, held: &Held) -> Option<Check> {
    let register = talk.target.device?.register(held.register)?;
    let size = register.kind.size();
    let part = held.part(size);
    Some(talk.check(
        named(&format!("table.{}/{}", word(held.register), held.name)),
        &[held.requirement],
        vec![asked(talk.read(register.address, size), 1)],
        vec![vec![vec![talk.done(part)]]],
    ))
}
