//! The adapter protocol: what is said, the process that it is said to, and whether an adapter keeps to it.

#[cfg(feature = "suite")]
pub mod lint;
#[cfg(feature = "suite")]
mod process;
mod requests;
#[cfg(feature = "suite")]
mod trace;

#[cfg(feature = "suite")]
use std::time::Duration;

#[cfg(feature = "suite")]
pub(crate) use process::{Line, Running};
pub use requests::{
    Called, Fast, Hello, Implementation, Limits, Op, Output, Rejection, Reply, Request, Skip,
    VERSION, Wire,
};
#[cfg(feature = "suite")]
pub use trace::Trace;

/// How long an adapter may take.
#[cfg(feature = "suite")]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Timeouts {
    /// From its start to its answer to `hello`.
    pub start: Duration,
    /// For a request.
    pub request: Duration,
}

#[cfg(feature = "suite")]
impl Default for Timeouts {
    fn default() -> Self {
        Self { start: Duration::from_secs(10), request: Duration::from_secs(1) }
    }
}

/// How an adapter is run.
#[cfg(feature = "suite")]
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

#[cfg(feature = "suite")]
impl Default for Settings {
    fn default() -> Self {
        Self { timeouts: Timeouts::default(), restarts: 10, trace: None, number: 1 }
    }
}
