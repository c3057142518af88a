//! `actucheck report …`.

use std::path::Path;
use std::process::ExitCode;

use actucheck::report::compare::{self, Comparison};
use actucheck::report::{Format, model, read, text};

use super::Failure;
use super::output::Outputs;
use crate::cli::report::{Compare, Render, Report};

/// Does what the subcommand says.
pub(crate) fn run(command: &Report) -> Result<ExitCode, Failure> {
    match command {
        Report::Compare(options) => compare(options),
        Report::Render(options) => render(options),
    }?;
    Ok(ExitCode::SUCCESS)
}

fn render(options: &Render) -> Result<(), Failure> {
    let report = read(&options.file)?;
    Outputs::open(&options.reports)?
        .write(|format, out| format.write(&report, out), |out| text::write(&report, out))
}

fn compare(options: &Compare) -> Result<(), Failure> {
    if options.reports.targets.iter().any(|target| target.format == Format::Junit) {
        return Err(Failure::new(Failure::USAGE, compare::NO_JUNIT));
    }
    let others = options.others.iter().map(|file| read(file)).collect::<Result<_, _>>()?;
    let comparison = Comparison::of(read(&options.first)?, others)
        .map_err(|error| Failure::new(Failure::USAGE, error))?;
    Outputs::open(&options.reports)?.write(
        |format, out| format.write_comparison(&comparison, out),
        |out| compare::write_text(&comparison, out),
    )
}

fn read(file: &Path) -> Result<model::Report, Failure> {
    read::read(file).map_err(|error| Failure::new(Failure::USAGE, error))
}
