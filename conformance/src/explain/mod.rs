//! Explains in words what bytes mean and where they differ. A wire has a module of its own, which
//! `WIRES` lists.

pub mod diff;
mod dynamixel2;
mod innfos;
pub mod stream;
mod table;
mod warning;

use std::fmt;

use actucheck_codec::register::Device;
use actucheck_codec::{ja_variant, ja40, xm430_w210};
use actucheck_spec::wire::{self, Context, Wire};

use self::stream::Listen;
use self::table::Table;

pub use self::table::{Explanation, Row};
pub use self::warning::Warning;

/// A frame, with what is known about it.
#[derive(Clone, Debug)]
pub struct Asked<'a> {
    /// The whole frame.
    pub bytes: &'a [u8],
    /// What a reader has to know beside the bytes.
    pub context: Context,
    /// The device whose registers are meant, if it is known.
    pub device: Option<&'a Device>,
    /// The address at which the data of an answer was read, if known.
    pub address: Option<u16>,
}

/// The first rule that a frame breaks.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("from byte {offset} on: {reason}")]
pub struct Invalid {
    offset: usize,
    reason: String,
}

impl Invalid {
    fn new(offset: usize, reason: &impl fmt::Display) -> Self {
        Self { offset, reason: reason.to_string() }
    }
}

type Explain = fn(&Asked<'_>) -> Result<Explanation, Invalid>;

/// The wires whose frames are explained in detail, and whose streams are followed.
const WIRES: [(Wire, Explain, Listen); 2] = [
    (wire::dynamixel2::WIRE, dynamixel2::explain, dynamixel2::listen),
    (wire::innfos::WIRE, innfos::explain, innfos::listen),
];

/// The devices whose registers have names here.
pub const DEVICES: [&Device; 3] = [&ja40::DEVICE, &ja_variant::DEVICE, &xm430_w210::DEVICE];

/// The device with a model number.
#[must_use]
pub fn device_of(model: u16) -> Option<&'static Device> {
    DEVICES.into_iter().find(|device| device.model_number == Some(model))
}

/// Explains a whole frame.
///
/// # Errors
/// The first rule that the bytes break.
pub fn explain(wire: Wire, asked: &Asked<'_>) -> Result<Explanation, Invalid> {
    let own = WIRES.into_iter().find(|(other, ..)| *other == wire);
    own.map_or_else(|| parts(wire, asked), |(_, explain, _)| explain(asked))
}

/// Names the parts of a frame, without their meaning.
fn parts(wire: Wire, asked: &Asked<'_>) -> Result<Explanation, Invalid> {
    let packet =
        wire.decode(asked.bytes, &asked.context).map_err(|fault| Invalid::new(0, &fault))?;
    let mut table = Table::new(asked.bytes);
    let places: Vec<_> =
        (0..asked.bytes.len()).map(|offset| wire.part(asked.bytes, offset)).collect();
    for part in places.chunk_by(|one, other| one == other) {
        table.take(part.len(), part.first().copied().unwrap_or_default(), |_| String::new());
    }
    Ok(Explanation { title: format!("{wire} {}", packet.direction()), rows: table.rows })
}
