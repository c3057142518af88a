//! Checks of a codec, one module per wire.

pub(crate) mod dynamixel2;
mod innfos;

use super::plan::Family;
use super::{Author, Options};
use crate::adapter::Wire;

/// Every check of a codec, in a fixed order.
pub(super) fn families<'a>(author: Author<'a>, options: &Options) -> Vec<Family<'a>> {
    match author.wire {
        Wire::Dynamixel2 => dynamixel2::families(author, options),
        Wire::Innfos => innfos::families(author, options.max_packet),
    }
}
