//! Sentences about instructions that change something: each with the smallest conversation that shows whether
//! the device obeys it.

use actucheck_spec::wire::Fast;

use super::restart::{back, reset_packet};
use super::sentences::{Conversation, shown};
use super::writable::{bytes, lasting, probe};
use super::written::{Step, at, to_several};
use super::{Talk, asked, code, error, instruction};
use crate::adapter::{Asked, Bits, Permission, Permissions};
use crate::suite::check::Check;
use crate::suite::wanted::{Like, Part};

/// The option and the key of Clear (DYNAMIXEL Protocol 2.0, Clear).
const CLEAR: [u8; 5] = [0x01, 0x44, 0x58, 0x4C, 0x22];
/// The first firmware that has Clear.
pub(super) const CLEARS_SINCE: u64 = 42;
/// How many counts a shaft without torque may be moved by in the time of a check.
pub(super) const STILL: i64 = 64;

pub(super) fn checks(talk: &Talk<'_>) -> Vec<Check> {
    let all = [
        written,
        several,
        one_named,
        registered,
        // Later the shaft may be in its first turn, where nothing is seen of a Clear: it does that, or a restart.
        cleared_position,
        cleared,
        restarted,
        reset,
        torque,
    ];
    all.into_iter().flat_map(|checks| checks(talk)).collect()
}

/// What is sent, and what must come back.
fn conversation(steps: Vec<Step>) -> Conversation {
    steps.into_iter().unzip()
}

/// Two values, one after the other.
fn written(talk: &Talk<'_>) -> Vec<Check> {
    let Some(probe) = probe(talk) else { return Vec::new() };
    let address = probe.register.address;
    let values = [probe.min, probe.other()].map(|value| bytes(probe.register, value));
    let steps = values.map(|data| [talk.sets(address, &data), talk.holds(address, data)]);
    let ram = Permissions::from([Permission::WriteRam]);
    shown(talk, &ram, &["write.parameters"], &conversation(steps.concat()))
}

/// Instructions that write to several devices.
fn several(talk: &Talk<'_>) -> Vec<Check> {
    let Some(probe) = probe(talk) else { return Vec::new() };
    let [first, second] = [probe.min, probe.other()].map(|value| bytes(probe.register, value));
    let (address, id) = (probe.register.address, talk.id());
    let ram = Permissions::from([Permission::WriteRam]);
    let kinds: [(&str, u8, &[&str]); 2] = [
        ("Sync Write", code::SYNC_WRITE, &["sync-write.parameters", "sync-write.broadcast-id"]),
        ("Bulk Write", code::BULK_WRITE, &["bulk-write.parameters", "bulk-write.broadcast-id"]),
    ];
    let known = kinds.into_iter().filter(|(name, ..)| talk.knows(name));
    let mut checks: Vec<_> = known
        .flat_map(|(_, code, sentences)| {
            let packet = to_several(code, address, &[(id, &second)]);
            let steps = vec![
                talk.sets(address, &first),
                talk.silent_at(packet),
                talk.holds(address, second.clone()),
            ];
            shown(talk, &ram, sentences, &conversation(steps))
        })
        .collect();
    if talk.knows("Fast Sync Write") {
        let packet = to_several(code::FAST_SYNC_WRITE, address, &[(id, &second)]);
        let fast = Some(Fast { length: 0, ids: vec![id] });
        let step = (Asked { fast, ..asked(packet, 1) }, vec![vec![talk.refusal(error::NONE)]]);
        let steps = vec![talk.sets(address, &first), step, talk.holds(address, second)];
        let sentences = ["parameters", "broadcast-id", "same-registers", "length"];
        let sentences = sentences.map(|about| format!("fast-sync-write.{about}"));
        let sentences = sentences.each_ref().map(String::as_str);
        checks.extend(shown(talk, &ram, &sentences, &conversation(steps)));
    }
    checks
}

