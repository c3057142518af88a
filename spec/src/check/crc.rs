//! A CRC's parameters yield its check value.

use crate::{Diagnostic, Spec};

pub(super) fn check(spec: &Spec) -> Vec<Diagnostic> {
    let mut defects = Vec::new();
    for file in &spec.protocols {
        let crc = &file.content.crc;
        let computed = crc.compute(b"123456789");
        if crc.width != 16 {
            let message = format!("a CRC of {} bits; only 16 are supported", crc.width);
            defects.push(file.diagnostic("crc.width", message));
        } else if computed != crc.check {
            let message = format!(
                "check value {:#06X}, but the parameters of {} yield {computed:#06X}",
                crc.check, crc.name
            );
            defects.push(file.diagnostic("crc.check", message));
        }
    }
    defects
}
