//! Rules for the wire's file that serde can't check.

mod alarm;
mod command;
mod fixed_point;
mod frame;
mod full_scale;
mod text;

use super::{Innfos, WIRE};
use crate::Diagnostic;
use crate::load::File;
use crate::validate::{crc, repeated};
use crate::wire::Cited;

pub(super) use frame::frames;
pub(super) use text::misquoted;

/// Every defect.
pub(super) fn all(file: &File<Innfos>) -> Vec<Diagnostic> {
    let innfos = &file.content;
    let commands = [(file, innfos.commands.as_slice())];
    let mut defects = repeated(commands, "commands", "code", |row| row.code);
    defects.extend(repeated(commands, "commands", "name", |row| {
        format!("{} ({})", row.name, row.operation)
    }));
    let formats = [(file, innfos.formats.as_slice())];
    defects.extend(repeated(formats, "formats", "format", |row| row.format));
    let modes = [(file, innfos.modes.rows.as_slice())];
    defects.extend(repeated(modes, "modes.rows", "code", |row| row.code));
    let alarms = [(file, innfos.alarms.rows.as_slice())];
    defects.extend(repeated(alarms, "alarms.rows", "mask", |row| row.mask));
    let actuators = [(file, innfos.actuators.rows.as_slice())];
    defects.extend(repeated(actuators, "actuators.rows", "name", |row| &row.name));
    for (index, code) in innfos.crc_presence.optional.iter().enumerate() {
        if innfos.command(*code).is_none() {
            let message = format!("there is no command {code:#04X}");
            defects.push(file.diagnostic(&format!("crc_presence.optional[{index}]"), message));
        }
    }
    defects.extend(crc::fault(&innfos.crc).map(|(node, text)| file.diagnostic(node, text)));
    defects.extend(fixed_point::check(file));
    defects.extend(command::check(file));
    defects.extend(alarm::check(file));
    defects.extend(full_scale::check(file));
    defects
}

/// Its citations.
pub(super) fn cited(innfos: &Innfos) -> Vec<Cited<'_>> {
    let Innfos { framing, crc, crc_presence, udp, modes, alarms, actuators, .. } = innfos;
    let parts = [
        ("framing", "framing", &framing.source, &framing.errata),
        ("crc", "CRC", &crc.source, &crc.errata),
        ("crc_presence", "presence of the CRC", &crc_presence.source, &crc_presence.errata),
        ("udp", "UDP", &udp.source, &udp.errata),
        ("modes", "modes", &modes.source, &modes.errata),
        ("alarms", "alarms", &alarms.source, &alarms.errata),
        ("actuators", "models", &actuators.source, &actuators.errata),
    ];
    let parts = parts.into_iter().map(|(node, name, source, errata)| {
        Cited::new(node, format!("{name} of {WIRE}"), source, errata)
    });
    let formats = innfos.formats.iter().enumerate().map(|(index, row)| {
        let (node, name) =
            (format!("formats[{index}]"), format!("format {} of {WIRE}", row.format));
        Cited::new(&node, name, &row.source, &row.errata)
    });
    let commands = innfos.commands.iter().enumerate().map(|(index, row)| {
        let (node, name) =
            (format!("commands[{index}]"), format!("command {WIRE}/{:#04X}", row.code));
        Cited::new(&node, name, &row.source, &row.errata)
    });
    parts.chain(formats).chain(commands).collect()
}
