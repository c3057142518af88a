//! Words and marks that several formats share.

use std::time::Duration;

use super::model::Tally;
use crate::adapter::Wire;
use crate::traffic::Spread;
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

/// Least, median, 99th percentile and most of times, in milliseconds.
pub(super) fn spread(spread: &Spread) -> [String; 4] {
    let Spread { least_us, median_us, p99_us, most_us, .. } = *spread;
    let ms = |time| format!("{:.2}", Duration::from_micros(time).as_secs_f64() * 1e3);
    [least_us, median_us, p99_us, most_us].map(ms)
}

/// The wires: `wire dynamixel2`, `wires dynamixel2, innfos`.
pub(super) fn wires(wires: &[Wire]) -> String {
    let word = if wires.len() == 1 { "wire" } else { "wires" };
    let ids: Vec<_> = wires.iter().map(|wire| wire.id()).collect();
    format!("{word} {}", ids.join(", "))
}

/// A heading, and its meaning if it is not in English.
pub(super) fn heading(section: &str) -> (&str, Option<&str>) {
    let gloss = section.strip_suffix(')').and_then(|section| section.rsplit_once(" ("));
    match gloss {
        Some((heading, gloss)) if !heading.is_ascii() => (heading, Some(gloss)),
        _ => (section, None),
    }
}

/// The language of a text for the `lang` attribute; `None` for English.
pub(super) fn language(text: &str) -> Option<&'static str> {
    let hangul = '\u{ac00}'..='\u{d7a3}';
    text.chars().any(|character| hangul.contains(&character)).then_some("ko")
}

/// The id of a place in a page. It is the same in every report.
pub(super) fn anchor(kind: &str, id: &str) -> String {
    let plain = |character: char| match character {
        '.' | '/' | '_' => character,
        _ if character.is_alphanumeric() => character,
        _ => '-',
    };
    format!("{kind}-{}", id.chars().map(plain).collect::<String>())
}

/// A sign for a verdict, for readers who do not see its colour.
pub(super) const fn mark(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Pass => "✓",
        Verdict::Fail | Verdict::UnexpectedPass => "✗",
        Verdict::Warn => "!",
        Verdict::Recorded => "?",
        Verdict::Skip => "–",
        Verdict::ExpectedFailure => "≈",
        Verdict::Flaky => "↯",
        Verdict::Timeout | Verdict::Crash | Verdict::AdapterFault | Verdict::NotRun => "⚠",
    }
}

/// The texts, with numbers if there are several.
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
    fn a_korean_heading_has_its_language_and_its_meaning() {
        let korean = "Packet 처리 (packet handling)";
        assert_eq!(heading(korean), ("Packet 처리", Some("packet handling")));
        assert_eq!((language(korean), language("Write (0x03)")), (Some("ko"), None));
        assert_eq!(heading("Write (0x03)"), ("Write (0x03)", None));
    }

    #[test]
    fn every_third_digit_has_a_comma() {
        let numbers = [0, 999, 1000, 61260, 1_234_567].map(thousands);
        assert_eq!(numbers, ["0", "999", "1,000", "61,260", "1,234,567"]);
        assert_eq!([count(1, "check"), count(0, "check")], ["1 check", "0 checks"]);
    }
}
