//! What stands in a line beside the bytes: a time, directions, labels, remarks.

use std::sync::LazyLock;
use std::time::Duration;

use actucheck_spec::wire::Direction;
use regex::{Captures, Regex};

/// A part of a line, and the direction before it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Marked {
    pub(super) direction: Option<Direction>,
    pub(super) text: String,
}

macro_rules! pattern {
    ($name:ident, $text:literal) => {
        static $name: LazyLock<Regex> = LazyLock::new(|| {
            #[allow(clippy::expect_used)] // each is used by a test
            Regex::new($text).expect("a pattern of this file")
        });
    };
}

pattern!(COMMENT, r"(?s)/\*.*?\*/|(?:^|[^:])//.*$|#.*$");
pattern!(
    TIME,
    r"(?x)^ \s* [\[(]? \s* (?:
        (?: (?P<day>\d{4}[-/]\d\d[-/]\d\d) [T\s]+ )?
        (?P<hours>\d{1,2}) : (?P<minutes>\d\d) : (?P<seconds>\d\d(?:[.,]\d{1,9})?) (?:Z|[+-]\d\d:?\d\d)?
        | (?P<number>\d+\.\d+) \s* (?P<unit>s|ms|us|µs)?
        | (?P<whole>\d+) \s* (?P<whole_unit>s|ms|us|µs)
      ) \s* (?: [\])] \s*[-,|:]?\s* | [-,|:]?\s+ )"
);
pattern!(
    WORD,
    r"(?xi) (?:^|[^a-z0-9_]) (?P<word>txd?|rxd?) (?: \s*[\])] | \d*\b ) \s*(?:[:=|-]?>?|<?-?)?
        | (?:^|[^a-z0-9_])
          (?P<verb>sent|send|sending|wrote|write|writing|out|request|req|recv|rcvd|received|receive
            |receiving|read|reading|in|reply|response|resp|answer|ans)
          (?: \s+ [a-z]+ )? \s* (?: \(\d+\) )? \s* [\])]? \s* (?: [:=] | [-=]*>+ | <+[-=]* | [\])] )"
);
pattern!(ARROW, r"^\s*(?:(?P<out>-+>+|=+>+|>{1,3}|→)|(?P<in><+-+|<+=+|<{1,3}|←))");
// A number of a byte: `b0:`, `byte 3 =`, `data[3] =`, `[3]:`.
pattern!(INDEX, r"(?i)\b(?:b|byte\s*)\d+\s*[:=]|\w*\[\d+\]\s*[:=](?:\s*[^\s{\[(]|\s*$)");
pattern!(COUNTER, r"^\s*\[\d+\]\s+\b");
pattern!(LABEL, r"[A-Za-z_][\w.]*\s*(?:\[\w*\])?\s*[:=]");
pattern!(REMARK, r"(?P<before>^|[^\w\])])[\[(](?P<inner>[^\[\](){},]*)[\])]");

/// The time of a line, and its parts. `before` is where they are looked for; `payload` follows it.
pub(super) fn read(before: &str, payload: &str) -> (Option<Duration>, Vec<Marked>) {
    // In a literal every character is a byte.
    let before = if payload.is_empty() { COMMENT.replace_all(before, " ") } else { before.into() };
    let (time, rest) = time(&before);
    // Arduino's monitor puts -> behind the time of each line that it receives.
    let arrow = ARROW.captures(rest);
    let told = arrow.as_ref().filter(|arrow| time.is_none() || arrow.name("in").is_some());
    let mut direction = told.map(|arrow| match arrow.name("out") {
        Some(_) => Direction::Request,
        None => Direction::Reply,
    });
    let rest = rest.get(arrow.map_or(0, |arrow| arrow.get_match().end())..).unwrap_or_default();
    let mut marked = Vec::new();
    let mut start = 0;
    for word in WORD.captures_iter(rest) {
        let whole = word.get_match();
        let text = rest.get(start..whole.start()).unwrap_or_default();
        if !text.trim().is_empty() {
            marked.push(Marked { direction, text: bare(text) });
        }
        direction = Some(direction_of(&word));
        start = whole.end();
    }
    let text = bare(rest.get(start..).unwrap_or_default()) + payload;
    marked.push(Marked { direction, text });
    (time, marked)
}

fn direction_of(word: &Captures<'_>) -> Direction {
    let text = word.name("word").or(word.name("verb")).map_or("", |word| word.as_str());
    let first = text.get(..2).unwrap_or_default().to_ascii_lowercase();
    let request = match first.as_str() {
        "re" => text.to_ascii_lowercase().starts_with("req"),
        other => ["tx", "se", "wr", "ou"].contains(&other),
    };
    if request { Direction::Request } else { Direction::Reply }
}

