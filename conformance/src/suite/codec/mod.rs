//! Checks of a codec, one module per wire.

pub(crate) mod dynamixel2;
mod innfos;

use actucheck_spec::wire;

use super::plan::Family;
use super::{Author, Options};
use crate::adapter::Wire;

/// The families of checks of a wire.
type Families = for<'a> fn(Author<'a>, &Options) -> Vec<Family<'a>>;

/// The wires that are checked.
const WIRES: [(Wire, Families); 2] =
    [(wire::dynamixel2::WIRE, dynamixel2::families), (wire::innfos::WIRE, innfos::families)];

/// Every check of a codec, in a fixed order.
pub(super) fn families<'a>(author: Author<'a>, options: &Options) -> Vec<Family<'a>> {
    let of_wire = WIRES.into_iter().find(|(wire, _)| *wire == author.wire);
    of_wire.map(|(_, families)| families(author, options)).unwrap_or_default()
}
