//! Words that the formats of a comparison share.

use super::model::Cell;

/// A warning that a comparison may be unfair.
pub(super) const ASKED_DIFFERENTLY: &str = "The runs are not comparable in full: selection, seed, cases or lengths differ, or a run ended early.";

/// A cell of the matrix: `pass`, `fail 65/23963`, or `-` if nothing was asked.
pub(super) fn cell(cell: Option<&Cell>) -> String {
    match cell.map(|cell| (cell.verdict, cell.share())) {
        None => "-".to_owned(),
        Some((verdict, None)) => verdict.to_string(),
        Some((verdict, Some((count, judged)))) => format!("{verdict} {count}/{judged}"),
    }
}
