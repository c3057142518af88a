//! What stays over a restart, what a reset sets back, and what torque locks.

use actucheck_spec::model::{Access, Area, HexBytes, Register};
use actucheck_spec::wire::dynamixel2::Packet;

use super::writable::{bytes, lasting, probe};
use super::written::Step;
use super::{Talk, asked, bytes_of, code, error, instruction, named, write};
use crate::adapter::{Asked, Pause, Permission, Permissions, Piece};
use crate::suite::check::Check;
use crate::suite::wanted::Part;

/// Option of Factory Reset: all but the ID and the rate.
const KEEP_ID_AND_RATE: u8 = 0x02;
/// How often a device that restarts is called until it answers.
const UNTIL_BACK: u32 = 10;

/// Pings, until the device is back.
pub(super) fn back(talk: &Talk<'_>) -> Step {
    let ping = Piece { after: Pause::None, bytes: bytes_of(talk.ping()) };
    let asked = Asked { send: vec![ping], awaits: 1, again: UNTIL_BACK, ..Asked::default() };
    (asked, vec![vec![talk.pong()]])
}

/// Registers that must hold their initial values, each in a step.
pub(super) fn initial<'t>(
    talk: &'t Talk<'_>,
    is_meant: impl Fn(&Register) -> bool + 't,
) -> impl Iterator<Item = Step> + 't {
    let registers = talk.target.device.into_iter().flat_map(|device| &device.registers);
    let registers = registers.filter(move |register| {
        // What an erratum is about may have another value.
        register.access == Access::Rw && register.errata.is_empty() && is_meant(register)
    });
    registers.filter_map(|register| {
        Some(talk.holds(register.address, bytes(register, register.initial?)))
    })
}

pub(super) fn reboot(talk: &Talk<'_>) -> Vec<Check> {
    let reboot = || talk.done_by(instruction(talk.id(), code::REBOOT, Vec::new()));
    let Some(probe) = probe(talk).filter(|_| talk.knows("Reboot")) else { return Vec::new() };
    let needs = |more: Option<Permission>| {
        [Permission::Reboot].into_iter().chain(more).collect::<Permissions>()
    };
    let address = probe.register.address;
    let answer = talk.demands(
        needs(None),
        named("restart.reboot/answer"),
        &["reboot.status"],
        vec![reboot(), back(talk)],
    );
    let begin = [talk.sets(address, &bytes(probe.register, probe.other())), reboot(), back(talk)];
    let ram = initial(talk, |register| register.area == Area::Ram);
    let ram = talk.demands(
        needs(Some(Permission::WriteRam)),
        named("restart.ram/initial-values"),
        &["table.ram", "reboot.effect"],
        begin.into_iter().chain(ram).collect(),
    );
    let lasting = lasting(talk).map(|one| {
        let (address, data) = (one.register.address, bytes(one.register, one.other()));
        talk.demands(
            needs(Some(Permission::Eeprom)),
            named("restart.eeprom/kept"),
            &["table.eeprom", "reboot.effect"],
            vec![talk.sets(address, &data), reboot(), back(talk), talk.holds(address, data)],
        )
    });
    [answer, ram].into_iter().chain(lasting).collect()
}

/// A Factory Reset that leaves ID and rate.
pub(super) fn reset_packet(talk: &Talk<'_>) -> Packet {
    instruction(talk.id(), code::FACTORY_RESET, vec![KEEP_ID_AND_RATE])
}

pub(super) fn reset(talk: &Talk<'_>) -> Vec<Check> {
    let packet = reset_packet(talk);
    let Some(one) = lasting(talk).filter(|_| talk.knows("Factory Reset")) else {
        return Vec::new();
    };
    let needs = || Permissions::from([Permission::Eeprom, Permission::Reset]);
    let is_reset = |register: &Register| {
        register.area == Area::Eeprom && !matches!(register.name.as_str(), "ID" | "Baud Rate")
    };
    let begin = || {
        let data = bytes(one.register, one.other());
        vec![talk.sets(one.register.address, &data), talk.done_by(packet.clone()), back(talk)]
    };
    let answer = talk.demands(
        needs(),
        named("reset.keep-id-and-baud-rate/answer"),
        &["factory-reset.status"],
        begin(),
    );
    let values = talk.demands(
        needs(),
        named("reset.keep-id-and-baud-rate/initial-values"),
        &["table.initial-values", "factory-reset.keep-id-and-baud-rate"],
        begin().into_iter().chain(initial(talk, is_reset)).collect(),
    );
    let mut checks = vec![answer, values];
    if let Some(rate) = talk.target.device.and_then(|device| device.register("Baud Rate")) {
        let read = || asked(talk.read(rate.address, 1), 1);
        let any = (read(), vec![vec![talk.done(Part::Any(1))]]);
        let same = Part::Same { step: 0, from: 0, count: 1 };
        let kept = (read(), vec![vec![talk.done(same)]]);
        let steps = [any].into_iter().chain(begin()).chain([kept]).collect();
        let id = named("reset.keep-id-and-baud-rate/rate");
        checks.push(talk.demands(needs(), id, &["factory-reset.keep-id-and-baud-rate"], steps));
    }
    checks
}

/// The EEPROM area while torque is on.
pub(super) fn lock(talk: &Talk<'_>) -> Vec<Check> {
    let torque =
        talk.target.device.and_then(|device| device.register(device.eeprom_lock.as_ref()?));
    let (Some(torque), Some(one), Some(probe)) = (torque, lasting(talk), probe(talk)) else {
        return Vec::new();
    };
    // The shaft must not turn.
    let is_torque = torque.name == "Torque Enable";
    let still = if is_torque { talk.still(0).map(Vec::from) } else { Some(Vec::new()) };
    let Some(still) = still else { return Vec::new() };
    let register = one.register;
    let size = register.kind.size();
    let (on, off) = (talk.sets(torque.address, &[1]), talk.sets(torque.address, &[0]));
    let any = (
        asked(talk.read(register.address, size), 1),
        vec![vec![talk.done(Part::Any(size.into()))]],
    );
    let same = Part::Same { step: still.len(), from: 0, count: size.into() };
    let kept = (asked(talk.read(register.address, size), 1), vec![vec![talk.done(same)]]);
    let data: HexBytes = bytes(register, one.other()).into();
    let refused = talk.refused_with(write(talk.id(), register.address, &data.0), error::ACCESS);
    let steps = [any, on.clone(), refused, kept, off.clone()];
    let steps: Vec<_> = still.iter().cloned().chain(steps).collect();
    let locked = talk.demands(
        [Permission::Eeprom, Permission::Motion].into(),
        named("lock.eeprom/refused"),
        &["status-packet.error.locked", "torque-enable.lock"],
        steps.clone(),
    );
    let sentence = talk.row(&["table.eeprom-lock"]).map(|_| {
        let needs = [Permission::Eeprom, Permission::Motion].into();
        talk.demands(needs, named("lock.table/refused"), &["table.eeprom-lock"], steps)
    });
    let open = bytes(probe.register, probe.other());
    let open = talk.demands(
        [Permission::WriteRam, Permission::Motion].into(),
        named("lock.ram/kept"),
        &["write.effect"],
        still
            .into_iter()
            .chain([
                on,
                talk.sets(probe.register.address, &open),
                talk.holds(probe.register.address, open),
                off,
            ])
            .collect(),
    );
    [locked, open].into_iter().chain(sentence).collect()
}
