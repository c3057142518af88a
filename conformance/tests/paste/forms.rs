//! Bytes that are written in a form come back.

use std::fmt::Write as _;

use actucheck::capture::{self, Form, Unreadable};
use proptest::prelude::*;

fn read(text: impl Into<Vec<u8>>, form: Option<Form>) -> Result<Vec<u8>, Unreadable> {
    let reading = capture::open(std::io::Cursor::new(text.into()), form)?;
    let pieces = reading.pieces.collect::<Result<Vec<_>, _>>()?;
    Ok(pieces.into_iter().flat_map(|piece| piece.bytes).collect())
}

fn joined(bytes: &[u8], separator: &str, word: impl Fn(u8) -> String) -> String {
    bytes.iter().copied().map(word).collect::<Vec<_>>().join(separator)
}

fn hex(byte: u8) -> String {
    format!("{byte:02x}")
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

fn shown(bytes: &[u8]) -> String {
    let word = |byte: u8| match byte {
        b' '..=b'~' => char::from(byte).to_string(),
        _ => ".".to_owned(),
    };
    joined(bytes, "", word)
}

/// `hexdump -C` and `xxd`.
fn dumps(bytes: &[u8]) -> [String; 2] {
    let mut texts = [String::new(), String::new()];
    let [hexdump, xxd] = &mut texts;
    for (row, bytes) in bytes.chunks(16).enumerate() {
        let (at, text) = (row * 16, shown(bytes));
        let (left, right) = bytes.split_at(bytes.len().min(8));
        let columns = format!("{}  {}", joined(left, " ", hex), joined(right, " ", hex));
        writeln!(hexdump, "{at:08x}  {columns:48}  |{text}|").unwrap();
        let groups: Vec<_> = bytes.chunks(2).map(|pair| joined(pair, "", hex)).collect();
        writeln!(xxd, "{at:08x}: {:39}  {text}", groups.join(" ")).unwrap();
    }
    writeln!(hexdump, "{:08x}", bytes.len()).unwrap();
    texts
}

fn pcap(bytes: &[u8]) -> Vec<u8> {
    let size = u32::try_from(bytes.len()).unwrap();
    let header = [0xA1B2_C3D4, 0x0004_0002, 0, 0, 65535, 147_u32];
    let frame = [1, 2, size, size];
    let words = header.into_iter().chain(frame).flat_map(u32::to_le_bytes);
    words.chain(bytes.iter().copied()).collect()
}

/// Bytes as people have them: many of headers and of text.
fn bytes() -> impl Strategy<Value = Vec<u8>> {
    let byte = prop_oneof![any::<u8>(), Just(0xFF), Just(0xFD), Just(0), b' '..=b'~'];
    prop::collection::vec(byte, 1..80)
}

proptest! {
    #[test]
    fn a_form_that_is_told(bytes in bytes()) {
        for separator in [" ", ", ", ":", "-", ";", " | ", "\n", ""] {
            let text = joined(&bytes, separator, hex);
            prop_assert_eq!(&read(text, Some(Form::Hex)).unwrap(), &bytes, "{:?}", separator);
        }
        let short = joined(&bytes, " ", |byte| format!("{byte:X}"));
        prop_assert_eq!(&read(short, Some(Form::Hex)).unwrap(), &bytes);
        let list = format!("{bytes:?}");
        prop_assert_eq!(&read(list, Some(Form::Decimal)).unwrap(), &bytes);
        let signed: Vec<_> = bytes.iter().map(|byte| byte.cast_signed()).collect();
        prop_assert_eq!(&read(format!("{signed:?}"), Some(Form::Decimal)).unwrap(), &bytes);
        prop_assert_eq!(&read(python(&bytes), Some(Form::Escaped)).unwrap(), &bytes);
        for text in dumps(&bytes) {
            prop_assert_eq!(&read(text.clone(), Some(Form::Dump)).unwrap(), &bytes, "{}", text);
        }
        prop_assert_eq!(&read(bytes.clone(), Some(Form::Raw)).unwrap(), &bytes);
    }

    #[test]
    fn a_form_that_is_found(bytes in bytes()) {
        let hex = joined(&bytes, ", ", |byte| format!("0x{byte:02X}"));
        let log = format!("[12:00:01.5] TX: {hex}\n[12:00:02] RX ({} bytes): {hex}\n", bytes.len());
        prop_assert_eq!(read(log, None).unwrap(), [&bytes[..], &bytes[..]].concat());
        let array = format!("uint8_t packet[{}] = {{ {hex} }};", bytes.len());
        prop_assert_eq!(&read(array, None).unwrap(), &bytes);
        for text in dumps(&bytes) {
            prop_assert_eq!(&read(text.clone(), None).unwrap(), &bytes, "{}", text);
        }
        let rows = joined(&bytes, "\n", |byte| format!("0.001,0x{byte:02X},"));
        let table = format!("Time [s],Value,Framing Error\n{rows}\n");
        prop_assert_eq!(&read(table, None).unwrap(), &bytes);
        prop_assert_eq!(&read(pcap(&bytes), None).unwrap(), &bytes);
        let text = python(&bytes);
        prop_assert_eq!(&read(text, None).unwrap(), &bytes);
    }

    /// Without a mark, hex or decimal is read right, or refused with both.
    #[test]
    fn a_form_that_may_be_another(bytes in bytes()) {
        for text in [joined(&bytes, " ", hex), joined(&bytes, " ", |byte| byte.to_string())] {
            match read(text, None) {
                Ok(found) => prop_assert_eq!(&found, &bytes),
                Err(Unreadable::Ambiguous(readings)) => {
                    prop_assert!(readings.iter().any(|(_, found)| *found == bytes));
                }
                Err(other) => return Err(TestCaseError::fail(other.to_string())),
            }
        }
    }
}
