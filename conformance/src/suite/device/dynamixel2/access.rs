//! What can't be written: registers for reading, addresses without a register, and parts of registers.

use super::changes::is_measured;
use super::writable::{bytes, probe};
use super::written::{Step, at};
use super::{Talk, asked, code, error, instruction, named, word, write};
use crate::adapter::{Permission, Permissions};
use crate::suite::check::{Check, Demand};
use crate::suite::wanted::Part;

/// Rows on what is for reading only.
const READ_ONLY: [&str; 2] = ["status-packet.error.write-access", "table.read-only"];

pub(super) fn checks(talk: &Talk<'_>) -> Vec<Check> {
    let Some(device) = talk.target.device else { return Vec::new() };
    let ram = || Permissions::from([Permission::WriteRam]);
    let mut checks = Vec::new();
    for register in device.registers.iter().filter(|register| is_measured(register)) {
        let write = write(talk.id(), register.address, &bytes(register, 0));
        let id = named(&format!("access.{}/refused", word(&register.name)));
        checks.push(talk.demands(
            ram(),
            id,
            &READ_ONLY,
            vec![talk.refused_with(write, error::ACCESS)],
        ));
    }
    // The number is written that it has, so that nothing is lost if it is taken.
    if let (Some(register), Some(number)) = (device.register("Model Number"), device.model_number) {
        let write = write(talk.id(), register.address, &bytes(register, number.into()));
        let needs = Permissions::from([Permission::Eeprom]);
        let id = named("access.model-number/refused");
        checks.push(talk.demands(
            needs,
            id,
            &READ_ONLY,
            vec![talk.refused_with(write, error::ACCESS)],
        ));
    }
    if device.complete {
        let write = write(talk.id(), u16::MAX, &[0]);
        let step = talk.refused_with(write, error::ACCESS);
        let id = named("access.no-register/refused");
        checks.push(talk.demands(ram(), id, &READ_ONLY[..1], vec![step]));
    }
    checks
}

/// Writes that are shorter or longer than a register.
pub(super) fn lengths(talk: &Talk<'_>) -> Vec<Check> {
    let Some(probe) = probe(talk) else { return Vec::new() };
    let (address, register) = (probe.register.address, probe.register);
    let ram = || Permissions::from([Permission::WriteRam]);
    let data = bytes(register, probe.other());
    let size = data.len();
    let short = data.get(..size - 1).unwrap_or_default();
    let read = || asked(talk.read(address, register.kind.size()), 1);
    let steps: Vec<Step> = vec![
        (read(), vec![vec![talk.done(Part::Any(size))]]),
        talk.refused_with(write(talk.id(), address, short), error::DATA_LENGTH),
        (read(), vec![vec![talk.done(Part::Same { step: 0, from: 0, count: size })]]),
    ];
    let id = named("length.short/refused");
    let short = talk.demands(ram(), id, &["status-packet.error.data-length"], steps);
    let record = |name: &str, packet, question: &str| {
        let id = named(&format!("length.{name}/answer"));
        let steps = vec![talk.packet_then_ping(packet)];
        talk.asks_with(ram(), id, &["write.parameters"], steps, Demand::record(question, []))
    };
    let nothing = instruction(talk.id(), code::WRITE, at(address, &[]));
    let no_address = instruction(talk.id(), code::WRITE, vec![0]);
    vec![
        short,
        record("nothing", nothing, "How does it answer a Write of no bytes?"),
        record("no-address", no_address, "How does it answer a Write without a whole address?"),
    ]
}
