//! Packets and streams that are generated from a seed. The same seed yields the same checks.

use actucheck_spec::Spec;
use actucheck_spec::model::{Access, Bound, Register};
use actucheck_spec::wire::Direction;
use actucheck_spec::wire::dynamixel2::Packet;
use actucheck_spec::wire::dynamixel2::reference::{self, BROADCAST, HEADER};
use proptest::collection::vec;
use proptest::prelude::{Just, Strategy, any};
use proptest::prop_oneof;
use proptest::sample::select;
use proptest::strategy::{SBoxedStrategy, Union, ValueTree};

use super::streams::resumed;
use super::{BACKUP, CLEAR, parameters_of};
use crate::suite::Author;
use crate::suite::check::Check;
use crate::suite::plan::{Family, Group};
use crate::suite::random::{data, runner};

/// The parts of a generated case.
#[derive(Clone, Debug)]
struct Case {
    instruction: (&'static str, Packet),
    /// A Write of a value within a register's range.
    register: Packet,
    status: Packet,
    /// Noise before and after the status packet in a stream.
    noise: [Vec<u8>; 2],
    /// Where the stream is cut, in units of 1/256 of its length.
    cuts: Vec<u8>,
    /// What comes before the status packet in one stream, and after it in another.
    damage: [Damage; 2],
}

/// Something that looks like a packet but is not one.
#[derive(Clone, Debug)]
enum Damage {
    /// The status packet without its end; the place of the cut in units of 1/256.
    Cut(u8),
    /// A header, ID and length, followed by other bytes.
    FalseHeader { id: u8, length: u16, behind: Vec<u8> },
}

impl Damage {
    const fn name(&self) -> &'static str {
        match self {
            Self::Cut(_) => "a packet that is cut short",
            Self::FalseHeader { .. } => "a header that no packet follows",
        }
    }

    /// Its bytes, in a stream with the given packet.
    fn bytes(&self, frame: &[u8]) -> Vec<u8> {
        match self {
            Self::Cut(end) => {
                let end = 1 + frame.len().saturating_sub(1) * usize::from(*end) / 256;
                frame.get(..end).unwrap_or_default().to_vec()
            }
            Self::FalseHeader { id, length, behind } => {
                [&HEADER[..], &[*id], &length.to_le_bytes(), behind].concat()
            }
        }
    }
}

/// What the checks of a case are called.
const NAMES: [&str; 10] = [
    ".instruction/encode",
    ".instruction/decode",
    ".status/encode",
    ".status/decode",
    ".register/encode",
    ".register/decode",
    "/stream",
    "/bytewise",
    ".damaged/resume",
    ".damaged/end",
];