/// The order of the answers to a Fast Sync Write that both devices refuse, so that the neighbour may be one that is
/// not written to.
fn one_named(talk: &Talk<'_>) -> Vec<Check> {
    let register = talk.target.device.and_then(|device| device.register("Present Temperature"));
    let instruction = "Fast Sync Write";
    let neighbour = talk.neighbour_with(instruction).filter(|_| talk.knows(instruction));
    let (Some(register), Some(neighbour)) = (register, neighbour) else { return Vec::new() };
    let size = usize::from(register.kind.size());
    let steps = [[talk.id(), neighbour], [neighbour, talk.id()]].map(|ids| {
        let data = vec![0; size];
        let packet =
            to_several(code::FAST_SYNC_WRITE, register.address, &ids.map(|id| (id, &data[..])));
        let fast = Some(Fast { length: 0, ids: ids.to_vec() });
        let refused = |id| Like { id, error: Some(error::ACCESS), data: Some(Vec::new()) };
        (Asked { fast, ..asked(packet, 1) }, vec![ids.map(refused).to_vec()])
    });
    let ram = Permissions::from([Permission::WriteRam]);
    shown(talk, &ram, &["fast-sync-write.order"], &conversation(steps.into()))
}

/// Reg Write and Action.
fn registered(talk: &Talk<'_>) -> Vec<Check> {
    let known = talk.knows("Reg Write") && talk.knows("Action");
    let Some(probe) = probe(talk).filter(|_| known) else { return Vec::new() };
    let [first, second] = [probe.min, probe.other()].map(|value| bytes(probe.register, value));
    let address = probe.register.address;
    let steps = vec![
        talk.sets(address, &first),
        talk.done_by(instruction(talk.id(), code::REG_WRITE, at(address, &second))),
        talk.done_by(instruction(talk.id(), code::ACTION, Vec::new())),
        talk.holds(address, second),
    ];
    let ram = Permissions::from([Permission::WriteRam]);
    let sentences = ["reg-write.parameters", "action.parameters"];
    shown(talk, &ram, &sentences, &conversation(steps))
}

fn restarted(talk: &Talk<'_>) -> Vec<Check> {
    let Some(probe) = probe(talk).filter(|_| talk.knows("Reboot")) else { return Vec::new() };
    let Some(initial) = probe.register.initial else { return Vec::new() };
    let reboot = || talk.done_by(instruction(talk.id(), code::REBOOT, Vec::new()));
    let needs = Permissions::from([Permission::Reboot]);
    let parameters = conversation(vec![reboot(), back(talk)]);
    let mut checks = shown(talk, &needs, &["reboot.parameters"], &parameters);
    let address = probe.register.address;
    let effect = conversation(vec![
        talk.sets(address, &bytes(probe.register, probe.other())),
        reboot(),
        back(talk),
        talk.holds(address, bytes(probe.register, initial)),
    ]);
    let needs = Permissions::from([Permission::WriteRam, Permission::Reboot]);
    checks.extend(shown(talk, &needs, &["reboot.effect"], &effect));
    checks
}

fn reset(talk: &Talk<'_>) -> Vec<Check> {
    let (Some(one), Some(probe)) = (lasting(talk), probe(talk)) else { return Vec::new() };
    let initial = (one.register.initial, probe.register.initial);
    let ((Some(lasting), Some(initial)), true) = (initial, talk.knows("Factory Reset")) else {
        return Vec::new();
    };
    let after = |address: u16, other: &[u8], initial: Vec<u8>| {
        conversation(vec![
            talk.sets(address, other),
            talk.done_by(reset_packet(talk)),
            back(talk),
            talk.holds(address, initial),
        ])
    };
    let (register, other) = (one.register, bytes(one.register, one.other()));
    let parameters = after(register.address, &other, bytes(register, lasting));
    let needs = Permissions::from([Permission::Eeprom, Permission::Reset]);
    let mut checks = shown(talk, &needs, &["factory-reset.parameters"], &parameters);
    let (register, other) = (probe.register, bytes(probe.register, probe.other()));
    let restarts = after(register.address, &other, bytes(register, initial));
    let needs = Permissions::from([Permission::WriteRam, Permission::Eeprom, Permission::Reset]);
    checks.extend(shown(talk, &needs, &["factory-reset.reboot"], &restarts));
    checks
}

