//! What a Write does: alone, to several devices, to all, and after an Action.

use actucheck_spec::model::Area;
use actucheck_spec::wire::Fast;
use actucheck_spec::wire::dynamixel2::{Packet, WIRE};

use super::writable::{Writable, bytes, needs, probe, writable};
use super::{BROADCAST, Talk, asked, basic, code, error, instruction, named, write};
use crate::adapter::{Asked, Permission, Permissions};
use crate::suite::check::{Check, Demand};
use crate::suite::wanted::{Like, Part, Wanted};

/// Makes a packet of what is written to which device.
type Writes<'a> = dyn Fn(&[(u8, &[u8])]) -> Packet + 'a;

/// A step, and what must come back.
pub(super) type Step = (Asked, Vec<Vec<Like>>);

impl Talk<'_> {
    /// Demands what comes back, step by step, where more than reading is needed.
    pub(super) fn demands(
        &self,
        needs: Permissions,
        id: String,
        requirements: &[impl AsRef<str>],
        steps: Vec<Step>,
    ) -> Check {
        let (steps, wanted) = steps.into_iter().map(|(asked, rows)| (asked, Wanted(rows))).unzip();
        self.asks_with(needs, id, requirements, steps, Demand::Answer(wanted))
    }

    /// A packet that is answered without an error and without data.
    pub(super) fn done_by(&self, packet: Packet) -> Step {
        (asked(packet, 1), vec![vec![self.refusal(error::NONE)]])
    }

    /// A packet that is refused.
    pub(super) fn refused_with(&self, packet: Packet, error: u8) -> Step {
        (asked(packet, 1), vec![vec![self.refusal(error)]])
    }

    /// A packet that nobody answers.
    pub(super) fn silent_at(&self, packet: Packet) -> Step {
        (self.packet_then_ping(packet), vec![vec![self.pong()]])
    }

    /// Bytes that are written.
    pub(super) fn sets(&self, address: u16, data: &[u8]) -> Step {
        self.done_by(write(self.id(), address, data))
    }

    /// Bytes that are read.
    pub(super) fn holds(&self, address: u16, data: Vec<u8>) -> Step {
        let length = u16::try_from(data.len()).unwrap_or(u16::MAX);
        let row = vec![self.done(Part::Bytes(data.into()))];
        (asked(self.read(address, length), 1), vec![row])
    }
}

/// Write, and the instructions that write later.
pub(super) fn basics(talk: &Talk<'_>) -> Vec<Check> {
    let Some(probe) = probe(talk) else { return Vec::new() };
    let (address, data) = (probe.register.address, bytes(probe.register, probe.other()));
    let ram = || Permissions::from([Permission::WriteRam]);
    let write = talk.demands(
        ram(),
        basic(WIRE, "write"),
        &["write.status"],
        vec![talk.sets(address, &data)],
    );
    let mut checks = vec![write];
    if talk.knows("Reg Write") && talk.knows("Action") {
        let register = instruction(talk.id(), code::REG_WRITE, at(address, &data));
        let action = instruction(talk.id(), code::ACTION, Vec::new());
        for (name, requirement, steps) in [
            ("reg-write", "reg-write.status", vec![talk.done_by(register.clone())]),
            ("action", "action.status", vec![talk.done_by(register), talk.done_by(action)]),
        ] {
            checks.push(talk.demands(ram(), basic(WIRE, name), &[requirement], steps));
        }
    }
    checks
}

