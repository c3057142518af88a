//! Words that the formats of a comparison share.

use super::model::Cell;
use crate::report::words;
use crate::traffic::Spread;

/// A warning that a comparison may be unfair.
pub(super) const ASKED_DIFFERENTLY: &str = "The runs are not comparable in full: selection, seed, cases or lengths differ, or a run ended early.";

/// What the numbers of [`time`] are.
pub(super) const TIMES: &str = "Answers begin after: half of them, and the longest";

/// How long answers took: `0.80, 20.00 ms`, or `-` if none was timed.
pub(super) fn time(spread: Option<&Spread>) -> String {
    let Some(spread) = spread else { return "-".to_owned() };
    let [_, median, _, most] = words::spread(spread);
    format!("{median}, {most} ms")
}

/// A cell of the matrix: `pass`, `fail 65/23963`, or `-` if nothing was asked.
pub(super) fn cell(cell: Option<&Cell>) -> String {
    match cell.map(|cell| (cell.verdict, cell.share())) {
        None => "-".to_owned(),
        Some((verdict, None)) => verdict.to_string(),
        Some((verdict, Some((count, judged)))) => format!("{verdict} {count}/{judged}"),
    }
}
