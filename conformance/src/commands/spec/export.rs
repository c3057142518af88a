//! `actucheck spec export`.

use std::fs;

use actucheck_spec::{Spec, export};

use crate::cli::spec::{Export, Format};
use crate::commands::Failure;

/// Writes the export to the file, or to standard output.
pub(super) fn run(spec: &Spec, options: &Export) -> Result<(), Failure> {
    let text = match options.format {
        Format::Json => export::json::export(spec),
        Format::Vectors => export::vectors::export(spec),
        Format::CHeader => export::c_header::export(spec),
        Format::Markdown => Ok(export::markdown::export(spec)),
    }
    .map_err(|error| Failure::new(Failure::INCOMPLETE, error))?;
    let Some(path) = &options.output else {
        return super::print(&text);
    };
    fs::write(path, text).map_err(|error| {
        let message = format!("cannot write {}: {error}", path.display());
        Failure::new(Failure::USAGE, message)
    })
}
