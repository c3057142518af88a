//! `actucheck show`.

use std::io::Write as _;
use std::process::ExitCode;

use actucheck::report::text;

use super::Failure;
use crate::cli::Show;

/// Prints one check.
pub(crate) fn run(options: &Show) -> Result<ExitCode, Failure> {
    let spec = super::spec()?;
    let (_, check) = super::named(&spec, &options.id, &options.growth, None)?;
    let mut text = Vec::new();
    text::check(&spec, &check, &mut text)
        .map_err(|error| Failure::new(Failure::INCOMPLETE, error))?;
    // A reader that has seen enough is no failure.
    let _ = anstream::stdout().write_all(&text);
    Ok(ExitCode::SUCCESS)
}
