//! Implementations that are wrong with streams of several packets.

use crate::Mutant;

pub(super) static MUTANTS: [Mutant; 0] = [];
