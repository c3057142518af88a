//! Which values registers take, compared with the YAML: this tests the generated tables.

#![allow(clippy::unwrap_used, clippy::indexing_slicing, clippy::panic)] // tests may stop at a surprise

use std::collections::HashMap;
use std::sync::LazyLock;

use actucheck_codec::register::{Access, Area, Device, Kind, RegisterError, Row};
use actucheck_codec::{ja_variant, ja40, xl330_m288, xm430_w210};
use actucheck_spec::Spec;
use actucheck_spec::model::{self, Type};
use proptest::prelude::*;

/// Values of registers by address.
type Held = HashMap<u16, i64>;

static SPEC: LazyLock<Spec> = LazyLock::new(|| Spec::embedded().unwrap());

/// Each device in the YAML, and as generated.
fn devices() -> [(&'static model::Device, &'static Device); 4] {
    [&ja40::DEVICE, &ja_variant::DEVICE, &xl330_m288::DEVICE, &xm430_w210::DEVICE]
        .map(|device| (SPEC.device(device.id).unwrap(), device))
}

#[test]
fn every_device_and_every_row_is_generated() {
    let devices = devices();
    assert_eq!(devices.len(), SPEC.devices.len());
    for (said, device) in devices {
        assert_eq!(said.registers.len(), device.registers.len());
        for (said, row) in said.registers.iter().zip(device.registers) {
            facts(said, row);
            assert_eq!(device.register(said.address), Some(*row));
            assert_eq!(device.register_named(&said.name), Some(*row));
        }
    }
}

fn facts(said: &model::Register, row: &Row) {
    assert_eq!((said.address, said.name.as_str()), (row.address, row.name));
    let kind = match said.kind {
        Type::U8 => Kind::U8,
        Type::I8 => Kind::I8,
        Type::U16 => Kind::U16,
        Type::I16 => Kind::I16,
        Type::U32 => Kind::U32,
        Type::I32 => Kind::I32,
    };
    assert_eq!((kind, said.kind.limits()), (row.kind, row.kind.limits()), "{}", row.name);
    assert_eq!(said.area == model::Area::Eeprom, row.area == Area::Eeprom);
    assert_eq!(said.access == model::Access::Rw, row.access == Access::ReadWrite);
    assert_eq!(said.initial, row.initial);
    let unit = row.unit.map(|unit| (unit.factor.to_bits(), unit.symbol));
    let said_unit = said.unit.as_ref().map(|unit| (unit.factor.to_bits(), unit.symbol.as_str()));
    assert_eq!(said_unit, unit);
    assert_eq!(said.bits.len(), row.bits.len());
    assert_eq!(said.range.as_ref().is_none_or(|range| SPEC.settles(range)), row.settled);
    let units = |unit: &model::Unit| (unit.factor.to_bits(), unit.symbol.clone());
    let said_meanings: Vec<_> =
        said.meanings.iter().map(|row| row.unit.as_ref().map(units)).collect();
    let meanings = row
        .meanings
        .iter()
        .map(|row| row.unit.map(|unit| (unit.factor.to_bits(), unit.symbol.to_owned())));
    assert_eq!(said_meanings, meanings.collect::<Vec<_>>());
    for named in &said.values {
        assert_eq!(row.value_name(named.value), Some(named.name.as_str()));
    }
}

/// The range in the YAML, or the one that applies for the values of other registers.
fn said_range<'a>(
    device: &model::Device,
    register: &'a model::Register,
    held: &Held,
) -> Option<&'a model::Range> {
    let holds = |when: &model::Condition| {
        let register = device.register(&when.register).unwrap();
        let Some(value) = held.get(&register.address) else { return false };
        let part = when.bits.as_ref().map_or(*value, |name| {
            let bits = register.bit_field(name).unwrap();
            (value >> bits.lowest) & ((1 << bits.width) - 1)
        });
        when.one_of.contains(&part)
    };
    let meaning = register.meanings.iter().find(|meaning| holds(&meaning.when));
    meaning.and_then(|meaning| meaning.range.as_ref()).or(register.range.as_ref())
}

/// The smallest and the largest value in the YAML, and the list if there is one.
fn said_limits(
    device: &model::Device,
    register: &model::Register,
    held: &Held,
) -> (i64, i64, Option<Vec<i64>>) {
    let (mut min, mut max) = register.kind.limits();
    let Some(range) = said_range(device, register, held) else { return (min, max, None) };
    let value = |bound: &Option<model::Bound>| match bound.as_ref()? {
        model::Bound::Value(value) => Some(*value),
        model::Bound::Register(name) => {
            let (sign, name) = name.strip_prefix('-').map_or((1, name.as_str()), |name| (-1, name));
            Some(sign * held.get(&device.register(name).unwrap().address)?)
        }
    };
    if let Some(bound) = value(&range.min) {
        min = min.max(bound);
    }
    if let Some(bound) = value(&range.max) {
        max = max.min(bound);
    }
    (min, max, range.one_of.clone())
}

