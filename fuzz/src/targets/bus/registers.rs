//! What registers hold, and what they may hold.

use std::collections::BTreeMap;
use std::time::Duration;

use actucheck::bus::VirtualBus;
use actucheck_spec::model::{Bound, Device, HexBytes, Range, Register};
use actucheck_spec::wire::dynamixel2::Packet;
use actucheck_spec::wire::dynamixel2::reference::{self, register_number};

use super::{ANSWERED, SPEC};

/// What each register holds, by its name.
type Held<'s> = BTreeMap<&'s str, i64>;

/// Reads every register of a device.
pub(super) fn check(bus: &mut VirtualBus, id: u8, device: &Device, now: Duration) {
    let registers = device.registers.iter();
    let held: Held<'_> =
        registers.map(|register| (register.name.as_str(), read(bus, id, register, now))).collect();
    for register in &device.registers {
        let value = held[register.name.as_str()];
        let ranges = allowed(register, &held, device);
        let is_in = ranges.iter().flatten().any(|(min, max)| (min..=max).contains(&&value));
        assert!(ranges.is_none() || is_in, "{} of {id} is {value}: {ranges:?}", register.name);
    }
}

fn read(bus: &mut VirtualBus, id: u8, register: &Register, now: Duration) -> i64 {
    let params = [register.address.to_le_bytes(), register.kind.size().to_le_bytes()].concat();
    let read = Packet::Instruction { id, instruction: 2, params: HexBytes(params) };
    bus.send(&reference::encode(&read).unwrap(), now);
    let answer = reference::decode(&bus.receive(now + ANSWERED)).unwrap();
    match answer {
        Packet::Status { id: found, error: 0 | 0x80, params } if found == id => {
            register_number(register, &params)
        }
        // The address that it stands for may have no register.
        Packet::Status { id: found, error: 0x07 | 0x87, .. }
            if found == id && register.name.starts_with("Indirect Data") =>
        {
            0
        }
        other => panic!("{} of {id}: {other:?}", register.name),
    }
}

/// Bounds or a list; `None` if the documents don't settle them, or leave nothing.
fn allowed(register: &Register, held: &Held<'_>, device: &Device) -> Option<Vec<(i64, i64)>> {
    let meaning = register.meanings.iter().find(|meaning| {
        let when = &meaning.when;
        let field = when
            .bits
            .as_ref()
            .and_then(|name| device.register(&when.register).unwrap().bit_field(name));
        let value = held[when.register.as_str()];
        let value = field.map_or(value, |bits| value >> bits.lowest & ((1 << bits.width) - 1));
        when.one_of.contains(&value)
    });
    let usual = register.range.as_ref();
    let range: &Range = meaning.and_then(|meaning| meaning.range.as_ref()).or(usual)?;
    if !SPEC.settles(range) || !usual.is_none_or(|usual| SPEC.settles(usual)) {
        return None;
    }
    let bound = |bound: &Bound| match bound {
        Bound::Value(value) => *value,
        Bound::Register(name) => match name.strip_prefix('-') {
            Some(name) => -held[name],
            None => held[name.as_str()],
        },
    };
    let bounds =
        (range.min.as_ref().map_or(i64::MIN, bound), range.max.as_ref().map_or(i64::MAX, bound));
    Some(match &range.one_of {
        Some(values) => values.iter().map(|value| (*value, *value)).collect(),
        None if bounds.0 > bounds.1 => return None,
        None => vec![bounds],
    })
}
