//! What can't be written: registers for reading, addresses without a register, and parts of registers; and several
//! registers at once.

use super::changes::is_measured;
use super::writable::{Writable, bytes, probe, probes};
use super::written::{Step, at};
use super::{Talk, asked, code, error, instruction, named, word, write};
use crate::adapter::{Permission, Permissions};
use crate::suite::check::{Check, Demand};
use crate::suite::wanted::Part;

/// What marks a place in several registers is a multiple of it.
const MARK: i64 = 0x0101;
/// The most registers that are written at once.
const MOST: usize = 32;
/// The mark of the last of so many.
const LARGEST: i64 = MARK * 32;

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

/// Writes of two neighbouring registers, and of as many as there are. Documents show how one is written, and nowhere
/// say whether several may be, so it is recorded.
pub(super) fn of_several(talk: &Talk<'_>) -> Vec<Check> {
    let Some(run) = longest_run(talk) else { return Vec::new() };
    let check = |name: &str, run: &[Writable<'_>]| {
        let address = run.first()?.register.address;
        let data: Vec<u8> =
            run.iter().enumerate().flat_map(|(place, one)| mark(one, place)).collect();
        let length = u16::try_from(data.len()).ok()?;
        let write = write(talk.id(), address, &data);
        let steps = vec![talk.packet_then_ping(write), asked(talk.read(address, length), 1)];
        let id = named(&format!("length.{name}/answer"));
        let ram = Permissions::from([Permission::WriteRam]);
        let question = format!("What does a Write of {} registers do?", run.len());
        let demand = Demand::record(&question, []);
        Some(talk.asks_with(ram, id, &["write.parameters"], steps, demand))
    };
    let two = run.get(..2).and_then(|two| check("two-registers", two));
    let all = Some(&run).filter(|run| run.len() > 2).and_then(|run| check("most-registers", run));
    two.into_iter().chain(all).collect()
}

/// The most harmless registers that have no address between them, of those that take every mark.
fn longest_run<'a>(talk: &Talk<'a>) -> Option<Vec<Writable<'a>>> {
    let mut registers: Vec<_> =
        probes(talk).filter(|one| one.min <= 0 && one.max >= LARGEST).collect();
    registers.sort_by_key(|one| one.register.address);
    let runs = registers.chunk_by(|one, next| {
        one.register.address + one.register.kind.size() == next.register.address
    });
    let longest = runs.max_by_key(|run| run.len())?;
    Some(longest.iter().take(MOST).copied().collect())
}

/// Bytes that tell this place from others, and from what a device holds.
fn mark(one: &Writable<'_>, place: usize) -> Vec<u8> {
    let place = i64::try_from(place).unwrap_or_default();
    bytes(one.register, MARK * (place + 1))
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