/// Writing this value is allowed or refused as the YAML says, and the bytes are right.
fn judge(device: &model::Device, said: &model::Register, row: &Row, held: &Held, value: i64) {
    let (min, max, listed) = said_limits(device, said, held);
    let inside = min <= value && value <= max;
    let good = listed.as_ref().map_or(inside, |listed| inside && listed.contains(&value));
    let written = row.encode(value, |address| held.get(&address).copied());
    let name = row.name;
    if said.access == model::Access::R {
        assert_eq!(written, Err(RegisterError::ReadOnly { register: name }));
        assert_eq!(row.check(value, |address| held.get(&address).copied()).is_ok(), good);
        return;
    }
    let settled = said.range.as_ref().is_none_or(|range| SPEC.settles(range));
    let (smallest, largest) = said.kind.limits();
    if !settled {
        assert_eq!(row.check(value, |address| held.get(&address).copied()).is_ok(), good);
        assert_eq!(written.is_ok(), smallest <= value && value <= largest, "{name} {value}");
        return;
    }
    let unchecked = row.encode_unchecked(value);
    assert_eq!(unchecked.is_ok(), smallest <= value && value <= largest, "{name} {value}");
    // A device judges what it receives as a host judges what it sends.
    if let Ok(data) = unchecked {
        let accepted = row.accept(data.as_bytes(), |address| held.get(&address).copied());
        assert_eq!(accepted, written.map(|_| value), "{name} {value}");
    }
    match written {
        Ok(data) => {
            assert_eq!(unchecked, Ok(data), "{name}");
            assert!(good, "{name} takes {value}, though it is {min} to {max}, {listed:?}");
            let size = usize::from(said.kind.size());
            let expected: Vec<_> =
                (0..size).map(|byte| u8::try_from(value >> (8 * byte) & 0xFF).unwrap()).collect();
            assert_eq!(data.as_bytes(), expected, "{name}");
            assert_eq!(row.decode(data.as_bytes()), Some(value), "{name}");
        }
        Err(RegisterError::OutOfRange { register, value: told, min: low, max: high, .. }) => {
            assert!(!good, "{name} refuses {value}, though it is {min} to {max}");
            assert_eq!((register, told, low, high), (name, value, min, max));
        }
        Err(RegisterError::NotListed { register, value: told, listed: list }) => {
            assert!(!good, "{name} refuses {value}, though it is one of {listed:?}");
            assert_eq!((register, told, Some(list.to_vec())), (name, value, listed));
        }
        Err(error) => panic!("{error}"),
    }
}

/// Values at, just outside and far outside every limit of a register.
fn edges(device: &model::Device, register: &model::Register, held: &Held) -> Vec<i64> {
    let (min, max, listed) = said_limits(device, register, held);
    let (smallest, largest) = register.kind.limits();
    let mut ends = vec![0, min, max, smallest, largest, 1 << 32, -1 << 32];
    ends.extend(listed.unwrap_or_default());
    let steps = [-0x1_0000, -0x100, -1, 0, 1, 0x100, 0x1_0000];
    let near = ends.iter().flat_map(|end| steps.map(|step| end.saturating_add(step)));
    near.chain([i64::MIN, i64::MAX]).collect()
}

fn judge_all(held: &Held) {
    for (device, rows) in devices() {
        for (said, row) in device.registers.iter().zip(rows.registers) {
            for value in edges(device, said, held) {
                judge(device, said, row, held, value);
            }
        }
    }
}

#[test]
fn without_limits_only_the_size_limits_what_other_registers_would() {
    judge_all(&Held::new());
}

#[test]
fn the_initial_limits_count() {
    let mut held = Held::new();
    for (device, _) in devices() {
        let known = |row: &model::Register| Some((row.address, row.initial?));
        held.extend(device.registers.iter().filter_map(known));
    }
    judge_all(&held);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn whatever_the_limits_are_they_count(
        limits in prop::collection::hash_map(
            prop::sample::select(vec![10_u16, 11, 38, 40, 44, 48, 52]),
            prop_oneof![any::<i32>().prop_map(i64::from), -70_000..70_000_i64, 0..20_i64, Just(i64::MAX)],
            0..5,
        ),
        values in prop::collection::vec(any::<i64>(), 0..4),
    ) {
        judge_all(&limits);
        for (device, rows) in devices() {
            for (said, row) in device.registers.iter().zip(rows.registers) {
                for value in &values {
                    judge(device, said, row, &limits, *value);
                }
            }
        }
    }

    #[test]
    fn physical_values_come_back_and_saturate(count in any::<i64>(), physical in any::<f64>()) {
        for row in devices().iter().flat_map(|(_, device)| device.registers) {
            let (min, max) = row.kind.limits();
            let count = min + count.rem_euclid(max - min + 1);
            let back = row.physical(count).map(|physical| row.from_physical(physical));
            prop_assert_eq!(back, row.unit.map(|_| Some(count)), "{}", row.name);
            let Some(unit) = row.unit else { continue };
            let exact = physical / unit.factor;
            match row.from_physical(physical) {
                None => prop_assert!(physical.is_nan()),
                #[allow(clippy::cast_precision_loss)] // 32 bits fit
                Some(nearest) => {
                    let inside = exact.clamp(min as f64, max as f64);
                    prop_assert!((inside - nearest as f64).abs() <= 0.5, "{}", row.name);
                }
            }
        }
    }
}
