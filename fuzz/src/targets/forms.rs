//! The readers of what people paste: hex, lists, logs, dumps, tables and captures.

use std::fmt::Write as _;
use std::io::Cursor;

use actucheck::capture::{self, Form, Unreadable};
use actucheck::compose::notation::Notation;
use actucheck_spec::Spec;

/// How an input says its form.
enum Mark {
    /// By itself.
    Sure,
    /// The bytes may be meant otherwise, which is an error then.
    Doubtful,
    /// It has to be told.
    None,
}

/// Bytes in a form.
struct Written {
    text: Vec<u8>,
    form: Form,
    mark: Mark,
}

impl Written {
    fn new(form: Form, mark: Mark, text: impl Into<Vec<u8>>) -> Self {
        Self { text: text.into(), form, mark }
    }
}

/// Takes any input through every reader, and as bytes through every form and back.
///
/// # Panics
/// If a reader panics, refuses an input in more than one sentence, or finds other bytes than were
/// written.
pub fn check(input: &[u8]) {
    for form in Form::ALL.into_iter().map(Some).chain([None]) {
        if let Err(error) = read(input, form) {
            assert_eq!(error.to_string().lines().count(), 1, "{error}");
        }
    }
    if !input.is_empty() {
        for written in written(input) {
            comes_back(&written, input);
        }
    }
}

fn read(input: &[u8], form: Option<Form>) -> Result<Vec<u8>, Unreadable> {
    let reading = capture::open(Cursor::new(input.to_vec()), form)?;
    let pieces = reading.pieces.collect::<Result<Vec<_>, _>>()?;
    Ok(pieces.into_iter().flat_map(|piece| piece.bytes).collect())
}

fn comes_back(Written { text, form, mark }: &Written, bytes: &[u8]) {
    let shown = || String::from_utf8_lossy(text);
    assert_eq!(read(text, Some(*form)).unwrap(), bytes, "{form}: {}", shown());
    match (mark, read(text, None)) {
        (Mark::None, _) => {}
        (Mark::Doubtful, Err(Unreadable::Ambiguous(readings))) => {
            let meant = readings.iter().any(|(_, found)| found == bytes);
            assert!(meant, "{readings:?}: {}", shown());
        }
        (Mark::Sure | Mark::Doubtful, found) => {
            assert_eq!(found.unwrap(), bytes, "found: {}", shown());
        }
    }
}

/// The bytes in every form, as programs and people write them.
fn written(bytes: &[u8]) -> Vec<Written> {
    let hex = |separator: &str| joined(bytes, separator, |byte| format!("{byte:02x}"));
    let decimal = |separator: &str| joined(bytes, separator, |byte| byte.to_string());
    let signed: Vec<_> = bytes.iter().map(|byte| byte.cast_signed()).collect();
    let short = joined(bytes, " ", |byte| format!("{byte:X}"));
    let array = Notation::C.text(bytes);
    let rows = joined(bytes, "\n", |byte| format!("0.001,0x{byte:02X},"));
    let [hexdump, xxd] = dumps(bytes);
    let mut written = vec![
        Written::new(Form::Hex, Mark::Doubtful, Notation::Hex.text(bytes)),
        Written::new(Form::Hex, Mark::None, short),
        Written::new(Form::Decimal, Mark::Doubtful, decimal(" ")),
        Written::new(Form::Decimal, Mark::None, format!("[{}]", decimal(", "))),
        Written::new(Form::Decimal, Mark::None, format!("{signed:?}")),
        Written::new(
            Form::Decimal,
            Mark::Sure,
            format!("uint8_t packet[{}] = {array};", bytes.len()),
        ),
        Written::new(Form::Hex, Mark::Sure, log(bytes)),
        Written::new(Form::Escaped, Mark::Sure, Notation::Python.text(bytes)),
        // Their characters may look like any other form.
        Written::new(Form::Escaped, Mark::None, python(bytes)),
        Written::new(Form::Dump, Mark::None, hexdump),
        Written::new(Form::Dump, Mark::None, xxd),
        Written::new(Form::Csv, Mark::Sure, format!("Time [s],Value,Framing Error\n{rows}\n")),
        Written::new(Form::Pcap, Mark::Sure, pcap(bytes)),
        Written::new(Form::Raw, Mark::None, bytes),
    ];
    let separators = [", ", ":", "-", ";", " | ", "\n", ""];
    written.extend(separators.map(|other| Written::new(Form::Hex, Mark::None, hex(other))));
    written
}

