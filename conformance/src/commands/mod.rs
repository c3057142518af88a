//! What each subcommand does.

pub(crate) mod codec;
pub(crate) mod completions;
pub(crate) mod decode;
pub(crate) mod list;
pub(crate) mod replay;
pub(crate) mod show;
pub(crate) mod spec;

use std::fmt;

use actucheck::cases;
use actucheck::check::Check;
use actucheck::protocol::Wire;
use actucheck::select::select;
use actucheck::testee::{Builtin, Process, Testee, Timeouts};
use actucheck_spec::Spec;

use crate::cli::{Adapter, Growth, Selection};

/// Why a command ends early, and with which exit status.
#[derive(Debug)]
pub(crate) struct Failure {
    /// The exit status.
    pub(crate) status: u8,
    message: String,
}

impl Failure {
    /// The packet is not valid, or a check failed.
    pub(crate) const FAILED: u8 = 1;
    /// The command was not used as it must be.
    pub(crate) const USAGE: u8 = 2;
    /// Something could not be done.
    pub(crate) const INCOMPLETE: u8 = 3;
    /// The adapter could not be started.
    pub(crate) const NOT_STARTED: u8 = 4;

    /// A failure with its exit status and one sentence that tells the user what to do.
    pub(crate) fn new(status: u8, message: impl fmt::Display) -> Self {
        Self { status, message: message.to_string() }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

/// The spec that this program was built with.
fn spec() -> Result<Spec, Failure> {
    Spec::embedded().map_err(|defects| {
        let defects: Vec<_> = defects.iter().map(ToString::to_string).collect();
        Failure::new(Failure::INCOMPLETE, defects.join("\n"))
    })
}

/// Every check of a wire.
fn checks(spec: &Spec, wire: Wire, growth: &Growth) -> Vec<Check> {
    cases::all(spec, &cases::Options { wire, seed: growth.seed, cases: growth.cases })
}

/// The checks that the user means.
fn selected(checks: Vec<Check>, selection: &Selection) -> Result<Vec<Check>, Failure> {
    select(checks, &selection.select, &selection.skip)
        .map_err(|error| Failure::new(Failure::USAGE, error))
}

/// The check with this id, of whichever wire.
fn named(spec: &Spec, id: &str, growth: &Growth) -> Result<(Wire, Check), Failure> {
    let wires = [Wire::Dynamixel2, Wire::Innfos];
    let all = wires
        .into_iter()
        .flat_map(|wire| checks(spec, wire, growth).into_iter().map(move |check| (wire, check)));
    all.into_iter().find(|(_, check)| check.id == id).ok_or_else(|| {
        let message = format!("no check has the id `{id}`; `actucheck list` has them all");
        Failure::new(Failure::USAGE, message)
    })
}

/// What is to be asked: the adapter, or the built-in codec without one.
fn testee(adapter: &Adapter) -> Result<Box<dyn Testee>, Failure> {
    if adapter.command.is_empty() {
        // clap does not tell `--` with nothing behind it from no `--` at all.
        if std::env::args_os().next_back().is_some_and(|last| last == "--") {
            let message = "no command behind `--`; give the adapter's, such as python3 adapter.py";
            return Err(Failure::new(Failure::USAGE, message));
        }
        return Ok(Box::new(Builtin::default()));
    }
    let timeouts = Timeouts { start: adapter.start_timeout, request: adapter.timeout };
    let process = Process::start(&adapter.command, timeouts)
        .map_err(|error| Failure::new(Failure::NOT_STARTED, error))?;
    Ok(Box::new(process))
}
