//! What several subcommands have in common: groups of options, and where their output goes.

mod begun;
mod checking;
mod device;
mod failure;
mod look;
mod outputs;
mod progress;
mod selection;
pub(crate) mod stream;
mod streams;
mod subjects;
pub(crate) mod table;
mod target;
mod value;

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use actucheck_spec::Spec;

pub(crate) use begun::{command_line, date};
#[cfg(unix)]
pub(crate) use checking::{Asked, Running};
pub(crate) use checking::{Checking, Planned, say};
pub(crate) use device::DeviceOption;
pub(crate) use failure::Failure;
pub(crate) use look::{Look, next, terminal_width};
pub(crate) use outputs::{Outputs, Reports, both};
pub(crate) use progress::progress;
pub(crate) use selection::{Growth, Selection, no_host, not_offered};
pub(crate) use streams::Streams;
pub(crate) use subjects::{Adapter, Exchange, Subjects, finish};
pub(crate) use target::{Draft, Target, print, printed, seen};
#[cfg(unix)]
pub(crate) use value::milliseconds;
pub(crate) use value::{duration, one_of, wire};

/// The spec that this program was built with.
pub(crate) fn spec() -> Result<Spec, Failure> {
    Spec::embedded().map_err(|defects| {
        let defects: Vec<_> = defects.iter().map(ToString::to_string).collect();
        Failure::incomplete(defects.join("\n"))
    })
}

/// The exit status at a second Ctrl-C, as a shell would tell it.
const INTERRUPTED: i32 = 130;
/// By then no adapter runs any more: the first Ctrl-C has ended them.
const ADAPTERS_END: Duration = Duration::from_secs(1);

/// Returns a flag that Ctrl-C sets, or what else asks the program to end.
pub(crate) fn interrupted() -> Result<Arc<AtomicBool>, Failure> {
    let flag = Arc::new(AtomicBool::new(false));
    let setter = Arc::clone(&flag);
    at_interrupt(move || setter.store(true, Ordering::Relaxed))?;
    Ok(flag)
}

/// Does something at Ctrl-C, or at what else asks the program to end. Another Ctrl-C after a second
/// ends it at once: it may be writing to somebody who does not read.
pub(crate) fn at_interrupt(mut act: impl FnMut() + Send + 'static) -> Result<(), Failure> {
    let mut first = None;
    let end = move || {
        act();
        if first.get_or_insert_with(Instant::now).elapsed() > ADAPTERS_END {
            std::process::exit(INTERRUPTED);
        }
    };
    ctrlc::set_handler(end)
        .map_err(|error| Failure::incomplete(format!("cannot listen for Ctrl-C: {error}")))
}
