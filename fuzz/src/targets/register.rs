//! Values for registers, checked against the YAML itself and not against generated code.

use std::fmt::Debug;
use std::sync::LazyLock;

use actucheck_codec::dynamixel2::ErrorNumber;
use actucheck_codec::dynamixel2::instruction::Read;
use actucheck_codec::register::{self, Device, RegisterBlock, RegisterError, Row, Value};
use actucheck_codec::{ja_variant, ja40, xl330_m288, xm430_w210};
use actucheck_spec::model::{
    self, Access, Bound, Condition, ErrataFile, Range, Register, Status, Type,
};
use actucheck_spec::wire::dynamixel2::{Packet, reference};
use arbitrary::{Result, Unstructured};

use crate::targets::shown;
use crate::yaml;

const DEVICES: [Device; 4] =
    [ja40::DEVICE, ja_variant::DEVICE, xl330_m288::DEVICE, xm430_w210::DEVICE];
static SAID: LazyLock<[model::Device; 4]> =
    LazyLock::new(|| DEVICES.map(|device| yaml::read(&format!("devices/{}.yaml", device.id))));

/// Ids of the open errata.
static OPEN: LazyLock<Vec<String>> = LazyLock::new(|| {
    let file: ErrataFile = yaml::read("errata.yaml");
    let open = file.errata.into_iter().filter(|row| row.status == Status::Open);
    open.map(|row| row.id).collect()
});

/// The input selects a device, a register, the values of the registers that limit it, and a value.
///
/// # Panics
/// If the codec is wrong.
pub fn check(input: &[u8]) {
    // The choices may end early; then there is no value.
    let _ = choose(&mut Unstructured::new(input));
}

fn choose(choices: &mut Unstructured<'_>) -> Result<()> {
    let index = choices.choose_index(DEVICES.len())?;
    let (device, said) = (&DEVICES[index], &SAID[index]);
    let register = &said.registers[choices.choose_index(said.registers.len())?];
    let row = device.register(register.address).unwrap();
    assert_eq!((row.name, row.kind.size()), (&register.name[..], register.kind.size()));
    assert_eq!(device.register_named(row.name), Some(row));

    // The values of the registers that limit others; if absent, only the size limits.
    let held: Option<[i32; 2]> = choices.arbitrary()?;
    let limits = Limits { device: said, held };
    let value = value(choices, register, &limits)?;
    write(row, register, &limits, value);
    if device.id == "ja40" {
        typed_by_name(register, &limits, value);
    }
    read(row, register, choices.arbitrary()?);
    neighbours(device, said, register.address, choices.arbitrary()?);
    Ok(())
}

/// The values of other registers: one number if the address is a multiple of 8, otherwise another.
struct Limits<'a> {
    device: &'a model::Device,
    held: Option<[i32; 2]>,
}

impl Limits<'_> {
    fn at(&self, address: u16) -> Option<i64> {
        self.held.map(|[even, odd]| if address.is_multiple_of(8) { even } else { odd }.into())
    }

    /// The number of a bound; `None` if there is no limit.
    fn of(&self, bound: &Bound) -> Option<i64> {
        match bound {
            Bound::Value(value) => Some(*value),
            Bound::Register(name) => {
                let (plain, sign) =
                    name.strip_prefix('-').map_or((&name[..], 1), |name| (name, -1));
                self.at(self.device.register(plain).unwrap().address).map(|held| sign * held)
            }
        }
    }
}

impl Limits<'_> {
    fn hold(&self, when: &Condition) -> bool {
        let register = self.device.register(&when.register).unwrap();
        self.at(register.address).is_some_and(|held| {
            let part = when.bits.as_ref().map_or(held, |name| {
                let bits = register.bit_field(name).unwrap();
                (held >> bits.lowest) & ((1 << bits.width) - 1)
            });
            when.one_of.contains(&part)
        })
    }
}

