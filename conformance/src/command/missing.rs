//! What takes the place of a subcommand on a system that lacks what it needs.

use std::ffi::OsString;
use std::process::ExitCode;

use clap::Args;

use super::{Failure, named};

/// Not on this system, which has no pseudo-terminals
#[derive(Debug, Args)]
pub(crate) struct Missing {
    #[arg(hide = true, trailing_var_arg = true, allow_hyphen_values = true)]
    _given: Vec<OsString>,
}

pub(crate) type Bus = Missing;
pub(crate) type Device = Missing;
pub(crate) type Host = Missing;
pub(crate) type Scan = Missing;

pub(crate) fn run(_: &Missing) -> Result<ExitCode, Failure> {
    let name = named(std::env::args().skip(1).take(1));
    Err(Failure::incomplete(format!(
        "`{name}` is built only where there are pseudo-terminals: run it on Linux or macOS, or in WSL"
    )))
}
