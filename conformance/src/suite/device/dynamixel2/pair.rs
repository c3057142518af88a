//! What one packet writes to the device and to its neighbour: to each its own data.

use actucheck_spec::model::{Area, Register};
use actucheck_spec::wire::Fast;
use actucheck_spec::wire::dynamixel2::Packet;

use super::writable::{Writable, bytes, probe, probes, writable};
use super::written::{Step, to_several};
use super::{BROADCAST, Talk, asked, code, error, instruction, named};
use crate::adapter::{Asked, Permission, Permissions, Question};
use crate::suite::Author;
use crate::suite::check::Check;
use crate::suite::device::{Neighbour, Target};
use crate::suite::wanted::Like;

/// An instruction that writes to several devices.
const ALL: [(&str, u8); 3] = [
    ("Sync Write", code::SYNC_WRITE),
    ("Fast Sync Write", code::FAST_SYNC_WRITE),
    ("Bulk Write", code::BULK_WRITE),
];

/// A device and its neighbour, which may be written to.
struct Pair<'t, 'a> {
    talk: &'t Talk<'a>,
    /// What is said to the neighbour.
    other: Talk<'a>,
}

/// What is written to one of them: first one value, and another by the packet that is checked.
struct Block<'a> {
    id: u8,
    register: &'a Register,
    before: Vec<u8>,
    data: Vec<u8>,
}

/// The registers of the neighbour that these checks write to.
pub(in crate::suite::device) fn written_beside<'a>(
    author: Author<'a>,
    target: &Target<'a>,
) -> Vec<&'a Register> {
    let talk = Talk { author, target: target.clone() };
    let Some(pair) = Pair::of(&talk).filter(|pair| pair.given().is_some()) else {
        return Vec::new();
    };
    let blocks = pair.kinds().filter_map(|(_, code)| Some(pair.blocks(code)?.1.register));
    let mut registers: Vec<_> = blocks.collect();
    registers.sort_by_key(|register| register.address);
    registers.dedup_by_key(|register| register.address);
    registers
}

/// Each instruction, with the device named first and second.
pub(super) fn checks(talk: &Talk<'_>) -> Vec<Check> {
    let Some(pair) = Pair::of(talk) else { return Vec::new() };
    let Some(given) = pair.given() else { return Vec::new() };
    let all = pair.kinds().filter_map(|(name, code)| Some((name, code, pair.blocks(code)?)));
    let checks = all.flat_map(|(name, code, (own, other))| {
        let word = super::word(name);
        [("first", [&own, &other]), ("second", [&other, &own])].map(|(place, blocks)| {
            let id = named(&format!("written.{word}.{place}-of-two/data"));
            let begin = [pair.sets(&own), pair.sets(&other)];
            let end = [pair.holds(&own), pair.holds(&other)];
            let written = pair.written(code, blocks);
            let steps = given.iter().cloned().chain(begin).chain([written]).chain(end).collect();
            pair.check(id, &format!("{word}.effect"), steps)
        })
    });
    checks.collect()
}

impl<'t, 'a> Pair<'t, 'a> {
    fn of(talk: &'t Talk<'a>) -> Option<Self> {
        let Neighbour { id, device } = talk.target.neighbour?;
        let present = talk.target.present.clone();
        let target = Target { id, device, neighbour: None, present };
        Some(Self { talk, other: Talk { author: talk.author, target } })
    }

    /// The instructions that both have.
    fn kinds(&self) -> impl Iterator<Item = (&'static str, u8)> {
        ALL.into_iter().filter(|(name, _)| self.talk.knows(name) && self.other.knows(name))
    }

