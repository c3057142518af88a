//! The adapter protocol: what is said, the process that it is said to, and whether an adapter keeps to it.

pub mod lint;
mod process;
mod requests;
mod trace;

use std::time::Duration;

pub(crate) use process::{Line, Running};
pub use requests::{
    Called, Hello, Implementation, Limits, Op, Output, Rejection, Reply, Request, Skip, VERSION,
    Wire,
};
pub use trace::Trace;

/// How long an adapter may take.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Timeouts {
    /// From its start to its answer to `hello`.
    pub start: Duration,
    /// For a request.
    pub request: Duration,
}

impl Default for Timeouts {
    fn default() -> Self {
        Self { start: Duration::from_secs(10), request: Duration::from_secs(1) }
    }
}

/// How an adapter is run.
#[derive(Clone, Debug)]
pub struct Settings {
    /// How long it may take.
    pub timeouts: Timeouts,
    /// How often it is started again before the rest is given up.
    pub restarts: u32,
    /// Where the lines exchanged are noted.
    pub trace: Option<Trace>,
    /// The number of this process in the trace.
    pub number: u32,
}

impl Default for Settings {
    fn default() -> Self {
        Self { timeouts: Timeouts::default(), restarts: 10, trace: None, number: 1 }
    }
}
