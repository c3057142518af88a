//! Status Return Level: which instructions are answered.

use actucheck_spec::model::Register;

use super::writable::{bytes, probe};
use super::written::Step;
use super::{Talk, asked, named, write};
use crate::adapter::{Permission, Permissions};
use crate::suite::check::Check;

/// What the levels mean.
const ROW: [&str; 1] = ["response.status-return-level"];

pub(super) fn checks(talk: &Talk<'_>) -> Vec<Check> {
    all(talk).unwrap_or_default()
}

fn all(talk: &Talk<'_>) -> Option<Vec<Check>> {
    let level = talk.target.device.and_then(|device| device.register("Status Return Level"));
    let (level, probe) = (level?, probe(talk)?);
    let (address, size) = (probe.register.address, probe.register.kind.size());
    let data = bytes(probe.register, probe.other());
    let ram = || Permissions::from([Permission::WriteRam]);
    let silent_read = || talk.silent_at(talk.read(address, size));
    let silent_write = || talk.silent_at(write(talk.id(), address, &data));
    let ping = (asked(talk.ping(), 1), vec![vec![talk.pong()]]);
    let (writes, reads) = (talk.sets(address, &data), talk.holds(address, data.clone()));
    let rows = [
        ("0", "read", 0, vec![silent_read()]),
        ("0", "write", 0, vec![silent_write()]),
        ("1", "read", 1, vec![silent_write(), reads.clone()]),
        ("1", "write", 1, vec![silent_write()]),
        ("2", "answers", 2, vec![writes, reads]),
    ];
    let levels = rows.into_iter().map(|(number, about, value, steps)| {
        let steps = [set(talk, level, value)].into_iter().chain(steps).collect();
        talk.demands(ram(), named(&format!("level.{number}/{about}")), &ROW, steps)
    });
    let always = (0..=2).flat_map(|value| [set(talk, level, value), ping.clone()]).collect();
    let id = named("level.every/ping");
    Some(levels.chain([talk.demands(ram(), id, &["ping.always"], always)]).collect())
}

/// A Write to the register. Whether it is answered may depend on the level before or on the one after it.
fn set(talk: &Talk<'_>, level: &Register, value: i64) -> Step {
    let write = write(talk.id(), level.address, &bytes(level, value));
    let rows = vec![vec![talk.pong()], vec![talk.refusal(super::error::NONE), talk.pong()]];
    (talk.packet_then_ping(write), rows)
}
