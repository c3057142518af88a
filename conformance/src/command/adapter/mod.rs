//! `actucheck adapter …`.

mod check;
mod guide;
mod schema;
mod template;

use std::process::ExitCode;

use clap::Subcommand;

use super::Failure;

/// Helps to write an adapter, and checks it
#[derive(Debug, Subcommand)]
pub(crate) enum Adapter {
    Guide(guide::Guide),
    Template(template::Template),
    Schema(schema::Schema),
    Check(check::Check),
}

/// Does what the subcommand says.
pub(crate) fn run(command: &Adapter) -> Result<ExitCode, Failure> {
    match command {
        Adapter::Guide(_) => guide::run(),
        Adapter::Template(options) => template::run(options),
        Adapter::Schema(options) => schema::run(options),
        Adapter::Check(options) => check::run(options),
    }
}
