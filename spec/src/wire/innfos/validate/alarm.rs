//! Rule: an alarm is one bit.

use crate::Diagnostic;
use crate::load::File;
use crate::wire::innfos::Innfos;

pub(super) fn check(file: &File<Innfos>) -> Vec<Diagnostic> {
    let rows = file.content.alarms.rows.iter().enumerate();
    rows.filter(|(_, row)| !row.mask.is_power_of_two())
        .map(|(index, row)| {
            let message = format!("{}: {:#06X} is no single bit", row.name, row.mask);
            file.diagnostic(&format!("alarms.rows[{index}].mask"), message)
        })
        .collect()
}