/// One in, at, just outside or far outside what the register takes, or any.
fn value(choices: &mut Unstructured<'_>, register: &Register, limits: &Limits<'_>) -> Result<i64> {
    let (smallest, largest) = width(register.kind);
    let mut ends = vec![smallest, largest, 0, i64::MIN, i64::MAX];
    if let Some(range) = &register.range {
        ends.extend(
            [&range.min, &range.max].into_iter().flatten().filter_map(|end| limits.of(end)),
        );
        ends.extend(range.one_of.iter().flatten());
    }
    ends.extend(register.values.iter().map(|row| row.value));
    Ok(match choices.int_in_range(0..=4)? {
        0 => choices.arbitrary()?,
        1 => choices.int_in_range(smallest..=largest)?,
        step => ends[choices.choose_index(ends.len())?].saturating_add(i64::from(step) - 3),
    })
}

/// The smallest and largest value of this many bytes, computed from their number and sign alone.
fn width(kind: Type) -> (i64, i64) {
    let bits = 8 * kind.size();
    match kind {
        Type::U8 | Type::U16 | Type::U32 => (0, (1 << bits) - 1),
        Type::I8 | Type::I16 | Type::I32 => (-(1 << (bits - 1)), (1 << (bits - 1)) - 1),
    }
}

/// Whether hosts may write it, and the register may have it. A range that rests on an open erratum
/// forbids nothing.
fn allowed(register: &Register, limits: &Limits<'_>, value: i64) -> bool {
    let (smallest, largest) = width(register.kind);
    let settled = |range: &&Range| !range.errata.iter().any(|id| OPEN.contains(id));
    let range = register.range.as_ref().filter(settled);
    let meaning = register.meanings.iter().find(|meaning| limits.hold(&meaning.when));
    let range = range.map(|range| meaning.and_then(|row| row.range.as_ref()).unwrap_or(range));
    let in_range = |range: &Range| {
        let min = range.min.as_ref().and_then(|min| limits.of(min));
        let max = range.max.as_ref().and_then(|max| limits.of(max));
        min.is_none_or(|min| value >= min)
            && max.is_none_or(|max| value <= max)
            && range.one_of.as_ref().is_none_or(|listed| listed.contains(&value))
    };
    register.access == Access::Rw
        && (smallest..=largest).contains(&value)
        && range.is_none_or(in_range)
}

fn write(row: &Row, register: &Register, limits: &Limits<'_>, value: i64) {
    let size = usize::from(register.kind.size());
    let written = row.encode(value, |address| limits.at(address));
    let held = limits.held;
    assert_eq!(
        written.is_ok(),
        allowed(register, limits, value),
        "{} = {value}, {held:?}",
        row.name
    );
    if let Err(error) = &written {
        let refused = error.number() == ErrorNumber::AccessError;
        assert_eq!(refused, register.access == Access::R, "{error}");
    }
    let Ok(data) = written.inspect_err(shown) else { return };
    assert_eq!(data.as_bytes(), &value.to_le_bytes()[..size], "{} = {value}", row.name);
    assert_eq!(row.decode(data.as_bytes()), Some(value), "{}", row.name);

    let name = register.values.iter().find(|named| named.value == value);
    assert_eq!(row.value_name(value), name.map(|named| &named.name[..]));
    // A unit gives the count back.
    let physical = row.physical(value);
    assert_eq!(physical.is_some(), register.unit.is_some());
    assert_eq!(
        physical.and_then(|physical| row.from_physical(physical)),
        physical.and(Some(value))
    );
}

/// The same by some of the device module's constants, one of each kind of value.
fn typed_by_name(register: &Register, limits: &Limits<'_>, value: i64) {
    match register.name.as_str() {
        "Drive Mode" => typed(ja40::DRIVE_MODE, register, limits, value),
        "Operating Mode" => typed(ja40::OPERATING_MODE, register, limits, value),
        "Goal Current" => typed(ja40::GOAL_CURRENT, register, limits, value),
        "Goal Position" => typed(ja40::GOAL_POSITION, register, limits, value),
        "Present Position" => typed(ja40::PRESENT_POSITION, register, limits, value),
        _ => {}
    }
}

