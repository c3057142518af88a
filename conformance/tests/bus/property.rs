//! What holds of every conversation: all that comes back is whole status packets, and no register leaves
//! its range. The reference model reads what comes, and the spec has the ranges.

use std::collections::BTreeMap;
use std::sync::LazyLock;
use std::time::Duration;

use actucheck::bus::{Setup, VirtualBus};
use actucheck_spec::Spec;
use actucheck_spec::model::{Access, Bound, Device, HexBytes, Range, Register};
use actucheck_spec::wire::dynamixel2::Packet;
use actucheck_spec::wire::dynamixel2::reference::{
    self, Event, events, register_bytes, register_number,
};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::{Index, select, subsequence};

static SPEC: LazyLock<Spec> = LazyLock::new(|| Spec::embedded().unwrap());

/// The devices, from ID 1 on.
const DEVICES: [&str; 5] = ["ja40", "ja40", "ja-variant", "xm430-w210", "xl330-m288"];
/// The longest packet.
const LONGEST: usize = 7 + 0xFFFF;

/// What a host does.
#[derive(Clone, Debug)]
enum Step {
    Packet {
        id: u8,
        instruction: u8,
        params: Vec<u8>,
    },
    /// Writes a register of one of the devices.
    Write {
        device: Index,
        register: Index,
        value: i64,
        id: u8,
    },
    /// Writes such a register by Fast Sync Write, of devices that have this instruction.
    FastWrite {
        register: Index,
        value: i64,
        ids: Vec<u8>,
    },
    Bytes(Vec<u8>),
    Wait(u64),
}

fn step() -> impl Strategy<Value = Step> {
    let id = || select(vec![1, 2, 3, 4, 5, 6, 254]);
    let byte = || prop_oneof![any::<u8>(), select(vec![0xFF, 0xFD, 0, 1, 2, 4])];
    let packet = |(id, instruction, params)| Step::Packet { id, instruction, params };
    // Neither gives a device the ID of another: their answers would meet.
    let plain = (id(), select(vec![1, 2, 5, 8, 9, 0x10, 0x82, 0x92]), vec(byte(), 0..12));
    let option = (id(), Just(6), select(vec![1, 2, 3]).prop_map(|option| vec![option]));
    let backup = (
        id(),
        Just(0x20),
        select(vec![1, 2, 3]).prop_map(|option| [&[option], b"CTRL".as_slice()].concat()),
    );
    let clear = (id(), Just(0x10), Just(b"\x01\x44\x58\x4C\x22".to_vec()));
    let fast = |ids: Vec<u8>| {
        (
            Just(254),
            Just(0x8A),
            (0_u16..900, 0_u16..12).prop_map(move |(address, length)| {
                [&address.to_le_bytes()[..], &length.to_le_bytes()[..], &ids].concat()
            }),
        )
    };
    let some = || subsequence(vec![1_u8, 2, 3], 1..=3).prop_shuffle();
    let value = || {
        prop_oneof![
            Just(0),
            -3_i64..20,
            0_i64..70_000,
            any::<i32>().prop_map(i64::from),
            select(vec![1, 2, 3, 4, 17, 16384, -16384, 2000, 6000])
        ]
    };
    let write = (any::<Index>(), any::<Index>(), value(), id());
    prop_oneof![
        2 => plain.prop_map(packet),
        1 => option.prop_map(packet),
        1 => backup.prop_map(packet),
        1 => clear.prop_map(packet),
        1 => some().prop_flat_map(fast).prop_map(packet),
        8 => write.prop_map(|(device, register, value, id)| {
            Step::Write { device, register, value, id }
        }),
        2 => (any::<Index>(), value(), some())
            .prop_map(|(register, value, ids)| Step::FastWrite { register, value, ids }),
        1 => vec(byte(), 0..30).prop_map(Step::Bytes),
        2 => (0_u64..3000).prop_map(Step::Wait),
    ]
}

/// A register that hosts may write, but none after which a device no longer answers a Read to its ID.
fn writable(device: &Device, index: Index) -> &Register {
    let silences = |row: &Register| ["ID", "Status Return Level"].contains(&row.name.as_str());
    let is_meant = |row: &&Register| row.access == Access::Rw && !silences(row);
    let rows: Vec<_> = device.registers.iter().filter(is_meant).collect();
    rows[index.index(rows.len())]
}

