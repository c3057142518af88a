//! `actucheck report …`.

mod compare;
mod merge;
mod render;

use std::path::Path;
use std::process::ExitCode;

use actucheck::report::format::NO_JSONL;
use actucheck::report::{Format, model, read, screen};
use clap::Subcommand;

use super::Failure;
use super::shared::{Look, Outputs, Reports, next};

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

/// Refuses the format that needs what a report does not have.
fn refuse_jsonl(reports: &Reports) -> Result<(), Failure> {
    let is_wanted = reports.formats().any(|format| format == Format::Jsonl);
    if is_wanted { Err(Failure::usage(NO_JSONL)) } else { Ok(()) }
}

/// Writes a report to the files that are asked for, or to the terminal.
fn write(report: &model::Report, reports: &Reports, look: Look) -> Result<(), Failure> {
    Outputs::open(reports, [])?.write(
        |format, out| format.write(report, out),
        |out| screen::write(report, &look.terminal(Some(next(report))), out),
    )
}

fn read(file: &Path) -> Result<model::Report, Failure> {
    read::read(file).map_err(Failure::usage)
}
