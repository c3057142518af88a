//! What the device says it is, and the basic checks: that it answers each instruction that reads.

use super::{Talk, asked, basic, several};
use crate::suite::check::Check;
use crate::suite::wanted::Part;
use actucheck_spec::wire::dynamixel2::WIRE;

/// Ping, Read, and what reads from several devices, each with the device alone.
pub(super) fn basics(talk: &Talk<'_>) -> Vec<Check> {
    let ping = talk.check(
        basic(WIRE, "ping"),
        &["ping.status"],
        vec![asked(talk.ping(), 1)],
        vec![vec![vec![talk.pong()]]],
    );
    let Some(register) = talk.target.device.and_then(|device| device.registers.first()) else {
        return vec![ping];
    };
    let size = register.kind.size();
    let read = talk.check(
        basic(WIRE, "read"),
        &["read.status"],
        vec![asked(talk.read(register.address, size), 1)],
        vec![vec![vec![talk.done(Part::Any(size.into()))]]],
    );
    let several = several::basics(talk, register.address, size);
    [ping, read].into_iter().chain(several).collect()
}

/// Ping and Read tell the same model and firmware, and the document's model.
pub(super) fn checks(talk: &Talk<'_>) -> Vec<Check> {
    let Some(device) = talk.target.device else { return Vec::new() };
    let number = device.model_number.map(|number| {
        let data = vec![Part::Bytes(number.to_le_bytes().to_vec().into()), Part::Any(1)];
        talk.check(
            super::named("identity.model-number/ping"),
            &["model-number.value", "ping.status"],
            vec![asked(talk.ping(), 1)],
            vec![vec![vec![talk.says(super::error::NONE, data)]]],
        )
    });
    let same = [("Model Number", 0), ("Firmware Version", 2)].map(|(name, from)| {
        let register = device.register(name)?;
        let size = register.kind.size();
        let read = asked(talk.read(register.address, size), 1);
        let part = Part::Same { step: 0, from, count: size.into() };
        let name = super::word(name);
        Some(talk.check(
            super::named(&format!("identity.{name}/read")),
            &[&format!("{name}.value"), "ping.status"],
            vec![asked(talk.ping(), 1), read],
            vec![vec![vec![talk.pong()]], vec![vec![talk.done(part)]]],
        ))
    });
    number.into_iter().chain(same.into_iter().flatten()).collect()
}
