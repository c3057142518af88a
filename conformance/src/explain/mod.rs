//! Explains in words what bytes mean and where they differ. A wire has a module of its own, which
//! `WIRES` lists.

pub mod diff;
mod dynamixel2;
mod innfos;
pub mod mistake;
pub mod stream;
mod table;
mod warning;

use std::fmt;

use actucheck_spec::wire::{self, Context, Direction, Wire};

use self::mistake::Mistake;
use self::stream::Listen;
use self::table::Table;
use crate::device::Tables;

pub use self::table::{Explanation, Row};
pub use self::warning::Warning;

/// A frame, with what is known about it.
#[derive(Clone, Debug)]
pub struct Asked<'a> {
    /// The whole frame.
    pub bytes: &'a [u8],
    /// What a reader has to know beside the bytes.
    pub context: Context,
    /// The control tables of the devices, where they are known.
    pub tables: &'a Tables,
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

/// What a wire has to explain its frames in detail, and to follow its streams.
#[derive(Clone, Copy)]
struct Own {
    wire: Wire,
    explain: fn(&Asked<'_>) -> Result<Explanation, Invalid>,
    /// A right frame that has what can be read of bytes; `None` if they do not begin like one.
    mended: fn(&[u8], Option<Direction>) -> Option<Vec<u8>>,
    listen: Listen,
    mistakes: &'static [Mistake],
}

/// The wires that have it.
const WIRES: [Own; 2] = [
    Own {
        wire: wire::dynamixel2::WIRE,
        explain: dynamixel2::explain,
        mended: dynamixel2::mended,
        listen: dynamixel2::listen,
        mistakes: dynamixel2::MISTAKES,
    },
    Own {
        wire: wire::innfos::WIRE,
        explain: innfos::explain,
        mended: innfos::mended,
        listen: innfos::listen,
        mistakes: innfos::MISTAKES,
    },
];

impl Own {
    fn of(wire: Wire) -> Option<Self> {
        WIRES.into_iter().find(|own| own.wire == wire)
    }
}

/// Explains a whole frame.
///
/// # Errors
/// The first rule that the bytes break.
pub fn explain(wire: Wire, asked: &Asked<'_>) -> Result<Explanation, Invalid> {
    if let Some(own) = Own::of(wire) {
        return (own.explain)(asked);
    }
    let packet =
        wire.decode(asked.bytes, &asked.context).map_err(|fault| Invalid::new(0, &fault))?;
    let title = format!("{wire} {}", packet.direction());
    Ok(Explanation { title, rows: parts(wire, asked.bytes) })
}

/// The fields of bytes that are no frame, as far as they can be read.
#[must_use]
pub fn damaged(wire: Wire, asked: &Asked<'_>) -> Vec<Row> {
    let mended = |own: Own| (own.mended)(asked.bytes, asked.context.direction);
    let Some(frame) = Own::of(wire).and_then(mended) else { return Vec::new() };
    let rows = match explain(wire, &Asked { bytes: &frame, ..asked.clone() }) {
        Ok(explanation) => explanation.rows,
        Err(_) => parts(wire, &frame),
    };
    table::received(rows, &frame, asked.bytes)
}

/// Names the parts of a frame, without their meaning.
fn parts(wire: Wire, frame: &[u8]) -> Vec<Row> {
    let mut table = Table::new(frame);
    let places: Vec<_> = (0..frame.len()).map(|offset| wire.part(frame, offset)).collect();
    for part in places.chunk_by(|one, other| one == other) {
        table.take(part.len(), part.first().copied().unwrap_or_default(), |_| String::new());
    }
    table.rows
}
