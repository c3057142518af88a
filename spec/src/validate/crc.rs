//! Rule: a CRC's parameters yield its check value.

use crate::model::Crc;

/// A defect of a CRC, with its node.
pub(crate) fn fault(crc: &Crc) -> Option<(&'static str, String)> {
    let computed = crc.compute(b"123456789");
    if crc.width != 16 {
        let message = format!("a CRC of {} bits; only 16 are supported", crc.width);
        Some(("crc.width", message))
    } else if computed != crc.check {
        let message = format!(
            "check value {:#06X}, but the parameters of {} yield {computed:#06X}",
            crc.check, crc.name
        );
        Some(("crc.check", message))
    } else {
        None
    }
}