fn joined(bytes: &[u8], separator: &str, word: impl Fn(u8) -> String) -> String {
    bytes.iter().copied().map(word).collect::<Vec<_>>().join(separator)
}

/// A line of a log for each half.
fn log(bytes: &[u8]) -> String {
    let (sent, received) = bytes.split_at(bytes.len() / 2);
    let hex = |bytes| joined(bytes, ", ", |byte| format!("0x{byte:02X}"));
    format!(
        "[12:00:01.5] TX: {}\n[12:00:02] RX ({} bytes): {}\n",
        hex(sent),
        received.len(),
        hex(received)
    )
}

/// `b'\xff@'`, as Python prints it.
fn python(bytes: &[u8]) -> String {
    let word = |byte: u8| match byte {
        b'\n' => "\\n".to_owned(),
        b'\r' => "\\r".to_owned(),
        b'\t' => "\\t".to_owned(),
        b'\\' => "\\\\".to_owned(),
        b'\'' => "\\'".to_owned(),
        b' '..=b'~' => char::from(byte).to_string(),
        other => format!("\\x{other:02x}"),
    };
    format!("b'{}'", joined(bytes, "", word))
}

/// `hexdump -C` and `xxd`.
fn dumps(bytes: &[u8]) -> [String; 2] {
    let hex = |byte| format!("{byte:02x}");
    let shown = |byte: u8| match byte {
        b' '..=b'~' => char::from(byte).to_string(),
        _ => ".".to_owned(),
    };
    let mut texts = [String::new(), String::new()];
    let [hexdump, xxd] = &mut texts;
    for (row, bytes) in bytes.chunks(16).enumerate() {
        let (at, text) = (row * 16, joined(bytes, "", shown));
        let (left, right) = bytes.split_at(bytes.len().min(8));
        let columns = format!("{}  {}", joined(left, " ", hex), joined(right, " ", hex));
        writeln!(hexdump, "{at:08x}  {columns:48}  |{text}|").unwrap();
        let groups: Vec<_> = bytes.chunks(2).map(|pair| joined(pair, "", hex)).collect();
        writeln!(xxd, "{at:08x}: {:39}  {text}", groups.join(" ")).unwrap();
    }
    writeln!(hexdump, "{:08x}", bytes.len()).unwrap();
    texts
}

/// One frame of a link that users give to a protocol of their own.
fn pcap(bytes: &[u8]) -> Vec<u8> {
    let size = u32::try_from(bytes.len()).unwrap();
    let header = [0xA1B2_C3D4, 0x0004_0002, 0, 0, 65535, 147_u32];
    let frame = [1, 2, size, size];
    let words = header.into_iter().chain(frame).flat_map(u32::to_le_bytes);
    words.chain(bytes.iter().copied()).collect()
}

/// Every vector in a form, one form after the other.
pub(crate) fn seeds(spec: &Spec) -> Vec<(String, Vec<u8>)> {
    let seed = |(at, vector): (usize, &actucheck_spec::model::Vector)| {
        let mut written = written(vector.frame());
        let Written { text, form, .. } = written.swap_remove(at % written.len());
        (format!("{}.{}", form.id(), vector.id), text)
    };
    spec.vectors().map(|(_, vector)| vector).enumerate().map(seed).collect()
}

/// What has a meaning in a form.
pub(crate) const TOKENS: [&str; 40] = [
    "0x",
    "0X",
    "\\x",
    "\\n",
    "\\377",
    "b'",
    "b\"",
    "'",
    "\"",
    "[",
    "]",
    "{",
    "}",
    "(",
    ")",
    ", ",
    ": ",
    ";",
    " | ",
    "-",
    "->",
    "<-",
    "TX: ",
    "RX: ",
    "sent: ",
    "received ",
    "len=10",
    "b0:",
    "byte 1: ",
    "data[0] = ",
    "[12:00:01.5] ",
    "2026-01-01 ",
    "0.5 ms ",
    "#",
    "//",
    "/*",
    "*/",
    "*\n",
    "00000000: ",
    "time,data\n",
];