/// A case is drawn when its turn comes, and those before it have to be drawn for it. Its id is known
/// without.
pub(super) fn family(author: Author<'_>, seed: u64, cases: u32) -> Family<'_> {
    let id = move |number| format!("dynamixel2.seed-{seed}.{number}");
    Family::new(format!("dynamixel2.seed-{seed}."), move || {
        let (mut runner, strategy) = (runner(seed), case(author.spec));
        (0..cases).filter_map(move |number| {
            // A strategy without filters always yields a value.
            let case = strategy.new_tree(&mut runner).ok()?.current();
            Some(Group::new(id(number), &NAMES, move |id| of(&author, id, &case)))
        })
    })
    .with_names(move || {
        (0..cases).map(move |number| Group::new(id(number), &NAMES, |_| Vec::new()))
    })
}

fn of(author: &Author<'_>, id: &str, case: &Case) -> Vec<Check> {
    let (name, instruction) = &case.instruction;
    let requirement = parameters_of(author.spec, name);
    let mut checks = author.both_ways(&format!("{id}.instruction"), &requirement, instruction);
    let layout = "dynamixel2.status-packet.layout";
    checks.extend(author.both_ways(&format!("{id}.status"), layout, &case.status));

    let requirement = parameters_of(author.spec, "Write");
    checks.extend(author.both_ways(&format!("{id}.register"), &requirement, &case.register));

    let frame = reference::encode(&case.status).unwrap_or_default();
    let [before, behind] = &case.noise;
    let stream = [before.as_slice(), &frame, behind, &frame].concat();
    let requirement = "dynamixel2.receive.stream";
    checks.push(author.streamed(
        format!("{id}/stream"),
        requirement,
        Direction::Reply,
        &split(&stream, &case.cuts),
    ));
    let bytes: Vec<_> = stream.iter().map(|byte| vec![*byte]).collect();
    checks.push(author.streamed(format!("{id}/bytewise"), requirement, Direction::Reply, &bytes));

    let [before, behind] = &case.damage;
    let stream = split(&[before.bytes(&frame).as_slice(), &frame].concat(), &case.cuts);
    checks.push(resumed(author, format!("{id}.damaged/resume"), before.name(), &stream));
    let stream = split(&[frame.as_slice(), &behind.bytes(&frame)].concat(), &case.cuts);
    checks.push(author.streamed(
        format!("{id}.damaged/end"),
        requirement,
        Direction::Reply,
        &stream,
    ));
    checks
}

/// The stream in chunks. A cut is in units of 1/256 of its length.
fn split(stream: &[u8], cuts: &[u8]) -> Vec<Vec<u8>> {
    let mut places: Vec<_> =
        cuts.iter().map(|cut| stream.len() * usize::from(*cut) / 256).collect();
    places.extend([0, stream.len()]);
    places.sort_unstable();
    let pairs = places.iter().zip(places.iter().skip(1));
    pairs.map(|(from, to)| stream.get(*from..*to).unwrap_or_default().to_vec()).collect()
}

fn case(spec: &Spec) -> impl Strategy<Value = Case> + use<> {
    let noise = || vec(any::<u8>().prop_map(|byte| if byte == 0xFF { 0 } else { byte }), 0..12);
    let cuts = vec(any::<u8>(), 0..6);
    let damage = [damage(), damage()];
    (instruction(), status(), [noise(), noise()], cuts, register(spec), damage).prop_map(
        |(instruction, status, noise, cuts, register, damage)| Case {
            instruction,
            register,
            status,
            noise,
            cuts,
            damage,
        },
    )
}

fn damage() -> impl Strategy<Value = Damage> {
    // About as long as the rest, or any length.
    let length = prop_oneof![2..24_u16, any::<u16>()];
    let header = (id(), length, vec(any::<u8>(), 0..8));
    prop_oneof![
        any::<u8>().prop_map(Damage::Cut),
        header.prop_map(|(id, length, behind)| Damage::FalseHeader { id, length, behind }),
    ]
}

/// A Write to a register of any device: the ends of its range, or a value between them.
fn register(spec: &Spec) -> impl Strategy<Value = Packet> + use<> {
    let devices = spec.devices.iter().map(|file| &file.content);
    let registers = devices.flat_map(|device| &device.registers);
    let writable: Vec<_> = registers
        .filter(|register| register.access == Access::Rw)
        .map(|register| (register.address, usize::from(register.kind.size()), limits(register)))
        .collect();
    (id(), select(writable)).prop_flat_map(|(id, (address, size, (min, max)))| {
        prop_oneof![Just(min), Just(max), min..=max].prop_map(move |value| {
            let address = address.to_le_bytes();
            let value = value.to_le_bytes();
            let params = [&address, value.get(..size).unwrap_or_default()].concat();
            packet(id, 0x03, params)
        })
    })
}

/// The smallest and the largest value of a register. If another register limits it, the limits of
/// its size are used. If the document lists values, some values between the two are not allowed.
fn limits(register: &Register) -> (i64, i64) {
    let (least, greatest) = register.kind.limits();
    let Some(range) = &register.range else { return (least, greatest) };
    let number = |bound: &Option<Bound>| match bound {
        Some(Bound::Value(value)) => Some(*value),
        _ => None,
    };
    let one_of = range.one_of.iter().flatten().copied();
    let min = number(&range.min).or_else(|| one_of.clone().min());
    let max = number(&range.max).or_else(|| one_of.max());
    (min.unwrap_or(least), max.unwrap_or(greatest))
}

/// Half of the addresses are below 256, as some libraries support no others.
fn address() -> impl Strategy<Value = [u8; 2]> {
    (any::<u8>(), prop_oneof![Just(0), any::<u8>()]).prop_map(|(low, high)| [low, high])
}

fn id() -> impl Strategy<Value = u8> {
    0..=252_u8
}

pub(crate) fn status() -> impl Strategy<Value = Packet> {
    // Many libraries return no data if there is an error.
    let error = prop_oneof![3 => Just(0), 1 => any::<u8>()];
    (id(), error, data(0..24)).prop_map(|(id, error, params)| Packet::Status {
        id,
        error,
        params: params.into(),
    })
}

/// Any instruction, with its name and parameters that fit it.
pub(crate) fn instruction() -> impl Strategy<Value = (&'static str, Packet)> {
    let register = || (address(), data(1..12));
    let write = |(address, data): ([u8; 2], Vec<u8>)| [&address, data.as_slice()].concat();
    let read = (address(), 1..=512_u16)
        .prop_map(|(address, length)| [address, length.to_le_bytes()].concat());
    let same = |data: bool| {
        (address(), 1..8_usize, vec(id(), 1..5), data_pool())
            .prop_map(move |(address, size, ids, pool)| several(address, size, &ids, &pool, data))
    };
    let bulk_read = vec((id(), address(), 1..=512_u16), 1..5).prop_map(|devices| {
        let device = |(id, address, length): &(u8, [u8; 2], u16)| {
            [&[*id], address.as_slice(), &length.to_le_bytes()].concat()
        };
        first_of_each(&devices, |device| device.0).flat_map(device).collect()
    });
    let bulk_write = vec((id(), address(), data(1..8)), 1..4).prop_map(|devices| {
        let device = |(id, address, data): &(u8, [u8; 2], Vec<u8>)| {
            let length = u16::try_from(data.len()).unwrap_or_default().to_le_bytes();
            [&[*id], address.as_slice(), &length, data].concat()
        };
        first_of_each(&devices, |device| device.0).flat_map(device).collect()
    });
    let one = |name, code, params: SBoxedStrategy<Vec<u8>>| {
        (id(), params).prop_map(move |(id, params)| (name, packet(id, code, params))).sboxed()
    };
    let all = |name, code, params: SBoxedStrategy<Vec<u8>>| {
        params.prop_map(move |params| (name, packet(BROADCAST, code, params))).sboxed()
    };
    let none = || Just(Vec::new()).sboxed();
    let option = prop_oneof![Just(vec![0xFF]), Just(vec![0x01]), Just(vec![0x02])];
    let clear = Just(CLEAR.to_vec()).sboxed();
    let backup = Just(BACKUP.to_vec()).sboxed();
    Union::new_weighted(vec![
        (1, one("Ping", 0x01, none())),
        (2, one("Read", 0x02, read.sboxed())),
        (6, one("Write", 0x03, register().prop_map(write).sboxed())),
        (3, one("Reg Write", 0x04, register().prop_map(write).sboxed())),
        (1, one("Action", 0x05, none())),
        (1, one("Factory Reset", 0x06, option.sboxed())),
        (1, one("Reboot", 0x08, none())),
        (1, one("Clear", 0x10, clear)),
        (1, one("Control Table Backup", 0x20, backup)),
        (2, all("Sync Read", 0x82, same(false).sboxed())),
        (4, all("Sync Write", 0x83, same(true).sboxed())),
        (2, all("Fast Sync Read", 0x8A, same(false).sboxed())),
        (2, all("Fast Sync Write", 0x8B, same(true).sboxed())),
        (2, all("Bulk Read", 0x92, bulk_read.sboxed())),
        (2, all("Bulk Write", 0x93, bulk_write.sboxed())),
    ])
}

/// Enough data for every device of a sync instruction.
fn data_pool() -> impl Strategy<Value = Vec<u8>> {
    data(40..41)
}

fn packet(id: u8, instruction: u8, params: Vec<u8>) -> Packet {
    Packet::Instruction { id, instruction, params: params.into() }
}

/// The parameters of a sync instruction.
fn several(address: [u8; 2], size: usize, ids: &[u8], pool: &[u8], data: bool) -> Vec<u8> {
    let length = u16::try_from(size).unwrap_or_default().to_le_bytes();
    let mut params = [address, length].concat();
    for (index, id) in first_of_each(ids, |id| *id).enumerate() {
        params.push(*id);
        if data {
            params.extend(pool.get(index * size..(index + 1) * size).unwrap_or_default());
        }
    }
    params
}

/// Removes the rows whose ID an earlier row has: an instruction must not name a device twice.
fn first_of_each<T>(rows: &[T], id: impl Fn(&T) -> u8 + Copy) -> impl Iterator<Item = &T> {
    rows.iter().enumerate().filter_map(move |(index, row)| {
        let earlier = rows.iter().take(index).any(|other| id(other) == id(row));
        (!earlier).then_some(row)
    })
}
