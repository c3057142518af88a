//! `actucheck report …`.

mod compare;
mod merge;
mod render;

use std::path::Path;
use std::process::ExitCode;

use actucheck::report::{model, read};
use clap::Subcommand;

use super::Failure;

/// Compares reports, merges the parts of a run, or writes one in another format
#[derive(Debug, Subcommand)]
pub(crate) enum Report {
    Compare(compare::Compare),
    Merge(merge::Merge),
    Render(render::Render),
}

/// Does what the subcommand says.
pub(crate) fn run(command: &Report) -> Result<ExitCode, Failure> {
    match command {
        Report::Compare(options) => compare::run(options),
        Report::Merge(options) => merge::run(options),
        Report::Render(options) => render::run(options),
    }
}

fn read(file: &Path) -> Result<model::Report, Failure> {
    read::read(file).map_err(Failure::usage)
}