/// Every register takes its smallest and its largest value, and holds it.
pub(super) fn kept(talk: &Talk<'_>) -> Vec<Check> {
    let check = |one: Writable<'_>| {
        let register = one.register;
        let word = super::word(&register.name);
        let gains = match register.name.as_str() {
            name if name.starts_with("Velocity ") || name == "Feedforward 2nd Gain" => "velocity",
            _ => "position",
        };
        let requirements =
            [format!("{word}.range"), format!("gains.{gains}"), "write.effect".to_owned()];
        let end =
            if register.name.ends_with("Position Limit") { "position-limit.range" } else { "" };
        let is_gain = register.name.ends_with("Gain");
        let requirements: Vec<_> = requirements
            .into_iter()
            .filter(|name| is_gain || !name.starts_with("gains."))
            .chain((!end.is_empty()).then(|| end.to_owned()))
            .collect();
        // What is about this register comes first.
        let mut requirements = requirements;
        requirements.sort_by_key(|name| name == "write.effect");
        let steps = [one.min, one.max].into_iter().flat_map(|value| {
            let data = bytes(register, value);
            [talk.sets(register.address, &data), talk.holds(register.address, data)]
        });
        let id = named(&format!("written.{word}/kept"));
        talk.demands(needs(talk, register), id, &requirements, steps.collect())
    };
    writable(talk).into_iter().map(check).collect()
}

