//! The codes that a requirement's text names are those of the file.

use crate::model::Requirement;
use crate::wire::dynamixel2::Dynamixel2;

/// `Fast Sync Read 0x8A`: an instruction's name with a code after it.
pub(in crate::wire::dynamixel2) fn misquoted(wire: &Dynamixel2, row: &Requirement) -> Vec<String> {
    let mut wrong = Vec::new();
    for (at, _) in row.text.match_indices(" 0x") {
        let (before, behind) = row.text.split_at(at);
        let digits = behind.get(3..5).unwrap_or_default();
        let Ok(code) = u8::from_str_radix(digits, 16) else { continue };
        let named = wire
            .instructions
            .iter()
            .filter(|instruction| before.ends_with(&instruction.name))
            .max_by_key(|instruction| instruction.name.len());
        if let Some(named) = named.filter(|named| named.code != code) {
            wrong.push(format!("{} has the code {:#04X}", named.name, named.code));
        }
    }
    wrong
}
