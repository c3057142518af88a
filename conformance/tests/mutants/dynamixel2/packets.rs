//! Implementations that are wrong with some lengths, IDs, addresses or numbers of devices.

use crate::Mutant;

pub(super) static MUTANTS: [Mutant; 0] = [];
