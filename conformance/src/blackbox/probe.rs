//! Probes: questions that proptest generates and shrinks.

use actucheck_spec::model::{HexBytes, Packet};
use actucheck_spec::wire::dynamixel2::reference;
use actucheck_spec::wire::innfos::reference as innfos;
use proptest::collection::vec;
use proptest::prelude::{BoxedStrategy, Just, Strategy, any};
use proptest::prop_oneof;
use proptest::strategy::Union;

use crate::adapter::{Hello, Wire};
use crate::suite::codec::dynamixel2::generated::{data, instruction, status};

/// The longest data of a probe, in bytes.
const LONGEST: usize = 48;

/// A question before it becomes a check.
#[derive(Clone, Debug)]
pub(super) enum Probe {
    Crc(Vec<u8>),
    Stuff(Vec<u8>),
    /// A body whose stuffing is to be removed.
    Unstuff(Vec<u8>),
    Encode(Named),
    /// A frame, with damage.
    Decode(Named, Vec<Damage>),
    /// Frames with damage and the bytes between them, with the places where the stream is cut, in
    /// units of 1/65,536 of its length.
    Stream(Vec<Part>, Vec<u16>),
}

/// A packet and the name of its instruction.
pub(super) type Named = (&'static str, Packet);

/// A part of a stream: noise, then a frame with damage.
pub(super) type Part = (Vec<u8>, Packet, Vec<Damage>);

/// A damage to a frame. Places are in units of 1/65,536 of its length.
#[derive(Clone, Copy, Debug)]
pub(super) enum Damage {
    Flip(u16, u8),
    Set(u16, u8),
    Cut(u16),
    Insert(u16, u8),
    /// The CRC is recomputed, so that the code after the CRC check is reached.
    Repair,
}

/// Generates probes for all ops that `hello` offers on a wire; `None` if it offers none.
pub(super) fn strategy(wire: Wire, hello: &Hello) -> Option<BoxedStrategy<Probe>> {
    if !hello.wires.iter().any(|offered| offered == wire.id()) {
        return None;
    }
    let packet = || packet(wire);
    let all = [
        ("crc", 1, data(0..LONGEST).prop_map(Probe::Crc).boxed()),
        ("stuff", 2, data(0..LONGEST).prop_map(Probe::Stuff).boxed()),
        ("unstuff", 2, data(0..LONGEST).prop_map(Probe::Unstuff).boxed()),
        ("encode", 4, packet().prop_map(Probe::Encode).boxed()),
        ("decode", 4, (packet(), vec(damage(), 0..3)).prop_map(decode).boxed()),
        ("stream", 3, (vec(part(wire), 1..5), vec(any::<u16>(), 0..6)).prop_map(stream).boxed()),
    ];
    let stuffed = |op: &str| wire == Wire::Dynamixel2 || !op.ends_with("stuff");
    let offered = |op: &str| hello.ops.iter().any(|other| other == op);
    let asked: Vec<_> = all
        .into_iter()
        .filter(|(op, _, _)| stuffed(op) && offered(op))
        .map(|(_, weight, strategy)| (weight, strategy))
        .collect();
    (!asked.is_empty()).then(|| Union::new_weighted(asked).boxed())
}

fn decode((packet, damage): (Named, Vec<Damage>)) -> Probe {
    Probe::Decode(packet, damage)
}

fn stream((parts, cuts): (Vec<Part>, Vec<u16>)) -> Probe {
    Probe::Stream(parts, cuts)
}

fn packet(wire: Wire) -> BoxedStrategy<Named> {
    match wire {
        Wire::Dynamixel2 => prop_oneof![
            8 => status().prop_map(|packet| ("status", packet)),
            8 => instruction(),
            1 => any_instruction(),
            1 => long_status(),
        ]
        .boxed(),
        Wire::Innfos => (any::<bool>(), any::<u8>(), any::<u8>(), data(0..LONGEST))
            .prop_map(|(request, address, command, data)| {
                let data = data.into();
                if request {
                    ("request", Packet::Request { address, command, data })
                } else {
                    ("reply", Packet::Reply { address, command, data })
                }
            })
            .boxed(),
    }
}

/// Any code, with parameters that may not fit it.
fn any_instruction() -> impl Strategy<Value = Named> {
    let code = prop_oneof![Just(0xFF_u8), any::<u8>()]
        .prop_map(|code| if code == reference::STATUS { 0 } else { code });
    (code, data(0..LONGEST)).prop_map(|(instruction, params)| {
        let params = params.into();
        ("", Packet::Instruction { id: 1, instruction, params })
    })
}

/// A packet whose length needs both bytes.
fn long_status() -> impl Strategy<Value = Named> {
    data(240..600).prop_map(|params| {
        let params = params.into();
        ("status", Packet::Status { id: 1, error: 0, params })
    })
}

fn part(wire: Wire) -> BoxedStrategy<Part> {
    let frame = match wire {
        Wire::Dynamixel2 => status().boxed(),
        Wire::Innfos => packet(wire).prop_map(|(_, packet)| packet).boxed(),
    };
    let damage = prop_oneof![3 => Just(Vec::new()), 1 => vec(damage(), 1..3)];
    (data(0..6), frame, damage).boxed()
}

fn damage() -> impl Strategy<Value = Damage> {
    prop_oneof![
        2 => Just(Damage::Repair),
        2 => (any::<u16>(), 0..8_u8).prop_map(|(at, bit)| Damage::Flip(at, bit)),
        2 => (any::<u16>(), any::<u8>()).prop_map(|(at, byte)| Damage::Set(at, byte)),
        1 => any::<u16>().prop_map(Damage::Cut),
        1 => (any::<u16>(), any::<u8>()).prop_map(|(at, byte)| Damage::Insert(at, byte)),
    ]
}

impl Damage {
    fn happen(self, wire: Wire, frame: &mut Vec<u8>) {
        let place = |at: u16, length: usize| usize::from(at) * length / 65_536;
        match self {
            Self::Flip(at, bit) => {
                let at = place(at, frame.len());
                frame.get_mut(at).into_iter().for_each(|byte| *byte ^= 1 << bit);
            }
            Self::Set(at, value) => {
                let at = place(at, frame.len());
                frame.get_mut(at).into_iter().for_each(|byte| *byte = value);
            }
            Self::Cut(at) => frame.truncate(place(at, frame.len())),
            Self::Insert(at, byte) => frame.insert(place(at, frame.len() + 1), byte),
            Self::Repair => repair(wire, frame),
        }
    }
}

fn repair(wire: Wire, frame: &mut [u8]) {
    let tail = match wire {
        Wire::Dynamixel2 => 0,
        Wire::Innfos => 1,
    };
    let Some(end) = frame.len().checked_sub(2 + tail) else { return };
    let before = frame.get(..end).unwrap_or_default();
    let crc = match wire {
        Wire::Dynamixel2 => reference::crc(before),
        Wire::Innfos => innfos::crc(before.get(5..).unwrap_or_default()),
    };
    for (slot, byte) in frame.iter_mut().skip(end).zip(crc.to_le_bytes()) {
        *slot = byte;
    }
}

pub(super) fn damaged(wire: Wire, mut frame: Vec<u8>, damage: &[Damage]) -> Vec<u8> {
    for damage in damage {
        damage.happen(wire, &mut frame);
    }
    frame
}

pub(super) fn joined(wire: Wire, parts: &[Part]) -> Option<Vec<u8>> {
    let mut stream = Vec::new();
    for (noise, packet, damage) in parts {
        stream.extend(noise);
        stream.extend(damaged(wire, reference::encode(packet)?, damage));
    }
    Some(stream)
}

/// The stream in chunks.
pub(super) fn cut(stream: &[u8], cuts: &[u16]) -> Vec<HexBytes> {
    let mut places: Vec<_> =
        cuts.iter().map(|cut| usize::from(*cut) * stream.len() / 65_536).collect();
    places.extend([0, stream.len()]);
    places.sort_unstable();
    let pairs = places.iter().zip(places.iter().skip(1));
    pairs.map(|(from, to)| stream.get(*from..*to).unwrap_or_default().to_vec().into()).collect()
}
