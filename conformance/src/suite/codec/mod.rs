//! Checks of a codec, a wire a module.

pub(crate) mod dynamixel2;
mod innfos;

use super::check::Check;
use super::{Author, Options};
use crate::adapter::Wire;

/// Every check of a codec, in a fixed order.
pub(super) fn checks(author: &Author<'_>, options: &Options) -> Vec<Check> {
    match author.wire {
        Wire::Dynamixel2 => dynamixel2::checks(author, options),
        Wire::Innfos => innfos::checks(author, options.max_packet),
    }
}