fn bytes(spec: &Spec, step: &Step) -> Vec<u8> {
    let packet = |id, instruction, params: Vec<u8>| {
        reference::encode(&Packet::Instruction { id, instruction, params: HexBytes(params) })
            .unwrap()
    };
    match step {
        Step::Packet { id, instruction, params } => packet(*id, *instruction, params.clone()),
        Step::Write { device, register, value, id } => {
            let device = spec.device(device.get::<&str>(&DEVICES)).unwrap();
            let register = writable(device, *register);
            let data = register_bytes(register, *value);
            packet(*id, 3, [&register.address.to_le_bytes()[..], &data].concat())
        }
        Step::FastWrite { register, value, ids } => {
            let register = writable(spec.device("ja40").unwrap(), *register);
            let data = register_bytes(register, *value);
            let length = register.kind.size().to_le_bytes();
            let blocks = ids.iter().flat_map(|id| [&[*id], data.as_slice()].concat());
            let head = [register.address.to_le_bytes(), length].concat();
            packet(254, 0x8B, head.into_iter().chain(blocks).collect())
        }
        Step::Bytes(bytes) => bytes.clone(),
        Step::Wait(_) => Vec::new(),
    }
}

/// What a register may hold while others hold this: bounds or a list; `None` if the documents don't
/// settle it, or leave nothing.
fn allowed(
    spec: &Spec,
    register: &Register,
    held: &BTreeMap<&str, i64>,
    device: &Device,
) -> Option<Vec<(i64, i64)>> {
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
    if !spec.settles(range) || !usual.is_none_or(|usual| spec.settles(usual)) {
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

/// What a device's registers hold, by their names.
fn registers<'s>(
    bus: &mut VirtualBus,
    id: u8,
    device: &'s Device,
    now: Duration,
) -> BTreeMap<&'s str, i64> {
    let hold = |register: &'s Register| {
        let size = register.kind.size();
        let params = [register.address.to_le_bytes(), size.to_le_bytes()].concat();
        let read = Packet::Instruction { id, instruction: 2, params: HexBytes(params) };
        bus.send(&reference::encode(&read).unwrap(), now);
        let answer = reference::decode(&bus.receive(now)).unwrap();
        let params = match &answer {
            Packet::Status { id: found, error, params }
                if *found == id && matches!(error, 0 | 0x80) =>
            {
                Some(params)
            }
            _ => None,
        };
        assert!(params.is_some(), "{} of device {id}: {answer:?}", register.name);
        (register.name.as_str(), register_number(register, params.unwrap()))
    };
    device.registers.iter().map(hold).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn what_comes_is_status_packets_and_registers_stay_in_their_ranges(steps in vec(step(), 1..16)) {
        let spec = &*SPEC;
        let places = (1..).zip(DEVICES).map(|(id, device)| format!("{device}@{id}").parse().unwrap());
        let mut bus = VirtualBus::new(spec, &places.collect::<Vec<_>>(), Setup::default()).unwrap();
        let mut now = Duration::ZERO;
        for step in &steps {
            if let Step::Wait(time) = step {
                now += Duration::from_millis(*time);
            }
            bus.send(&bytes(spec, step), now);
            // Bytes that may be the beginning of a packet are forgotten.
            now += Duration::from_millis(u64::from(matches!(step, Step::Bytes(_))) * 200);
            for event in events(&bus.receive(now), true, LONGEST) {
                let is_status = matches!(&event,
                    Event::Packet(_, Packet::Status { id: 1..=5, .. }) | Event::FastStatus(_));
                prop_assert!(is_status, "{event:?}");
            }
        }
        for (id, device) in (1..).zip(DEVICES) {
            let device = spec.device(device).unwrap();
            let held = registers(&mut bus, id, device, now);
            for register in &device.registers {
                let value = held[register.name.as_str()];
                let ranges = allowed(spec, register, &held, device);
                let is_in = ranges.iter().flatten().any(|(min, max)| (min..=max).contains(&&value));
                prop_assert!(ranges.is_none() || is_in, "{} is {value}: {ranges:?}", register.name);
            }
        }
    }
}
