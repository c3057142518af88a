//! Instructions that read from several devices: alone, with a neighbour, and with one that is missing.

use actucheck_spec::wire::Fast;
use actucheck_spec::wire::dynamixel2::Packet;
use actucheck_spec::wire::dynamixel2::WIRE;

use super::{BROADCAST, Talk, asked, basic, code, error, instruction, named};
use crate::adapter::Asked;
use crate::suite::check::Check;
use crate::suite::wanted::{Like, Part};

/// How many devices long packets name.
const MANY: [usize; 3] = [16, 64, 240];

/// An instruction that reads from several devices.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Kind {
    Sync,
    FastSync,
    Bulk,
}

impl Kind {
    pub(super) const ALL: [Self; 3] = [Self::Sync, Self::FastSync, Self::Bulk];

    const fn name(self) -> &'static str {
        match self {
            Self::Sync => "Sync Read",
            Self::FastSync => "Fast Sync Read",
            Self::Bulk => "Bulk Read",
        }
    }

    pub(super) fn word(self) -> String {
        super::word(self.name())
    }

    /// The requirements that say this of it, or else what it does.
    pub(super) fn rows(self, what: &str) -> Vec<String> {
        let all = [what, "status", "effect"];
        all.map(|what| format!("{}.{what}", self.word())).to_vec()
    }

    pub(super) const fn code(self) -> u8 {
        match self {
            Self::Sync => code::SYNC_READ,
            Self::FastSync => code::FAST_SYNC_READ,
            Self::Bulk => code::BULK_READ,
        }
    }

    /// The same registers of each device.
    fn packet(self, to: u8, ids: &[u8], (address, size): (u16, u16)) -> Packet {
        let range = [address, size].map(u16::to_le_bytes).concat();
        let params = match self {
            Self::Sync | Self::FastSync => [range.as_slice(), ids].concat(),
            Self::Bulk => ids.iter().flat_map(|id| [&[*id][..], &range].concat()).collect(),
        };
        instruction(to, self.code(), params)
    }

    /// It, and the answers of those that are there.
    pub(super) fn asked(self, ids: &[u8], range: (u16, u16), present: usize) -> Asked {
        let packet = self.packet(BROADCAST, ids, range);
        match self {
            Self::Sync | Self::Bulk => asked(packet, present),
            Self::FastSync => {
                let fast = Fast { length: range.1, ids: ids.to_vec() };
                Asked { fast: Some(fast), ..asked(packet, 1) }
            }
        }
    }
}

/// The instructions that the device has, of it alone.
pub(super) fn basics(talk: &Talk<'_>, address: u16, size: u16) -> Vec<Check> {
    let check = |kind: Kind| {
        talk.check(
            basic(WIRE, &kind.word()),
            &kind.rows("status"),
            vec![kind.asked(&[talk.id()], (address, size), 1)],
            vec![vec![vec![data(talk.id(), size)]]],
        )
    };
    own(talk).map(check).collect()
}

/// The instructions that the device has, if a document says what they do.
pub(super) fn own<'t>(talk: &'t Talk<'_>) -> impl Iterator<Item = Kind> + use<'t> {
    let has = |kind: &Kind| talk.knows(kind.name()) && talk.row(&kind.rows("status")).is_some();
    Kind::ALL.into_iter().filter(move |kind| has(kind))
}

/// So many bytes of a device.
fn data(id: u8, size: u16) -> Like {
    Like { id, error: Some(error::NONE), data: Some(vec![Part::Any(size.into())]) }
}

pub(super) fn checks(talk: &Talk<'_>) -> Vec<Check> {
    let Some(register) = talk.target.device.and_then(|device| device.registers.first()) else {
        return Vec::new();
    };
    let range = (register.address, register.kind.size());
    own(talk).flat_map(|kind| of_kind(talk, kind, range)).collect()
}

/// How it answers a long packet that names it first, and others that are not there. How long a packet it must take is
/// nowhere said, so it is recorded. The shared answer of a Fast Sync Read would have no end.
fn many(talk: &Talk<'_>, kind: Kind, range: (u16, u16), count: usize) -> Option<Check> {
    let others = super::super::ids(WIRE).filter(|id| !talk.target.present.contains(id));
    let ids: Vec<u8> = [talk.id()].into_iter().chain(others).take(count).collect();
    let packet = kind.packet(BROADCAST, &ids, range);
    (kind != Kind::FastSync).then(|| {
        talk.record(
            named(&format!("several.{}.of-{count}/answer", kind.word())),
            &kind.rows("parameters"),
            vec![talk.packet_then_ping(packet)],
            &format!("How does it answer a {} of {count} devices?", kind.name()),
        )
    })
}

fn of_kind(talk: &Talk<'_>, kind: Kind, range: (u16, u16)) -> Vec<Check> {
    let (id, absent, word, size) = (talk.id(), talk.absent(), kind.word(), range.1);
    let silence = talk.check(
        named(&format!("several.{word}.not-named/silence")),
        &kind.rows("silence"),
        vec![talk.packet_then_ping(kind.packet(BROADCAST, &[absent], range))],
        vec![vec![vec![talk.pong()]]],
    );
    let missing = talk.record(
        named(&format!("several.{word}.after-missing/answer")),
        &kind.rows("order"),
        vec![talk.packet_then_ping(kind.packet(BROADCAST, &[absent, id], range))],
        &format!("What does it do in a {} after a device that is missing?", kind.name()),
    );
    let own_id = talk.record(
        named(&format!("several.{word}.own-id/answer")),
        &kind.rows("broadcast-id"),
        vec![talk.packet_then_ping(kind.packet(id, &[id], range))],
        &format!("How does it answer a {} to its own ID?", kind.name()),
    );
    let many = MANY.map(|count| many(talk, kind, range, count));
    let part = Part::Same { step: 0, from: 0, count: size.into() };
    let as_read = talk.check(
        named(&format!("several.{word}.as-read/data")),
        &kind.rows("same-registers"),
        vec![asked(talk.read(range.0, size), 1), kind.asked(&[id], range, 1)],
        vec![vec![vec![data(id, size)]], vec![vec![talk.done(part)]]],
    );
    let mut checks = vec![silence, missing, own_id, as_read];
    checks.extend(many.into_iter().flatten());
    let Some(neighbour) = talk.neighbour_with(kind.name()) else { return checks };
    for (name, ids) in [("first", [id, neighbour]), ("second", [neighbour, id])] {
        checks.push(talk.check(
            named(&format!("several.{word}.{name}-of-two/order")),
            &kind.rows("order"),
            vec![kind.asked(&ids, range, 2)],
            vec![vec![ids.map(|id| data(id, size)).to_vec()]],
        ));
    }
    checks.push(talk.check(
        named(&format!("several.{word}.neighbour-alone/silence")),
        &kind.rows("silence"),
        vec![kind.asked(&[neighbour], range, 1), asked(talk.ping(), 1)],
        vec![vec![vec![data(neighbour, size)]], vec![vec![talk.pong()]]],
    ));
    checks
}
