//! A hardware error, which a Temperature Limit below the temperature brings about without harm: the bit that tells
//! it, and the alert in every answer. The limit is set back, and a restart clears the error.

use super::writable::{bytes, probe};
use super::written::Step;
use super::{Talk, UNDEFINED, asked, error, instruction, named, write};
use crate::adapter::{Asked, Bits, Permission, Permissions};
use crate::suite::check::Check;
use crate::suite::wanted::Part;

/// A Temperature Limit in °C.
const COLD: i64 = 1;
/// How often it is looked, at least 10 ms apart, whether the error is there.
const LOOKS: u32 = 200;

pub(super) fn checks(talk: &Talk<'_>) -> Vec<Check> {
    let Some(raised) = raised(talk) else { return Vec::new() };
    let needs = Permissions::from([Permission::Eeprom, Permission::Reboot]);
    let told = [
        ("temperature-limit/raised", "temperature-limit.alarm"),
        ("overheating/bit", "hardware-error.overheating"),
    ];
    let told = told.into_iter().filter(|(_, row)| talk.row(&[row]).is_some()).map(|(name, row)| {
        talk.demands(needs.clone(), named(&format!("alarm.{name}")), &[row], raised.clone())
    });
    let told: Vec<_> = told.collect();
    let alert = alert(talk).map(|steps| {
        let steps = raised.iter().cloned().chain(steps).collect();
        let more = [Permission::WriteRam, Permission::Eeprom, Permission::Reboot];
        let rows = ["status-packet.alert"];
        talk.demands(more.into(), named("alarm.alert/every-answer"), &rows, steps)
    });
    told.into_iter().chain(alert).collect()
}

/// What lets a device without a hardware error be hotter than its limit, and the bit that tells so.
fn raised(talk: &Talk<'_>) -> Option<Vec<Step>> {
    let [limit, temperature, status] =
        ["Temperature Limit", "Present Temperature", "Hardware Error Status"]
            .map(|name| talk.register(name));
    let (limit, temperature, status) = (limit?, temperature?, status?);
    let field = status.bit_field("Overheating Error")?;
    let has = Bits { lowest: field.lowest, width: 1, one_of: vec![1] };
    let size = status.kind.size();
    let part = Part::Bits { size: size.into(), has: has.clone() };
    let read = asked(talk.read(status.address, size), 1);
    let read = Asked { again: LOOKS, until: Some(has), ..read };
    Some(vec![
        talk.given(status, "a device without a hardware error", (0, 8), vec![0]),
        talk.given(temperature, "a temperature of 8 °C or more", (3, 5), (1..=31).collect()),
        talk.sets(limit.address, &bytes(limit, COLD)),
        (read, vec![vec![talk.done(part)]]),
    ])
}

/// Answers with an error number and without one.
fn alert(talk: &Talk<'_>) -> Option<[Step; 4]> {
    let (probe, measured) = (probe(talk)?, talk.register("Present Temperature")?);
    let (id, register, [undefined, ..]) = (talk.id(), probe.register, UNDEFINED);
    let step = |packet, number, data: Vec<Part>| {
        let data = data.into_iter().chain([Part::Alert]).collect();
        (asked(packet, 1), vec![vec![talk.says(number, data)]])
    };
    let size = register.kind.size();
    let any = vec![Part::Any(size.into())];
    let refused = write(id, measured.address, &bytes(measured, 0));
    Some([
        step(talk.read(register.address, size), error::NONE, any),
        step(write(id, register.address, &bytes(register, probe.other())), error::NONE, Vec::new()),
        step(refused, error::ACCESS, Vec::new()),
        step(instruction(id, undefined, Vec::new()), error::INSTRUCTION, Vec::new()),
    ])
}
