//! `actucheck spec errata`.

use std::fmt::Write as _;

use actucheck_spec::Spec;
use actucheck_spec::model::{Erratum, Status};
use clap::Args;

use crate::command::WRITTEN;
use crate::command::shared::table::{self, BOLD};
use crate::command::shared::{Failure, one_of};

const EXAMPLES: &str = "\
Examples:
  actucheck spec errata --document ja40 --status open
  actucheck spec errata --json > errata.json";

/// Lists what the documents get wrong or leave unspecified, with the evidence
#[derive(Debug, Args)]
#[command(after_help = format!("{EXAMPLES}\n\n{WRITTEN}"))]
pub(crate) struct Errata {
    /// Only those of this document
    #[arg(long, value_name = "DOCUMENT")]
    document: Option<String>,
    /// Only those with this status
    #[arg(long, value_parser = one_of(STATUSES))]
    status: Option<Status>,
    /// Print them as JSON
    #[arg(long)]
    json: bool,
}

const STATUSES: [(Status, &str, &str); 3] = [
    (Status::Resolved, "resolved", "One reading is provably right"),
    (Status::Chosen, "chosen", "A reading was picked"),
    (Status::Open, "open", "More than one reading stands"),
];

/// The selected errata, and their number.
pub(super) fn text(spec: &Spec, options: &Errata) -> Result<String, Failure> {
    let document = options.document.as_deref();
    super::known_document(spec, document)?;
    let rows: Vec<_> = spec
        .errata
        .content
        .errata
        .iter()
        .filter(|row| document.is_none_or(|id| row.source.document == id))
        .filter(|row| options.status.is_none_or(|status| row.status == status))
        .collect();
    if options.json {
        return serde_json::to_string_pretty(&rows)
            .map(|text| text + "\n")
            .map_err(Failure::incomplete);
    }
    let blocks: String = rows.iter().map(|row| block(spec, row)).collect();
    Ok(blocks + &summary(&rows))
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
        let _ = write!(place, " ({} {word} {})", document.place(), lines.join(", "));
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
