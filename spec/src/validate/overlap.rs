//! Rule: registers are in ascending order of address and don't overlap.

use crate::{Diagnostic, Spec};

pub(super) fn check(spec: &Spec) -> Vec<Diagnostic> {
    let mut defects = Vec::new();
    for file in &spec.devices {
        let registers = &file.content.registers;
        for (index, (earlier, later)) in registers.iter().zip(registers.iter().skip(1)).enumerate()
        {
            let end = u32::from(earlier.address) + u32::from(earlier.kind.size());
            let node = format!("registers[{}].address", index + 1);
            if later.address < earlier.address {
                let message = format!(
                    "{}({}) is after {}({}); registers are in ascending order of address",
                    later.name, later.address, earlier.name, earlier.address
                );
                defects.push(file.diagnostic(&node, message));
            } else if later.address > earlier.address && u32::from(later.address) < end {
                let message = format!(
                    "{}({}) overlaps {}, whose {} bytes begin at {}",
                    later.name,
                    later.address,
                    earlier.name,
                    earlier.kind.size(),
                    earlier.address
                );
                defects.push(file.diagnostic(&node, message));
            }
        }
    }
    defects
}
