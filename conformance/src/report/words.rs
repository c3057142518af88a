//! Words and marks that several formats share.

use super::compare::Cell;
use super::model::Tally;
use crate::verdict::Verdict;

/// A number with commas: 61,260.
pub(super) fn thousands(number: usize) -> String {
    let digits = number.to_string();
    let places = digits.chars().zip((0..digits.len()).rev());
    places.fold(String::new(), |mut text, (digit, place)| {
        text.push(digit);
        if place > 0 && place % 3 == 0 {
            text.push(',');
        }
        text
    })
}

/// `1 check`, `61,260 checks`.
pub(super) fn count(number: usize, what: &str) -> String {
    let ending = if number == 1 { "" } else { "s" };
    format!("{} {what}{ending}", thousands(number))
}

/// A sign for a verdict, for those who do not see its colour.
pub(super) const fn mark(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Pass => "✓",
        Verdict::Fail | Verdict::UnexpectedPass => "✗",
        Verdict::Warn => "!",
        Verdict::Recorded => "?",
        Verdict::Skip => "–",
        Verdict::ExpectedFailure => "≈",
        Verdict::Timeout | Verdict::Crash | Verdict::AdapterFault | Verdict::NotRun => "⚠",
    }
}

/// Said of a comparison where it may be unfair.
pub(super) const ASKED_DIFFERENTLY: &str = "They were not asked the same: selection, seed, cases or lengths differ, or a run was cut short.";

/// A cell of a matrix: `pass`, `fail 65/23963`, or `-` if nothing was asked.
pub(super) fn cell(cell: Option<&Cell>) -> String {
    match cell.map(|cell| (cell.verdict, cell.share())) {
        None => "-".to_owned(),
        Some((verdict, None)) => verdict.to_string(),
        Some((verdict, Some((count, judged)))) => format!("{verdict} {count}/{judged}"),
    }
}

/// What was said, with numbers where it is not all the same.
pub(super) fn tallies(tallies: &[Tally]) -> String {
    match tallies {
        [] => "-".to_owned(),
        [one] => one.text.clone(),
        many => {
            let each = many.iter().map(|tally| format!("{} ({})", tally.text, tally.count));
            each.collect::<Vec<_>>().join(", ")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_third_digit_has_a_comma() {
        let numbers = [0, 999, 1000, 61260, 1_234_567].map(thousands);
        assert_eq!(numbers, ["0", "999", "1,000", "61,260", "1,234,567"]);
        assert_eq!([count(1, "check"), count(0, "check")], ["1 check", "0 checks"]);
    }
}
