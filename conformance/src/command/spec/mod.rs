//! `actucheck spec …`.

mod coverage;
mod diff;
mod errata;
mod export;
mod find;
mod sentences;
mod show;

use std::process::ExitCode;

use actucheck_spec as data;
use clap::Subcommand;

use super::shared::{self, Failure};

/// Shows, compares and exports what the documents say
#[derive(Debug, Subcommand)]
pub(crate) enum Spec {
    Find(find::Find),
    Show(show::Show),
    Diff(diff::Diff),
    Errata(errata::Errata),
    Coverage(coverage::Coverage),
    Export(export::Export),
}

/// Does what the subcommand says.
pub(crate) fn run(command: &Spec) -> Result<ExitCode, Failure> {
    let spec = shared::spec()?;
    match command {
        Spec::Find(options) => shared::print(find::text(&spec, options)?),
        Spec::Show(options) => shared::print(show::text(&spec, options)?),
        Spec::Diff(options) => shared::print(diff::text(&spec, options)?),
        Spec::Errata(options) => shared::print(errata::text(&spec, options)?),
        Spec::Coverage(options) => shared::print(coverage::text(&spec, options)?),
        Spec::Export(options) => export::run(&spec, options),
    }?;
    Ok(ExitCode::SUCCESS)
}

/// Fails if a document is asked for that does not exist.
fn known_document(spec: &data::Spec, id: Option<&str>) -> Result<(), Failure> {
    let documents = &spec.documents.content.documents;
    match id {
        Some(id) if spec.document(id).is_none() => {
            let ids = documents.iter().map(|document| document.id.as_str());
            Err(unknown("document", id, ids))
        }
        _ => Ok(()),
    }
}

fn unknown<'a>(what: &str, id: &str, known: impl Iterator<Item = &'a str>) -> Failure {
    let known: Vec<_> = known.collect();
    let message = format!("unknown {what} `{id}`; known are {}", known.join(", "));
    Failure::usage(message)
}
