//! `actucheck spec errata`.

use std::fmt::Write as _;

use actucheck_spec::Spec;
use actucheck_spec::model::{Erratum, Status};

use super::table::{self, BOLD};
use crate::cli::spec;
use crate::commands::Failure;

/// The errata that are asked for, and how many they are.
pub(super) fn text(spec: &Spec, options: &spec::Errata) -> Result<String, Failure> {
    let document = options.document.as_deref();
    super::known_document(spec, document)?;
    let status = options.status.map(status);
    let rows: Vec<_> = spec
        .errata
        .content
        .errata
        .iter()
        .filter(|row| document.is_none_or(|id| row.source.document == id))
        .filter(|row| status.is_none_or(|status| row.status == status))
        .collect();
    if options.json {
        return serde_json::to_string_pretty(&rows)
            .map(|text| text + "\n")
            .map_err(|error| Failure::new(Failure::INCOMPLETE, error));
    }
    let blocks: String = rows.iter().map(|row| block(spec, row)).collect();
    Ok(blocks + &summary(&rows))
}

const fn status(status: spec::Status) -> Status {
    match status {
        spec::Status::Resolved => Status::Resolved,
        spec::Status::Chosen => Status::Chosen,
        spec::Status::Open => Status::Open,
    }
}

fn block(spec: &Spec, row: &Erratum) -> String {
    let mut text = format!("{BOLD}{}{BOLD:#}  {}\n", row.id, row.status);
    for (label, words) in [
        ("place", &place(spec, row)),
        ("printed", &row.printed),
        ("held right", &row.held_right),
        ("evidence", &row.evidence),
    ] {
        text.push_str(&table::labelled(label, words));
    }
    text.push('\n');
    text
}

/// Document, section, and the lines where a test finds the defect.
fn place(spec: &Spec, row: &Erratum) -> String {
    let mut place = spec.place(&row.source);
    let lines = row.proof.iter().flat_map(|proof| &proof.lines);
    let lines: Vec<_> = lines.map(ToString::to_string).collect();
    if let (Some(document), false) = (spec.document(&row.source.document), lines.is_empty()) {
        let word = if lines.len() == 1 { "line" } else { "lines" };
        // Writing to a string can't fail.
        let _ = write!(place, " ({} {word} {})", document.file, lines.join(", "));
    }
    place
}

fn summary(rows: &[&Erratum]) -> String {
    let counts = [Status::Resolved, Status::Chosen, Status::Open].map(|status| {
        let count = rows.iter().filter(|row| row.status == status).count();
        format!("{count} {status}")
    });
    format!("{} errata: {}\n", rows.len(), counts.join(", "))
}
