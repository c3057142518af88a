//! Checks of DYNAMIXEL Protocol 2.0 and its JA dialect.
//!
//! - golden: the packets of the documents;
//! - exhaustive: everything where everything is little;
//! - instructions: what is said of single instructions;
//! - negative: each rule of the receive procedure broken;
//! - unspecified: what the documents leave open, which is recorded;
//! - generated: packets and streams from a seed.

mod exhaustive;
pub(crate) mod generated;
pub(super) mod golden;
mod instructions;
mod negative;
mod unspecified;

use crate::suite::check::Check;
use crate::suite::{Author, Options};

pub(super) fn checks(author: &Author<'_>, options: &Options) -> Vec<Check> {
    let mut checks = golden::checks(author);
    checks.extend(exhaustive::checks(author, options));
    checks.extend(instructions::checks(author));
    checks.extend(negative::checks(author));
    checks.extend(unspecified::checks(author));
    checks.extend(generated::checks(author, options.seed, options.cases));
    checks
}