/// Instructions that write to several devices, or to all.
pub(super) fn several(talk: &Talk<'_>) -> Vec<Check> {
    let Some(probe) = probe(talk) else { return Vec::new() };
    let address = probe.register.address;
    let (id, absent) = (talk.id(), talk.absent());
    let [first, second] = [probe.min, probe.other()].map(|value| bytes(probe.register, value));
    let ram = || Permissions::from([Permission::WriteRam]);
    let begin = || talk.sets(address, &first);
    let mut checks = Vec::new();
    let mut add = |word: &str, what: &str, requirements: &[&str], steps: Vec<Step>| {
        let id = named(&format!("written.{word}.{what}"));
        checks.push(talk.demands(ram(), id, requirements, steps));
    };
    let sync = |blocks: &[(u8, &[u8])]| to_several(code::SYNC_WRITE, address, blocks);
    let bulk = |blocks: &[(u8, &[u8])]| to_several(code::BULK_WRITE, address, blocks);
    let kinds: [(&str, &str, &Writes<'_>); 2] =
        [("Sync Write", "sync-write", &sync), ("Bulk Write", "bulk-write", &bulk)];
    for (name, word, packet) in kinds {
        if !talk.knows(name) {
            continue;
        }
        let [effect, silence] = ["effect", "silence"].map(|what| format!("{word}.{what}"));
        let now = || talk.holds(address, second.clone());
        let alone = packet(&[(id, &second)]);
        let steps = vec![begin(), talk.silent_at(alone)];
        add(word, "answer/silence", &[&silence], steps.clone());
        add(word, "alone/data", &[&effect], steps.into_iter().chain([now()]).collect());
        let after = packet(&[(absent, &first), (id, &second)]);
        add(word, "after-other/data", &[&effect], vec![begin(), talk.silent_at(after), now()]);
        let before = packet(&[(id, &second), (absent, &first)]);
        add(word, "before-other/data", &[&effect], vec![begin(), talk.silent_at(before), now()]);
        let other = packet(&[(absent, &second)]);
        let still = talk.holds(address, first.clone());
        add(word, "not-named/nothing", &[&effect], vec![begin(), talk.silent_at(other), still]);
    }
    if talk.knows("Fast Sync Write") {
        let fast = |blocks: &[(u8, &[u8])]| to_several(code::FAST_SYNC_WRITE, address, blocks);
        let answers = Asked {
            fast: Some(Fast { length: 0, ids: vec![id] }),
            ..asked(fast(&[(id, &second)]), 1)
        };
        let step = (answers, vec![vec![talk.refusal(error::NONE)]]);
        let now = talk.holds(address, second.clone());
        let status = ["fast-sync-write.status", "fast-sync-write.effect"];
        add("fast-sync-write", "answer/status", &status, vec![begin(), step.clone()]);
        add("fast-sync-write", "alone/data", &["fast-sync-write.effect"], vec![begin(), step, now]);
        let other = talk.silent_at(fast(&[(absent, &second)]));
        let still = talk.holds(address, first.clone());
        let effect = ["fast-sync-write.effect"];
        add("fast-sync-write", "not-named/nothing", &effect, vec![begin(), other, still]);
    }
    let other = talk.silent_at(write(absent, address, &second));
    let still = talk.holds(address, first.clone());
    let addressee = ["packet.id.addressee", "packet.addressee"];
    add("other-id", "write/nothing", &addressee, vec![begin(), other, still]);
    // Nobody keeps what other devices hold.
    if talk.target.present == [id] {
        let all = talk.silent_at(write(BROADCAST, address, &second));
        let silence = ["response.broadcast.silence", "response.broadcast"];
        add("broadcast", "write/silence", &silence, vec![begin(), all.clone()]);
        let now = talk.holds(address, second);
        let for_all = ["id.broadcast", "packet.id.broadcast"];
        add("broadcast", "write/data", &for_all, vec![begin(), all, now]);
    }
    checks
}

/// Reg Write and Action.
pub(super) fn registered(talk: &Talk<'_>) -> Vec<Check> {
    let known = talk.knows("Reg Write") && talk.knows("Action");
    let Some(probe) = probe(talk).filter(|_| known) else { return Vec::new() };
    let address = probe.register.address;
    let [first, second] = [probe.min, probe.other()].map(|value| bytes(probe.register, value));
    let ram = || Permissions::from([Permission::WriteRam]);
    let register = |data: &[u8]| instruction(talk.id(), code::REG_WRITE, at(address, data));
    let action = || instruction(talk.id(), code::ACTION, Vec::new());
    let begin = [talk.sets(address, &first), talk.done_by(register(&second))];
    let with = |more: Vec<Step>| begin.clone().into_iter().chain(more).collect::<Vec<_>>();
    let mut rows = vec![
        ("deferred", "reg-write.deferred", with(vec![talk.holds(address, first.clone())])),
        (
            "action",
            "action.effect",
            with(vec![talk.done_by(action()), talk.holds(address, second.clone())]),
        ),
        (
            "nothing",
            "action.without-reg-write",
            vec![talk.refused_with(action(), error::INSTRUCTION)],
        ),
    ];
    let flag = talk.target.device.and_then(|device| device.register("Registered Instruction"));
    if let Some(flag) = flag.filter(|flag| flag.area == Area::Ram) {
        let is = |value| talk.holds(flag.address, bytes(flag, value));
        rows.push(("flag", "reg-write.flag", with(vec![is(1)])));
        rows.push(("flag-after-action", "action.flag", with(vec![talk.done_by(action()), is(0)])));
    }
    let checks = rows.into_iter().map(|(name, requirement, steps)| {
        talk.demands(ram(), named(&format!("registered.{name}/effect")), &[requirement], steps)
    });
    let again = talk.asks_with(
        ram(),
        named("registered.again/answer"),
        &["reg-write.again"],
        vec![
            asked(register(&first), 1),
            asked(register(&second), 1),
            asked(action(), 1),
            asked(talk.read(address, probe.register.kind.size()), 1),
        ],
        Demand::record("Which of two Reg Writes does an Action carry out?", []),
    );
    checks.chain([again]).collect()
}

/// An instruction that writes as many bytes from an address on to each of several devices.
pub(super) fn to_several(code: u8, address: u16, blocks: &[(u8, &[u8])]) -> Packet {
    let size = blocks.first().map_or(0, |(_, data)| data.len());
    let size = u16::try_from(size).unwrap_or(u16::MAX);
    let range = [address, size].map(u16::to_le_bytes).concat();
    // Each block of a Bulk Write has its own range.
    let (head, each) = if code == code::BULK_WRITE {
        (&[][..], range.as_slice())
    } else {
        (range.as_slice(), &[][..])
    };
    let blocks = blocks.iter().flat_map(|(id, data)| [&[*id][..], each, data].concat());
    instruction(BROADCAST, code, head.iter().copied().chain(blocks).collect())
}

/// The parameters of a Write.
pub(super) fn at(address: u16, data: &[u8]) -> Vec<u8> {
    [&address.to_le_bytes()[..], data].concat()
}
