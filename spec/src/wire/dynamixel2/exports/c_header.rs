use super::super::{Dynamixel2, WIRE};
use crate::export::c_header::{Constant, Header, lower, upper};

pub(super) fn write(wire: &Dynamixel2, header: &mut Header) {
    let (prefix, tag) = (upper(WIRE.id()), lower(WIRE.id()));
    let id = &wire.framing.id;
    let status = &wire.status;
    header.title(&wire.title);
    for (name, value, comment) in [
        ("ID_MIN", format!("{}U", id.min), "smallest ID of a device"),
        ("ID_MAX", format!("{}U", id.max), "largest ID of a device"),
        ("ID_BROADCAST", format!("{}U", id.broadcast), "the ID that every device obeys"),
        ("LENGTH_MIN", format!("{}U", wire.framing.length.minimum), "smallest length"),
        ("CRC_POLYNOMIAL", format!("{:#06X}U", wire.crc.polynomial), &wire.crc.name),
        ("CRC_INITIAL", format!("{:#06X}U", wire.crc.initial), ""),
        ("CRC_CHECK", format!("{:#06X}U", wire.crc.check), "of the characters 123456789"),
        ("STUFFING", format!("{:#04X}U", wire.stuffing.insert), "inserted by stuffing"),
        ("STATUS", format!("{:#04X}U", status.instruction), "the instruction of a status packet"),
        ("ALERT_MASK", format!("{:#04X}U", 1_u64 << status.alert_bit), "of the error byte"),
    ] {
        header.define(&Constant::new(format!("{prefix}_{name}"), value, comment));
    }
    let instructions = wire.instructions.iter().map(|row| {
        let name = format!("{prefix}_INSTRUCTION_{}", upper(&row.name));
        Constant::new(name, format!("{:#04X}", row.code), &row.summary)
    });
    header.enumeration(&format!("{tag}_instruction"), &instructions.collect::<Vec<_>>());
    for row in &wire.instructions {
        for field in &row.parameters {
            let Some(fixed) = &field.fixed else { continue };
            let name = format!("{prefix}_{}_{}", upper(&row.name), upper(&field.name));
            let bytes: Vec<_> = fixed.iter().map(|byte| format!("{byte:#04X}U")).collect();
            let value = format!("{{{}}}", bytes.join(", "));
            header.define(&Constant::new(name, value, "the bytes that it always has"));
        }
    }
    let errors = status.errors.iter().map(|row| {
        // Most names end with the word that the prefix already has.
        let name = row.name.strip_suffix(" Error").unwrap_or(&row.name);
        let name = format!("{prefix}_ERROR_{}", upper(name));
        Constant::new(name, format!("{:#04X}", row.number), &row.summary)
    });
    header.enumeration(&format!("{tag}_error"), &errors.collect::<Vec<_>>());
}