/// The answer to Clear. What it does to a device that does not turn is forgotten at a restart too.
fn cleared(talk: &Talk<'_>) -> Vec<Check> {
    if !talk.knows("Clear") {
        return Vec::new();
    }
    let needs = Permissions::from([Permission::Reboot]);
    let clear = || instruction(talk.id(), code::CLEAR, CLEAR.to_vec());
    let any = Like { id: talk.id(), error: None, data: Some(Vec::new()) };
    let answer = conversation(vec![(asked(clear(), 1), vec![vec![any]])]);
    let mut checks = shown(talk, &needs, &["clear.status"], &answer);
    // Firmware before a certain one has no such instruction.
    let rows = [error::NONE, error::INSTRUCTION].map(|number| vec![talk.refusal(number)]).to_vec();
    let taken = conversation(vec![(asked(clear(), 1), rows)]);
    checks.extend(shown(talk, &needs, &["clear.parameters"], &taken));
    checks
}

/// What Clear does to Present Position, where the device's own document does not say something else.
fn cleared_position(talk: &Talk<'_>) -> Vec<Check> {
    let Some(device) = talk.target.device else { return Vec::new() };
    let registers = ["Firmware Version", "Homing Offset", "Present Position"];
    let [Some(firmware), Some(offset), Some(position)] =
        registers.map(|name| device.register(name))
    else {
        return Vec::new();
    };
    let own = talk.document().map(|document| format!("{document}.clear.effect"));
    let is_other = own.is_some_and(|own| talk.author.spec.requirement(&own).is_some());
    let counts = device.counts_per_turn.filter(|counts| counts.is_power_of_two());
    let Some(counts) = counts.filter(|_| !is_other && talk.knows("Clear")) else {
        return Vec::new();
    };
    let lowest = u8::try_from(counts.trailing_zeros()).unwrap_or_default();
    let needed = [
        talk.given(firmware, "firmware 42 or newer", (0, 8), (CLEARS_SINCE..=255).collect()),
        talk.given(offset, "a Homing Offset of 0", (0, 32), vec![0]),
        // Elsewhere nothing is seen of what Clear does.
        talk.given(
            position,
            "a shaft that is not in its first turn",
            (lowest, 8),
            (1..=255).collect(),
        ),
    ];
    let read = |part| (asked(talk.read(position.address, 4), 1), vec![vec![talk.done(part)]]);
    let clear = |params| talk.done_by(instruction(talk.id(), code::CLEAR, params));
    let within = Part::Bits { size: 4, has: Bits { lowest, width: 32 - lowest, one_of: vec![0] } };
    let needs = Permissions::from([Permission::Reboot]);
    let used = [clear(CLEAR.to_vec()), read(within)];
    let used = conversation(needed.iter().cloned().chain(used).collect());
    let [_, key @ ..] = CLEAR;
    let unused = instruction(talk.id(), code::CLEAR, [&[0x02][..], &key].concat());
    let any = Like { id: talk.id(), error: None, data: Some(Vec::new()) };
    let same = Part::Moved { step: needed.len(), by: 0, within: STILL };
    let steps = [read(Part::Any(4)), (asked(unused, 1), vec![vec![any]]), read(same)];
    let unused = conversation(needed.into_iter().chain(steps).collect());
    // The first of them leaves the turns for the other.
    let mut checks = shown(talk, &needs, &["clear.unused-options"], &unused);
    checks.extend(shown(talk, &needs, &["clear.position"], &used));
    checks
}

/// Torque on and off, and what the register does not take.
fn torque(talk: &Talk<'_>) -> Vec<Check> {
    let register = talk.target.device.and_then(|device| device.register("Torque Enable"));
    let Some((register, still)) = register.zip(talk.still(0)) else { return Vec::new() };
    let on_and_off = [1, 0].into_iter().flat_map(|value| {
        let data = bytes(register, value);
        [talk.sets(register.address, &data), talk.holds(register.address, data)]
    });
    let motion = Permissions::from([Permission::Motion]);
    let sentences = ["torque-enable.values|torque-enable.torque"];
    shown(talk, &motion, &sentences, &conversation(still.into_iter().chain(on_and_off).collect()))
}