/// The time at the beginning of a line, and what follows it.
fn time(line: &str) -> (Option<Duration>, &str) {
    let Some(found) = TIME.captures(line) else { return (None, line) };
    let part = |name| found.name(name).map(|part| part.as_str());
    let number = |name| part(name).and_then(|text| text.replace(',', ".").parse::<f64>().ok());
    let clock = number("hours").zip(number("minutes")).zip(number("seconds"));
    let seconds = if let Some(((hours, minutes), seconds)) = clock {
        days(part("day")) * 86_400.0 + hours * 3600.0 + minutes * 60.0 + seconds
    } else {
        let factor = match part("unit").or(part("whole_unit")) {
            Some("ms") => 1e-3,
            Some("us" | "µs") => 1e-6,
            _ => 1.0,
        };
        number("number").or(number("whole")).unwrap_or_default() * factor
    };
    let rest = line.get(found.get_match().end()..).unwrap_or_default();
    (Duration::try_from_secs_f64(seconds).ok(), rest)
}

/// Days from a fixed day to `2026-11-27`.
fn days(date: Option<&str>) -> f64 {
    let mut parts = date.unwrap_or_default().split(['-', '/']).filter_map(|part| part.parse().ok());
    let mut next = || -> f64 { parts.next().unwrap_or_default() };
    let (year, month, day) = (next(), next(), next());
    if day == 0.0 {
        return 0.0;
    }
    // March is the first month, so that leap days are last.
    let (year, month) = if month > 2.0 { (year, month - 3.0) } else { (year - 1.0, month + 9.0) };
    let leap = (year / 4.0).floor() - (year / 100.0).floor() + (year / 400.0).floor();
    year * 365.0 + leap + (month * 30.6 + 0.5).floor() + day
}

/// A text without labels and remarks.
fn bare(text: &str) -> String {
    let text = COUNTER.replace(text, " ");
    let remark = |found: &Captures<'_>| {
        let inner = found.name("inner").map_or("", |inner| inner.as_str());
        let bytes = inner.to_ascii_lowercase().replace("0x", "");
        let words = bytes.chars().any(|c| c.is_alphabetic() && !c.is_ascii_hexdigit());
        let all = found.get_match().as_str();
        if words {
            found.name("before").map_or("", |before| before.as_str()).to_owned() + " "
        } else {
            all.to_owned()
        }
    };
    let text = REMARK.replace_all(&text, remark);
    let index = |found: &Captures<'_>| {
        let all = found.get_match().as_str();
        // The pattern looks one character beyond the label.
        let after = all.rfind([':', '=']).and_then(|at| all.get(at + 1..)).unwrap_or_default();
        format!(" {after}")
    };
    let text = INDEX.replace_all(&text, index);
    labelled(&text)
}

/// Takes labels away, and with them numbers such as `len=10`, which say something about the bytes.
fn labelled(text: &str) -> String {
    let is_label = |label: &str| {
        label.bytes().any(|c| c.is_ascii_alphabetic() && !c.is_ascii_hexdigit())
            && !label.starts_with("0x")
    };
    let labels: Vec<_> = LABEL
        .find_iter(text)
        .filter(|label| is_label(label.as_str()))
        .map(|label| (label.start(), label.end()))
        .collect();
    let Some((first, _)) = labels.first() else { return text.to_owned() };
    let mut bare = text.get(..*first).unwrap_or_default().to_owned();
    let ends = labels.iter().skip(1).map(|(start, _)| *start).chain([text.len()]);
    for ((_, start), end) in labels.iter().zip(ends) {
        let value = text.get(*start..end).unwrap_or_default();
        let word = value.trim().trim_end_matches([',', ';']);
        let number = word.bytes().all(|digit| digit.is_ascii_digit()) && word.len() != 2;
        if labels.len() == 1 || !number {
            bare.push(' ');
            bare.push_str(value);
        }
    }
    bare
}

/// Whether a word of a log is no mistyped byte.
pub(super) fn is_plain_word(word: &str) -> bool {
    let others = word.chars().filter(|c| c.is_alphabetic() && !c.is_ascii_hexdigit()).count();
    let first = word.chars().next().is_some_and(|c| c.is_alphabetic() || c == '_');
    let mistyped = others == 1 && word.len().is_multiple_of(2) && word.to_uppercase() == word;
    (first && word.len() > 2 && others > 0 && !mistyped) || word.eq_ignore_ascii_case("ok")
}

/// A word that fits a message.
pub(super) fn shortened(word: &str) -> String {
    const SHOWN: usize = 24;
    match word.char_indices().nth(SHOWN) {
        Some((end, _)) => format!("{}…", word.get(..end).unwrap_or_default()),
        None => word.to_owned(),
    }
}