    /// What the neighbour must be for a check that writes to it. `None` if that can't be seen.
    fn given(&self) -> Option<Vec<Step>> {
        let device = self.other.target.device?;
        let model = u64::from(device.model_number?);
        let lock = device.eeprom_lock.as_deref().unwrap_or("Torque Enable");
        let what = "a neighbour of the model that its control table is of";
        let mut steps = vec![
            self.other.given(self.other.register("Model Number")?, what, (0, 16), vec![model]),
            self.other.given(
                self.other.register(lock)?,
                "a neighbour without torque",
                (0, 8),
                vec![0],
            ),
        ];
        if let Some(level) = self.other.register("Status Return Level") {
            let what = "a neighbour that answers every instruction";
            steps.push(self.other.given(level, what, (0, 8), vec![2]));
        }
        Some(steps)
    }

    /// What an instruction writes to the device and to its neighbour: a Bulk Write to registers of another size, the
    /// others to the same.
    fn blocks(&self, code: u8) -> Option<(Block<'a>, Block<'a>)> {
        let (own, other) = match code {
            code::BULK_WRITE => (probe(self.talk)?, self.of_other_size(probe(self.talk)?.size())?),
            _ => self.shared()?,
        };
        let block = |id, one: Writable<'a>, data| Block {
            id,
            register: one.register,
            before: bytes(one.register, one.min),
            data: bytes(one.register, data),
        };
        // Not what the device gets.
        let half = other.min + (other.max - other.min) / 2;
        let data = if half > other.min { half } else { other.max };
        Some((block(self.talk.id(), own, own.max), block(self.other.id(), other, data)))
    }

    /// A register that both have.
    fn shared(&self) -> Option<(Writable<'a>, Writable<'a>)> {
        probes(self.talk).find_map(|own| {
            let is_it = |other: &Writable<'_>| other.register.address == own.register.address;
            Some((own, probes(&self.other).find(is_it)?))
        })
    }

    /// A register of the neighbour that has another size, or else any.
    fn of_other_size(&self, size: usize) -> Option<Writable<'a>> {
        let is_it = |one: &Writable<'_>| {
            one.register.area == Area::Ram
                && one.size() != size
                && !one.register.name.starts_with("Goal ")
        };
        writable(&self.other).into_iter().find(is_it).or_else(|| probe(&self.other))
    }

    const fn talk_to(&self, block: &Block<'_>) -> &Talk<'a> {
        if block.id == self.other.id() { &self.other } else { self.talk }
    }

    fn sets(&self, block: &Block<'_>) -> Step {
        self.talk_to(block).sets(block.register.address, &block.before)
    }

    fn holds(&self, block: &Block<'_>) -> Step {
        self.talk_to(block).holds(block.register.address, block.data.clone())
    }

    /// The packet, with these blocks in this order, and what answers it.
    fn written(&self, code: u8, blocks: [&Block<'_>; 2]) -> Step {
        let packet = packet(code, blocks);
        if code != code::FAST_SYNC_WRITE {
            return self.talk.silent_at(packet);
        }
        let ids = blocks.map(|block| block.id);
        let done = |id| Like { id, error: Some(error::NONE), data: Some(Vec::new()) };
        let fast = Some(Fast { length: 0, ids: ids.to_vec() });
        (Asked { fast, ..asked(packet, 1) }, vec![ids.map(done).to_vec()])
    }

    /// A check that writes to both.
    fn check(&self, id: String, requirement: &str, steps: Vec<Step>) -> Check {
        let ram = Permissions::from([Permission::WriteRam]);
        let mut check = self.talk.demands(ram, id, &[requirement], steps);
        if let Question::Device { neighbour, .. } = &mut check.question {
            *neighbour = Some(self.other.id());
        }
        check
    }
}

fn packet(code: u8, blocks: [&Block<'_>; 2]) -> Packet {
    let [Block { register, .. }, _] = blocks;
    if code != code::BULK_WRITE {
        let blocks = blocks.map(|block| (block.id, &block.data[..]));
        return to_several(code, register.address, &blocks);
    }
    let params = blocks.iter().flat_map(|Block { id, register, data, .. }| {
        let range = [register.address, register.kind.size()].map(u16::to_le_bytes).concat();
        [&[*id][..], &range, data].concat()
    });
    instruction(BROADCAST, code, params.collect())
}
