//! Rule: a format has a size, and fractional bits if it is a fixed-point number.

use crate::Diagnostic;
use crate::load::File;
use crate::wire::innfos::{Format, Innfos};

pub(super) fn check(file: &File<Innfos>) -> Vec<Diagnostic> {
    let mut defects = Vec::new();
    for (index, row) in file.content.formats.iter().enumerate() {
        let fixed = match row.format {
            Format::Iq8 => Some((8, 2)),
            Format::Iq24 => Some((24, 4)),
            _ => None,
        };
        let message = if row.sizes.is_empty() {
            "a format has a size".to_owned()
        } else if row.fraction_bits != fixed.map(|(bits, _)| bits) {
            "`fraction_bits` are 8 for iq8, 24 for iq24 and none for others".to_owned()
        } else if let Some((_, size)) = fixed
            && row.sizes != [size]
        {
            format!("this format needs {size} bytes, not {:?}", row.sizes)
        } else {
            continue;
        };
        defects.push(file.diagnostic(&format!("formats[{index}]"), message));
    }
    defects
}
