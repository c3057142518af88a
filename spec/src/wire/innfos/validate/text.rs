//! The commands that a requirement's text names are those of the file.

use crate::model::Requirement;
use crate::wire::innfos::Innfos;

/// `0x0D` in a requirement of INNFOS.
pub(in crate::wire::innfos) fn misquoted(innfos: &Innfos, row: &Requirement) -> Vec<String> {
    let mut sources = innfos.framing.source.iter();
    if !sources.any(|citation| citation.document == row.source.document) {
        return Vec::new();
    }
    let codes = row
        .text
        .match_indices("0x")
        .filter_map(|(at, _)| u8::from_str_radix(row.text.get(at + 2..at + 4)?, 16).ok());
    codes
        .filter(|code| innfos.command(*code).is_none())
        .map(|code| format!("there is no command {code:#04X}"))
        .collect()
}
