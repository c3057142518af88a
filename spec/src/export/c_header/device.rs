use super::writer::{Constant, Header, lower, upper};
use crate::generate::places;
use crate::model::{BitField, Bound, Device, Range, Register, Type, Unit};

pub(super) fn write(device: &Device, header: &mut Header) {
    let prefix = upper(&device.device);
    header.title(&format!("{}: {}", device.title, places(&device.source)));
    if let Some(number) = device.model_number {
        let comment = "what Ping answers";
        let name = format!("{prefix}_MODEL_NUMBER");
        header.define(&Constant::new(name, format!("{number}U"), comment));
    }
    for row in &device.registers {
        let name = format!("{prefix}_{}", upper(&row.name));
        header.title(&about(device, row));
        header.define(&Constant::new(format!("{name}_ADDRESS"), format!("{}U", row.address), ""));
        header.define(&Constant::new(format!("{name}_SIZE"), format!("{}U", row.kind.size()), ""));
        let tag = format!("{}_{}", lower(&device.device), lower(&row.name));
        header.typedef(c_type(row.kind), &format!("{tag}_t"));
        numbers(row, &name, header);
        for meaning in &row.meanings {
            // Of a mode, or of bits for a mode: JA40_PROFILE_VELOCITY_TIME_BASED_PROFILE.
            let mode = meaning.when.values_in_words(device).join(" ");
            let name = format!("{name}_{}", upper(&mode));
            limits(row.kind, meaning.range.as_ref(), &name, header);
            unit(meaning.unit.as_ref(), &name, header);
        }
        for bits in &row.bits {
            self::bits(bits, &name, header);
        }
    }
}

fn about(device: &Device, row: &Register) -> String {
    let mut facts = vec![format!("{}: {}, {}", row.name, row.area, row.access)];
    facts.extend(row.range.as_ref().map(ToString::to_string));
    facts.extend(row.unit.as_ref().map(|unit| format!("one count is {unit}")));
    facts.extend(row.meanings.iter().map(|meaning| meaning.in_words(device)));
    facts.push(places(&row.source));
    facts.join("; ")
}

/// The physical value of one count, and its unit.
fn unit(unit: Option<&Unit>, name: &str, header: &mut Header) {
    if let Some(unit) = unit {
        let factor = format!("{:?}", unit.factor);
        header.define(&Constant::new(format!("{name}_SCALE"), factor, "of one count"));
        let symbol = format!("{:?}", unit.symbol);
        header.define(&Constant::new(format!("{name}_UNIT"), symbol, ""));
    }
}

/// The range as far as it is numbers.
fn limits(kind: Type, range: Option<&Range>, name: &str, header: &mut Header) {
    let ends = [
        ("MIN", range.and_then(|range| range.min.as_ref())),
        ("MAX", range.and_then(|range| range.max.as_ref())),
    ];
    for (end, bound) in ends {
        if let Some(Bound::Value(value)) = bound {
            let value = number(kind, *value);
            header.define(&Constant::new(format!("{name}_{end}"), value, ""));
        }
    }
}

/// Range, unit, the initial value and the named ones.
fn numbers(row: &Register, name: &str, header: &mut Header) {
    limits(row.kind, row.range.as_ref(), name, header);
    unit(row.unit.as_ref(), name, header);
    if let Some(value) = row.initial {
        let value = number(row.kind, value);
        header.define(&Constant::new(format!("{name}_INITIAL"), value, ""));
    }
    for value in &row.values {
        let constant = format!("{name}_{}", upper(&value.name));
        let number = number(row.kind, value.value);
        header.define(&Constant::new(constant, number, &value.name));
    }
}

fn bits(bits: &BitField, name: &str, header: &mut Header) {
    let name = format!("{name}_{}", upper(&bits.name));
    let mask = format!("UINT32_C({:#X})", bits.mask());
    header.define(&Constant::new(format!("{name}_MASK"), mask, &bits.name));
    header.define(&Constant::new(format!("{name}_SHIFT"), format!("{}U", bits.lowest), ""));
    for value in &bits.values {
        let constant = format!("{name}_{}", upper(&value.name));
        header.define(&Constant::new(constant, format!("{}U", value.value), &value.name));
    }
}

const fn c_type(kind: Type) -> &'static str {
    match kind {
        Type::U8 => "uint8_t",
        Type::I8 => "int8_t",
        Type::U16 => "uint16_t",
        Type::I16 => "int16_t",
        Type::U32 => "uint32_t",
        Type::I32 => "int32_t",
    }
}

/// A number of this type as a C constant, which is valid even if `int` has 16 bits.
fn number(kind: Type, value: i64) -> String {
    let magnitude = value.unsigned_abs();
    match kind {
        // C has no negative literals, and the smallest number's magnitude is too large for one.
        Type::I32 if value == i64::from(i32::MIN) => "INT32_MIN".to_owned(),
        Type::I32 if value < 0 => format!("(-INT32_C({magnitude}))"),
        Type::I32 => format!("INT32_C({value})"),
        Type::U32 => format!("UINT32_C({value})"),
        Type::U8 | Type::U16 => format!("{value}U"),
        Type::I8 | Type::I16 if value < 0 => format!("(-{magnitude})"),
        Type::I8 | Type::I16 => value.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_fit_their_types() {
        assert_eq!(number(Type::I32, i32::MIN.into()), "INT32_MIN");
        assert_eq!(number(Type::I32, -16384), "(-INT32_C(16384))");
        assert_eq!(number(Type::U32, u32::MAX.into()), "UINT32_C(4294967295)");
        assert_eq!(number(Type::I16, -1), "(-1)");
        assert_eq!(number(Type::U8, 255), "255U");
    }
}
