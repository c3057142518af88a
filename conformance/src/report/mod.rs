//! What came out of a run, for a person and for a program.

pub mod json;
pub mod text;

use std::path::Path;

use actucheck_spec::Spec;
use serde::Serialize;

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
    /// The file that keeps the checks, if they are not those of `actucheck list`.
    pub record: Option<&'a Path>,
    /// What came out of each check.
    pub outcomes: &'a [Outcome],
    /// Why it ended early, if it did.
    pub stopped: Option<Stopped>,
    /// How many checks were not asked for that.
    pub left: usize,
    /// The last lines that the adapter logged.
    pub log: String,
}

/// Why a run ended early.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Stopped {
    /// The user ended it.
    Interrupted,
    /// As much failed as was allowed to.
    MaxFail,
}

impl Run<'_> {
    /// The exit status: as [`Totals::exit_status`], and 3 for a run that ended early without a
    /// failure.
    #[must_use]
    pub fn exit_status(&self) -> u8 {
        match self.totals().exit_status() {
            0 if self.stopped.is_some() => 3,
            status => status,
        }
    }

    /// How often each verdict came out.
    #[must_use]
    pub fn totals(&self) -> Totals {
        Totals::of(self.outcomes)
    }
}
