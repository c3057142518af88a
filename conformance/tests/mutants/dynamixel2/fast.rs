//! Implementations that are wrong with fast status packets.

use crate::Mutant;

pub(super) static MUTANTS: [Mutant; 0] = [];