fn typed<T: Value + PartialEq + Debug>(
    constant: register::Register<T>,
    register: &Register,
    limits: &Limits<'_>,
    value: i64,
) {
    let size = register.kind.size();
    let typed = T::from_raw(value);
    let (smallest, largest) = width(register.kind);
    assert_eq!(typed.is_some(), (smallest..=largest).contains(&value), "{value}");
    let Some(typed) = typed else { return };
    assert_eq!(typed.raw(), value);
    let bytes = &value.to_le_bytes()[..size.into()];
    assert_eq!(constant.decode(bytes), Ok(typed));
    in_a_block(constant, typed, bytes);
    let unit = |physical| constant.from_physical(physical);
    assert_eq!(constant.physical(typed).and_then(unit), register.unit.as_ref().map(|_| typed));

    let address = register.address.to_le_bytes();
    let read = [address, size.to_le_bytes()].concat();
    assert_eq!(constant.read(1).encode(&mut [0; 32]), Ok(&packet(2, read)[..]));
    let write = constant.write_within(1, typed, |address| limits.at(address));
    assert_eq!(write.is_ok(), allowed(register, limits, value), "{} = {value}", register.name);
    let Ok(write) = write.inspect_err(shown) else { return };
    // The values of other registers can only restrict the range.
    assert_eq!(constant.write(1, typed), Ok(write));
    assert_eq!(write.data().as_ref(), bytes);
    let params = [&address, bytes].concat();
    assert_eq!(write.encode(&mut [0; 32]), Ok(&packet(3, params.clone())[..]));
    assert_eq!(write.registered().encode(&mut [0; 32]), Ok(&packet(4, params)[..]));
}

/// The value is found in a block that has all of the register's bytes, and in no block that begins
/// after the first of them.
fn in_a_block<T: Value + PartialEq + Debug>(
    constant: register::Register<T>,
    value: T,
    bytes: &[u8],
) {
    let covering = Read::covering(&[constant.row]);
    let Row { address, kind, .. } = *constant.row;
    assert_eq!(covering, Read { address, length: kind.size() });
    assert_eq!(RegisterBlock::new(address, bytes).value(constant), Ok(value));
    let with_neighbour = [&[0x5A], bytes].concat();
    assert_eq!(RegisterBlock::new(address - 1, &with_neighbour).value(constant), Ok(value));
    let further = RegisterBlock::new(address + 1, bytes).value(constant).inspect_err(shown);
    assert!(matches!(further, Err(RegisterError::NotInBlock { .. })));
}

/// An instruction packet to device 1.
fn packet(instruction: u8, params: Vec<u8>) -> Vec<u8> {
    let packet = Packet::Instruction { id: 1, instruction, params: params.into() };
    reference::encode(&packet).unwrap()
}

/// The registers that are wholly within this many bytes.
fn neighbours(device: &Device, said: &model::Device, address: u16, length: u8) {
    let wholly_in = |register: &&Register| {
        let end = register.address + register.kind.size();
        register.address >= address && end <= address + u16::from(length)
    };
    let expected = said.registers.iter().filter(wholly_in).map(|register| register.address);
    let found = device.registers_in(address, length.into()).map(|row| row.address);
    assert!(found.eq(expected), "{length} bytes from {address}");
}

/// Bytes of the register's size are a value; any other number of bytes is an error.
fn read(row: &Row, register: &Register, bytes: [u8; 5]) {
    let size = usize::from(register.kind.size());
    for wrong in (0..=bytes.len()).filter(|len| *len != size) {
        assert_eq!(row.decode(&bytes[..wrong]), None, "{}", row.name);
    }
    let unsigned = bytes[..size].iter().rev().fold(0, |high, byte| high << 8 | i64::from(*byte));
    let (_, largest) = width(register.kind);
    for (field, said) in row.bits.iter().zip(&register.bits) {
        let expected = (unsigned.cast_unsigned() & said.mask()) >> said.lowest;
        assert_eq!(field.of(unsigned).cast_unsigned(), expected, "{} of {}", field.name, row.name);
    }
    let value = if unsigned > largest { unsigned - (1 << (8 * size)) } else { unsigned };
    assert_eq!(row.decode(&bytes[..size]), Some(value), "{}", row.name);
}
