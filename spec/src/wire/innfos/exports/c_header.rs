use super::super::{Command, FullScale, Innfos, WIRE};
use crate::export::c_header::{Constant, Header, lower, upper};

pub(super) fn write(innfos: &Innfos, header: &mut Header) {
    let (prefix, tag) = (upper(WIRE.id()), lower(WIRE.id()));
    let framing = &innfos.framing;
    header.title(&innfos.title);
    for (name, value, comment) in [
        ("HEADER", format!("{:#04X}U", framing.header), "the first byte"),
        ("TAIL", format!("{:#04X}U", framing.tail), "the last byte"),
        ("ADDRESS_BROADCAST", format!("{}U", framing.address.broadcast), ""),
        ("CRC_POLYNOMIAL", format!("{:#06X}U", innfos.crc.polynomial), &innfos.crc.name),
        ("CRC_INITIAL", format!("{:#06X}U", innfos.crc.initial), ""),
        ("CRC_CHECK", format!("{:#06X}U", innfos.crc.check), "of the characters 123456789"),
        ("UDP_PORT", format!("{}U", innfos.udp.port), "of the board"),
    ] {
        header.define(&Constant::new(format!("{prefix}_{name}"), value, comment));
    }
    for row in &innfos.formats {
        if let Some(bits) = row.fraction_bits {
            let name = format!("{prefix}_{}_FRACTION_BITS", upper(&row.format.to_string()));
            header.define(&Constant::new(name, format!("{bits}U"), ""));
        }
    }
    commands(innfos, &prefix, &tag, header);
    let modes = innfos.modes.rows.iter().map(|row| {
        let name = format!("{prefix}_MODE_{}", upper(&row.name));
        Constant::new(name, format!("{:#04X}", row.code), "")
    });
    header.enumeration(&format!("{tag}_mode"), &modes.collect::<Vec<_>>());
    let alarms = innfos.alarms.rows.iter().map(|row| {
        let name = format!("{prefix}_ALARM_{}", upper(&row.name));
        Constant::new(name, format!("{:#06X}", row.mask), "")
    });
    header.enumeration(&format!("{tag}_alarm"), &alarms.collect::<Vec<_>>());
    let named = innfos.alarms.rows.iter().fold(0, |named, row| named | row.mask);
    let others = format!("{prefix}_ALARM_{}_MASK", upper(&innfos.alarms.other));
    let comment = "every bit without a name of its own";
    header.define(&Constant::new(others, format!("{:#06X}U", !named), comment));
    for row in &innfos.actuators.rows {
        let name = format!("{prefix}_MODEL_{}", upper(&row.name));
        for (quantity, value, unit) in [
            ("CURRENT", row.current, "A"),
            ("MOTOR_SPEED", row.motor_speed, "revolutions a minute"),
            ("OUTPUT_SPEED", row.output_speed, "revolutions a minute"),
        ] {
            header.define(&Constant::new(format!("{name}_{quantity}"), format!("{value:?}"), unit));
        }
    }
}

/// A command's name is unique per access.
fn name(prefix: &str, row: &Command) -> String {
    format!("{prefix}_{}_{}", upper(&row.operation.to_string()), upper(&row.name))
}

fn commands(innfos: &Innfos, prefix: &str, tag: &str, header: &mut Header) {
    let codes = innfos.commands.iter().map(|row| {
        let format = row.format.map(|format| format.to_string());
        let facts: Vec<_> = format.into_iter().chain(row.unit.clone()).collect();
        Constant::new(name(prefix, row), format!("{:#04X}", row.code), facts.join(", "))
    });
    header.enumeration(&format!("{tag}_command"), &codes.collect::<Vec<_>>());
    for row in &innfos.commands {
        let name = name(prefix, row);
        let request =
            Constant::new(format!("{name}_REQUEST_SIZE"), format!("{}U", row.request), "");
        header.define(&request);
        // If a reply may have several sizes, the largest is the size of the buffer.
        let largest = row.reply.iter().max().copied().unwrap_or(0);
        let (constant, value) = (format!("{name}_REPLY_SIZE"), format!("{largest}U"));
        header.define(&Constant::new(constant, value, several(&row.reply)));
        if let Some(unit) = &row.unit {
            let comment = match row.full_scale {
                Some(FullScale::Current) => "times the model's CURRENT",
                Some(FullScale::MotorSpeed) => "times the model's MOTOR_SPEED",
                None => "",
            };
            header.define(&Constant::new(format!("{name}_UNIT"), format!("{unit:?}"), comment));
        }
        if let Some(factor) = row.factor {
            let comment = "the number on the wire of the value 1";
            header.define(&Constant::new(format!("{name}_FACTOR"), format!("{factor:?}"), comment));
        }
    }
}

fn several(sizes: &[u16]) -> String {
    match sizes {
        [] => "no reply".to_owned(),
        [_] => String::new(),
        _ => {
            let sizes: Vec<_> = sizes.iter().map(ToString::to_string).collect();
            format!("at most; {}", sizes.join(" or "))
        }
    }
}
