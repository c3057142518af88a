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

// What stands before // is no part of the comment.
pattern!(COMMENT, r"(?s)/\*.*?\*/|(?P<before>^|[^:])//.*$|#.*$");
// A shell's: `[root@pi ~]# `, `pi@raspberrypi:~ $ `.
pattern!(PROMPT, r"^\s*(?:\[\S+@[^\]]*\]|\S+@\S+)\s?[#$]\s");
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
// A number of a byte: `b0: `, `byte 3 =`, `data[3] =`, `[3]:`.
pattern!(
    INDEX,
    r"(?i)\bb\d+\s*(?:=|:\s)|\bbyte\s*\d+\s*[:=]|\w*\[\d+\]\s*[:=](?:\s*[^\s{\[(]|\s*$)"
);
// The same without a space, which is a label only if the numbers go up: B0:01 are two bytes.
pattern!(CLOSE_INDEX, r"(?i)\bb(?P<number>\d{1,3}):(?P<value>(?:0x)?[0-9a-f]{1,2}(?:[\s,;]|$))");
pattern!(COUNTER, r"^\s*\[\d+\]\s+\b");
pattern!(LABEL, r"[A-Za-z_][\w.]*\s*(?:\[\w*\])?\s*[:=]");
pattern!(REMARK, r"(?P<before>^|[^\w\])])[\[(](?P<inner>[^\[\](){},]*)[\])]");

/// How much of a text is a comment at its beginning. `#3` is a number, and `#define` has bytes after it.
pub(super) fn comment(text: &str) -> usize {
    let other =
        |word: &str| word.starts_with("define") || word.starts_with(|c: char| c.is_ascii_digit());
    let begins = text.starts_with("//") || text.strip_prefix('#').is_some_and(|word| !other(word));
    match text.strip_prefix("/*") {
        Some(inner) => inner.find("*/").map_or(text.len(), |end| end + 4),
        None if begins => text.len(),
        None => 0,
    }
}

/// What follows a shell's prompt.
fn without_prompt(line: &str) -> &str {
    let prompt = PROMPT.find(line).map_or(0, |found| found.end());
    line.get(prompt..).unwrap_or_default()
}

/// Whether a place in a line is in a comment.
pub(super) fn is_comment(line: &str, place: usize) -> bool {
    let rest = without_prompt(line);
    let place = place.saturating_sub(line.len() - rest.len());
    COMMENT.find_iter(rest).any(|found| {
        let start = found.as_str().find(['/', '#']).unwrap_or_default();
        let begins = found.as_str().get(start..).is_some_and(|text| comment(text) > 0);
        begins && found.start() < place && place < found.end()
    })
}

/// The time of a line, and its parts. `before` is where they are looked for; `payload` follows it.
pub(super) fn read(before: &str, payload: &str) -> (Option<Duration>, Vec<Marked>) {
    let before = without_prompt(before);
    // In a literal every character is a byte.
    let before =
        if payload.is_empty() { COMMENT.replace_all(before, "$before ") } else { before.into() };
    let (time, rest) = time(&before);
    // Arduino's monitor puts -> after the time of each line that it receives.
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

/// The direction that a name such as `UART RX` tells.
pub(super) fn direction(name: &str) -> Option<Direction> {
    // The pattern takes a verb only with a mark after it.
    WORD.captures(&format!("{name}:")).map(|word| direction_of(&word))
}

/// The time at the beginning of a line, and what follows it.
pub(super) fn time(line: &str) -> (Option<Duration>, &str) {
    let Some(found) = TIME.captures(line) else { return (None, line) };
    let part = |name| found.name(name).map(|part| part.as_str());
    let number = |name| part(name).and_then(|text| text.replace(',', ".").parse::<f64>().ok());
    let whole = |name| part(name).and_then(|text| text.parse::<u64>().ok());
    let time = if let (Some(hours), Some(minutes)) = (whole("hours"), whole("minutes")) {
        // The day is kept apart, so that microseconds stay exact.
        let before = days(part("day")) * 86_400 + hours * 3600 + minutes * 60;
        let seconds = number("seconds").and_then(|text| Duration::try_from_secs_f64(text).ok());
        seconds.and_then(|seconds| seconds.checked_add(Duration::from_secs(before)))
    } else {
        let factor = match part("unit").or(part("whole_unit")) {
            Some("ms") => 1e-3,
            Some("us" | "µs") => 1e-6,
            _ => 1.0,
        };
        let number = number("number").or(number("whole")).unwrap_or_default();
        Duration::try_from_secs_f64(number * factor).ok()
    };
    let rest = line.get(found.get_match().end()..).unwrap_or_default();
    (time, rest)
}

/// Days from a fixed day to `2026-11-27`.
fn days(date: Option<&str>) -> u64 {
    let mut parts = date.unwrap_or_default().split(['-', '/']).map_while(|part| part.parse().ok());
    let mut next = || -> u64 { parts.next().unwrap_or_default() };
    let (year, month, day) = (next(), next(), next());
    // March is the first month, so that leap days are last.
    let (year, month) =
        if month > 2 { (year, month - 3) } else { (year.saturating_sub(1), month + 9) };
    let leap = year / 4 - year / 100 + year / 400;
    year * 365 + leap + (month * 306 + 5) / 10 + day
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
    let numbers: Vec<_> = CLOSE_INDEX
        .captures_iter(&text)
        .map(|found| found.name("number").map_or("", |number| number.as_str()).parse::<usize>())
        .collect();
    let up =
        numbers.len() > 1 && numbers.iter().zip(0_usize..).all(|(number, at)| *number == Ok(at));
    let text = if up { CLOSE_INDEX.replace_all(&text, " $value") } else { text };
    let index = |found: &Captures<'_>| {
        let all = found.get_match().as_str();
        // The pattern looks one character beyond the label.
        let after = all.rfind([':', '=']).and_then(|at| all.get(at + 1..)).unwrap_or_default();
        format!(" {after}")
    };
    let text = INDEX.replace_all(&text, index);
    labelled(&text)
}

/// Numbers about the bytes, which are no bytes.
const ABOUT: [&str; 9] = ["len", "length", "size", "count", "n", "bytes", "seq", "no", "baud"];

/// Takes labels away, and with them numbers about the bytes such as `len=10`.
fn labelled(text: &str) -> String {
    let is_label = |label: &str| {
        let name = |c: u8| c.is_ascii_alphabetic() && !c.is_ascii_hexdigit();
        label.bytes().any(name) && !label.starts_with("0x")
    };
    let about = |label: &str| {
        let name = label.trim_end_matches(|c: char| !c.is_alphanumeric());
        ABOUT.contains(&name.to_ascii_lowercase().as_str())
    };
    let labels: Vec<_> = LABEL
        .find_iter(text)
        .filter(|label| is_label(label.as_str()))
        .map(|label| (label.start(), label.end(), about(label.as_str())))
        .collect();
    let Some((first, ..)) = labels.first() else { return text.to_owned() };
    let mut bare = text.get(..*first).unwrap_or_default().to_owned();
    let ends = labels.iter().skip(1).map(|(start, ..)| *start).chain([text.len()]);
    for ((_, start, about), end) in labels.iter().zip(ends) {
        let value = text.get(*start..end).unwrap_or_default();
        let word = value.trim().trim_end_matches([',', ';']);
        let number = word.bytes().all(|digit| digit.is_ascii_digit()) && !word.starts_with('0');
        if !(*about && number) {
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
