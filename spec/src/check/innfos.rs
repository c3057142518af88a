//! The parts of the INNFOS protocol that cite the document.

use crate::model::{Citation, Innfos};

/// A part with what it cites.
pub(super) struct Part<'a> {
    /// Where it stands in the file.
    pub(super) node: String,
    pub(super) source: &'a [Citation],
    pub(super) errata: &'a [String],
}

/// Every part.
pub(super) fn parts(innfos: &Innfos) -> Vec<Part<'_>> {
    let Innfos { framing, crc, crc_presence, udp, modes, alarms, actuators, .. } = innfos;
    let mut parts = vec![
        part("framing", &framing.source, &framing.errata),
        part("crc", &crc.source, &crc.errata),
        part("crc_presence", &crc_presence.source, &crc_presence.errata),
        part("udp", &udp.source, &udp.errata),
        part("modes", &modes.source, &modes.errata),
        part("alarms", &alarms.source, &alarms.errata),
        part("actuators", &actuators.source, &actuators.errata),
    ];
    for (index, row) in innfos.formats.iter().enumerate() {
        parts.push(part(&format!("formats[{index}]"), &row.source, &row.errata));
    }
    for (index, row) in innfos.commands.iter().enumerate() {
        let node = format!("commands[{index}]");
        parts.push(part(&node, &row.source, &row.errata));
    }
    parts
}

fn part<'a>(node: &str, source: &'a [Citation], errata: &'a [String]) -> Part<'a> {
    Part { node: node.to_owned(), source, errata }
}
