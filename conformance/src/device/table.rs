//! A control table at run time: what `actucheck_spec::generate` writes as Rust source, made from the
//! same model. Its parts are never freed: a run reads as many as the user names files.

use actucheck_codec::dynamixel2::Instruction;
use actucheck_codec::register::{
    Access, Area, BitField, Bound, Condition, Device, Kind, Meaning, NamedValue, Range, Row, Unit,
};
use actucheck_spec::model;

/// A name that nothing has. The rules of `actucheck_spec` leave none.
#[derive(Debug)]
pub(super) struct Absent(pub(super) String);

type Result<T> = std::result::Result<T, Absent>;

/// Whether the documents agree on a range.
type Settles<'s> = &'s dyn Fn(&model::Range) -> bool;

/// The device's table.
pub(super) fn of(settles: Settles<'_>, device: &model::Device) -> Result<Device> {
    let row = |row| Ok(&*Box::leak(Box::new(register(settles, device, row)?)));
    let lock = device.eeprom_lock.as_ref().map(|name| address(device, name));
    Ok(Device {
        id: text(&device.device),
        name: text(&device.title),
        model_number: device.model_number,
        complete: device.complete,
        instructions: kept(device.instructions.iter().map(|name| instruction(name)))?,
        eeprom_lock: lock.transpose()?,
        registers: kept(device.registers.iter().map(row))?,
    })
}

fn instruction(name: &str) -> Result<Instruction> {
    let mut all = (0..=u8::MAX).map(Instruction::from_code);
    all.find(|instruction| instruction.name() == name).ok_or_else(|| Absent(name.to_owned()))
}

fn register(settles: Settles<'_>, device: &model::Device, row: &model::Register) -> Result<Row> {
    let limits = |row: Option<&model::Range>| row.map(|row| range(device, row)).transpose();
    let meaning = |row: &model::Meaning| {
        Ok(Meaning {
            when: condition(device, &row.when)?,
            range: limits(row.range.as_ref())?,
            unit: row.unit.as_ref().map(unit),
        })
    };
    let bit_field = |row: &model::BitField| {
        let (name, values) = (text(&row.name), named(&row.values)?);
        Ok(BitField { name, lowest: row.lowest, width: row.width, values })
    };
    Ok(Row {
        name: text(&row.name),
        address: row.address,
        kind: kind(row.kind),
        area: match row.area {
            model::Area::Eeprom => Area::Eeprom,
            model::Area::Ram => Area::Ram,
        },
        access: match row.access {
            model::Access::R => Access::ReadOnly,
            model::Access::Rw => Access::ReadWrite,
        },
        initial: row.initial,
        range: limits(row.range.as_ref())?.unwrap_or(Range::Any),
        settled: row.range.iter().all(settles),
        unit: row.unit.as_ref().map(unit),
        meanings: kept(row.meanings.iter().map(meaning))?,
        values: named(&row.values)?,
        bits: kept(row.bits.iter().map(bit_field))?,
    })
}

const fn kind(kind: model::Type) -> Kind {
    match kind {
        model::Type::U8 => Kind::U8,
        model::Type::I8 => Kind::I8,
        model::Type::U16 => Kind::U16,
        model::Type::I16 => Kind::I16,
        model::Type::U32 => Kind::U32,
        model::Type::I32 => Kind::I32,
    }
}

fn unit(unit: &model::Unit) -> Unit {
    Unit { factor: unit.factor, symbol: text(&unit.symbol) }
}

fn range(device: &model::Device, range: &model::Range) -> Result<Range> {
    let bound = |bound: Option<&model::Bound>| {
        Ok(match bound.ok_or_else(|| Absent("bound".to_owned()))? {
            model::Bound::Value(value) => Bound::Value(*value),
            model::Bound::Register(name) => {
                let plain = name.trim_start_matches('-');
                Bound::Register { address: address(device, plain)?, negated: plain != name }
            }
        })
    };
    Ok(match &range.one_of {
        Some(values) => Range::OneOf(values.clone().leak()),
        None => Range::Between { min: bound(range.min.as_ref())?, max: bound(range.max.as_ref())? },
    })
}

fn condition(device: &model::Device, condition: &model::Condition) -> Result<Condition> {
    let register = named_register(device, &condition.register)?;
    let bits = condition
        .bits
        .as_ref()
        .map(|name| register.bit_field(name).ok_or_else(|| Absent(name.clone())));
    let whole = 64; // the whole value, with its sign
    let (lowest, width) =
        bits.transpose()?.map_or((0, whole), |bits| (bits.lowest.into(), bits.width.into()));
    Ok(Condition {
        address: register.address,
        lowest,
        width,
        one_of: condition.one_of.clone().leak(),
        words: text(&condition.in_words(device)),
    })
}

fn named(rows: &[model::NamedValue]) -> Result<&'static [NamedValue]> {
    kept(rows.iter().map(|row| Ok(NamedValue { value: row.value, name: text(&row.name) })))
}

fn address(device: &model::Device, name: &str) -> Result<u16> {
    named_register(device, name).map(|register| register.address)
}

fn named_register<'d>(device: &'d model::Device, name: &str) -> Result<&'d model::Register> {
    device.register(name).ok_or_else(|| Absent(name.to_owned()))
}

fn kept<T>(items: impl Iterator<Item = Result<T>>) -> Result<&'static [T]> {
    items.collect::<Result<Vec<_>>>().map(|items| &*items.leak())
}

fn text(text: &str) -> &'static str {
    text.to_owned().leak()
}

#[cfg(test)]
mod tests {
    use actucheck_spec::Spec;

    use super::super::KNOWN;
    use super::*;

    /// The generated tables and those made here come from the same model.
    #[test]
    fn a_table_made_at_run_time_equals_the_generated_one() {
        let spec = Spec::embedded().unwrap();
        for known in KNOWN {
            let settles = |range: &_| spec.settles(range);
            assert_eq!(of(&settles, spec.device(known.id).unwrap()).unwrap(), *known);
        }
        assert_eq!(spec.devices.len(), KNOWN.len());
    }
}
