//! `actucheck adapter …`.

mod check;
mod template;

use std::process::ExitCode;

use clap::Subcommand;

use super::Failure;

/// Prints a template of an adapter, or checks an adapter
#[derive(Debug, Subcommand)]
pub(crate) enum Adapter {
    Template(template::Template),
    Check(check::Check),
}

/// Does what the subcommand says.
pub(crate) fn run(command: &Adapter) -> Result<ExitCode, Failure> {
    match command {
        Adapter::Template(options) => Ok(template::run(options)),
        Adapter::Check(options) => check::run(options),
    }
}
