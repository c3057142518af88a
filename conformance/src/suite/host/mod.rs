//! Checks of a host, one module per wire: it makes calls, on a line that plays a script.
//!
//! For each call a basic check looks at what the host puts on the line, and one at what it returns of a
//! right answer. All other checks rest on those of their calls.

mod dynamixel2;

use std::borrow::Cow;

use actucheck_spec::wire;

use super::Author;
use super::plan::Family;
use crate::adapter::{Step, Wire};

/// The families of the checks of a wire.
type Families = for<'a> fn(Author<'a>) -> Vec<Family<'a>>;

/// The wires whose hosts are checked.
const WIRES: [(Wire, Families); 1] = [(wire::dynamixel2::WIRE, dynamixel2::families)];

/// What the basic checks of a call are about: what is sent, and what is returned.
const BASIC: [&str; 2] = ["sent", "result"];

/// Every check of a host, in a fixed order: the basic ones first.
pub(super) fn families(author: Author<'_>) -> Vec<Family<'_>> {
    let own = WIRES.iter().find(|(wire, _)| *wire == author.wire);
    own.map_or_else(Vec::new, |(_, families)| families(author))
}

/// The ids of the basic checks of the calls that are made.
pub(super) fn rests_on(
    wire: Wire,
    steps: &[Step],
) -> impl Iterator<Item = Cow<'static, str>> + use<'_> {
    let calls = steps.iter().filter_map(|step| step.packet.call.as_ref());
    calls.flat_map(move |call| BASIC.map(|about| basic(wire, call.name, about).into()))
}

/// The id of a basic check of a call.
fn basic(wire: Wire, call: &str, about: &str) -> String {
    format!("{wire}.host.basic.{}/{about}", call.replace('_', "-"))
}
