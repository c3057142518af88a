//! Checks of DYNAMIXEL Protocol 2.0 and its JA dialect.
//!
//! - golden: the test vectors;
//! - exhaustive: every case of small sets, such as short bodies and all IDs;
//! - instructions: single instructions and their answers;
//! - negative: packets that break one rule of the receive procedure;
//! - unspecified: questions that the documents leave unspecified;
//! - generated: packets and streams that are generated from a seed.

mod exhaustive;
pub(crate) mod generated;
pub(super) mod golden;
mod instructions;
mod negative;
mod unspecified;

use crate::suite::plan::Family;
use crate::suite::{Author, Options};

pub(super) fn families<'a>(author: Author<'a>, options: &Options) -> Vec<Family<'a>> {
    let mut families = vec![golden::family(author)];
    families.extend(exhaustive::families(author, options));
    families.push(Family::of("", move || instructions::checks(&author)));
    families.extend(negative::families(author));
    families.push(Family::of("dynamixel2.open.", move || unspecified::checks(&author)));
    families.push(generated::family(author, options.seed, options.cases));
    families
}
