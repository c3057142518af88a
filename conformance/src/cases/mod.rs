//! Where checks come from.

mod golden;

use actucheck_spec::Spec;

use crate::check::Check;
use crate::protocol::Wire;

/// Every check of a wire, in a fixed order.
#[must_use]
pub fn all(spec: &Spec, wire: Wire) -> Vec<Check> {
    golden::checks(spec, wire)
}
