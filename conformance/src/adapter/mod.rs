//! The adapter protocol: its requests and replies, the adapter's process, and the check of an
//! adapter.

mod called;
pub(crate) mod conversation;
mod device;
mod greeting;
mod host;
mod kept;
#[cfg(target_os = "linux")]
mod leftover;
pub mod lint;
mod message;
mod output;
mod process;
mod reading;
mod requests;
pub mod schema;
mod trace;
mod value;

use std::fmt;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

pub use called::Called;
pub use device::{Asked, Bits, Heard, Pause, Permission, Permissions, Piece, Sum};
pub use greeting::{Contradiction, Greeting};
#[cfg(unix)]
pub(crate) use host::passed;
pub use host::{
    Burst, CallError, CallTo, Course, Exchange, Exchanged, Passed, Reported, Returned, Sent, Step,
    Trouble,
};
pub use message::Told;
pub use output::Output;
pub use reading::Misfit;
#[cfg(unix)]
pub(crate) use reading::devices;
pub(crate) use reading::exchanged;
pub use requests::{
    Hello, Implementation, Limits, Question, Rejection, Request, VERSION, VERSIONS, Wire,
};
pub use trace::Trace;
pub use value::{Given, RegisterOf};

/// Time limits of an adapter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Timeouts {
    /// From the start to the answer to `hello`.
    pub start: Duration,
    /// For one request.
    pub request: Duration,
}

impl Default for Timeouts {
    fn default() -> Self {
        Self { start: Duration::from_secs(10), request: Duration::from_secs(1) }
    }
}

/// The port that a host gets where packets are no datagrams. There it gets a UDP port.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum HostPort {
    /// The end of a pseudo-terminal.
    #[default]
    Pty,
    /// A TCP port of this machine.
    Tcp,
}

/// The word that the option `--port` has for it.
impl fmt::Display for HostPort {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Pty => "pty",
            Self::Tcp => "tcp",
        })
    }
}

/// How an adapter is run.
#[derive(Clone, Debug)]
pub struct Settings {
    /// The time limits.
    pub timeouts: Timeouts,
    /// How often the adapter is restarted before the remaining questions are given up, if there is
    /// a limit.
    pub restarts: Option<u32>,
    /// Where the exchanged lines are written.
    pub trace: Option<Trace>,
    /// The number of this process in the trace.
    pub number: u32,
    /// The port that a host gets; if it is absent, one in memory if the adapter has that, or else the
    /// default.
    pub port: Option<HostPort>,
    /// When this is set, no answer is awaited any more.
    pub interrupted: Arc<AtomicBool>,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            timeouts: Timeouts::default(),
            restarts: None,
            trace: None,
            number: 1,
            port: None,
            interrupted: Arc::default(),
        }
    }
}
