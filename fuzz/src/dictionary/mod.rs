//! Pieces of which a wire's frames are made, for libFuzzer.

mod dynamixel2;
mod innfos;

use std::collections::BTreeSet;

use actucheck_spec::Spec;
use actucheck_spec::wire::{self, Wire};

pub(crate) type Tokens = BTreeSet<Vec<u8>>;
type Dictionary = fn(&Spec) -> Tokens;

/// The wires that have a dictionary.
const WIRES: [(Wire, Dictionary); 2] =
    [(wire::dynamixel2::WIRE, dynamixel2::packets), (wire::innfos::WIRE, innfos::frames)];

/// The dictionary of a wire; empty if it has none.
pub(crate) fn of(wire: Wire, spec: &Spec) -> Tokens {
    let own = WIRES.into_iter().find(|(other, _)| *other == wire);
    own.map(|(_, tokens)| tokens(spec)).unwrap_or_default()
}
