//! Implementations of the INNFOS Ethernet protocol that are wrong in one way each.

mod frames;

use super::Mutant;

/// Every mutant.
pub(super) static LISTS: [&[Mutant]; 2] = [&frames::BUILDING, &frames::READING];
