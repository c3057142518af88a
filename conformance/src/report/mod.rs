//! What came out of a run, for a person and for a program.

pub mod json;
pub mod text;

use actucheck_spec::Spec;

use crate::protocol::{Implementation, Wire};
use crate::verdict::{Outcome, Totals};

/// A finished run.
#[derive(Clone, Debug)]
pub struct Run<'a> {
    /// The spec that the checks come from.
    pub spec: &'a Spec,
    /// What was checked.
    pub implementation: &'a Implementation,
    /// The wire.
    pub wire: Wire,
    /// The adapter's command; empty for the built-in codec.
    pub command: &'a [String],
    /// What came out of each check.
    pub outcomes: &'a [Outcome],
    /// The last lines that the adapter logged.
    pub log: String,
}

impl Run<'_> {
    /// How often each verdict came out.
    #[must_use]
    pub fn totals(&self) -> Totals {
        Totals::of(self.outcomes)
    }
}
