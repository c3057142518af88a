//! Rules for the wire's file that serde can't check.

mod frame;
mod layout;
mod text;

use super::{Dynamixel2, WIRE};
use crate::Diagnostic;
use crate::load::File;
use crate::validate::{crc, repeated};
use crate::wire::Cited;

pub(super) use frame::frame;
pub(super) use text::misquoted;

/// Every defect.
pub(super) fn all(file: &File<Dynamixel2>) -> Vec<Diagnostic> {
    let wire = &file.content;
    let (instructions, errors) = (wire.instructions.as_slice(), wire.status.errors.as_slice());
    let mut defects = repeated([(file, instructions)], "instructions", "name", |row| &row.name);
    defects.extend(repeated([(file, instructions)], "instructions", "code", |row| row.code));
    defects.extend(repeated([(file, errors)], "status.errors", "number", |row| row.number));
    defects.extend(layout::check(file));
    defects.extend(crc::fault(&wire.crc).map(|(node, text)| file.diagnostic(node, text)));
    defects
}

/// Its citations.
pub(super) fn cited(wire: &Dynamixel2) -> Vec<Cited<'_>> {
    let Dynamixel2 { framing, crc, stuffing, status, .. } = wire;
    let parts = [
        ("framing", "framing", &framing.source, &framing.errata),
        ("crc", "CRC", &crc.source, &crc.errata),
        ("stuffing", "byte stuffing", &stuffing.source, &stuffing.errata),
        ("status", "status packet", &status.source, &status.errata),
    ];
    let parts = parts.into_iter().map(|(node, name, source, errata)| {
        Cited::new(node, format!("{name} of {WIRE}"), source, errata)
    });
    let instructions = wire.instructions.iter().enumerate().map(|(index, row)| {
        let name = format!("instruction {WIRE}/{}", row.name);
        Cited::new(&format!("instructions[{index}]"), name, &row.source, &row.errata)
    });
    parts.chain(instructions).collect()
}
