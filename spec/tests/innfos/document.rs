//! The document as text, tables and frames.

use std::io::{Write, stderr};
use std::path::{Path, PathBuf};
use std::{env, fs};

/// A table as rows of cells, without tags.
pub(crate) type Table = Vec<Vec<String>>;

/// The document; if it is not available, prints a note and returns `None`.
pub(crate) fn read(spec: &actucheck_spec::Spec) -> Option<String> {
    let document = spec.document("innfos").expect("no such document");
    let file = document.file.as_ref().expect("the document has a file");
    let beside = || Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/documents");
    let path = env::var_os("ACTUCHECK_DOCUMENTS").map_or_else(beside, PathBuf::from).join(file);
    let text = fs::read_to_string(&path).ok();
    if text.is_none() {
        // Written directly, as the test harness hides the output of a passing test.
        let _ = writeln!(stderr(), "skipped: {} is not there", path.display());
    }
    text
}

/// Every table, in order.
pub(crate) fn tables(text: &str) -> Vec<Table> {
    let tables = text.split("<table").skip(1);
    tables
        .map(|table| {
            let end = table.find("</table>").unwrap_or(table.len());
            let rows = table[..end].split("<tr").skip(1);
            rows.map(cells).collect()
        })
        .collect()
}

fn cells(row: &str) -> Vec<String> {
    let row = row.replace("<th", "<td");
    row.split("<td")
        .skip(1)
        .map(|cell| {
            let text = cell.split_once('>').map_or("", |(_, text)| text);
            let mut plain = String::new();
            let mut inside = false;
            for character in text.chars() {
                match character {
                    '<' => inside = true,
                    '>' => inside = false,
                    _ if !inside => plain.push(character),
                    _ => {}
                }
            }
            plain.split_whitespace().collect::<Vec<_>>().join(" ")
        })
        .collect()
}

/// The first table one of whose cells begins with `title`.
pub(crate) fn table(text: &str, title: &str) -> Table {
    let mut tables = tables(text).into_iter();
    tables
        .find(|rows| rows.iter().flatten().any(|cell| cell.starts_with(title)))
        .unwrap_or_else(|| panic!("the document has no table {title}"))
}

/// A number as the document prints them: `0x5`, `0x05：`, `0xED `.
pub(crate) fn hex(text: &str) -> Option<u16> {
    let text = text.trim().trim_end_matches('：').trim();
    let digits = text.strip_prefix("0x").or(text.strip_prefix("0X"))?;
    u16::from_str_radix(digits, 16).ok()
}

/// Several numbers with white space between them.
pub(crate) fn bytes(text: &str) -> Option<Vec<u8>> {
    let numbers = text.split_whitespace().map(hex);
    numbers.map(|number| number.and_then(|number| u8::try_from(number).ok())).collect()
}

/// The frames between backticks.
pub(crate) fn frames(text: &str) -> Vec<Vec<u8>> {
    text.split('`')
        .skip(1)
        .step_by(2)
        .filter_map(bytes)
        .filter(|bytes| bytes.len() > 1 && bytes.first() == Some(&0xEE))
        .collect()
}

/// The bytes of a C array.
pub(crate) fn array(text: &str, name: &str) -> Vec<u8> {
    let start = text.find(name).expect("no such array");
    let (_, body) = text[start..].split_once('{').expect("no array");
    let (body, _) = body.split_once('}').expect("the array does not end");
    bytes(&body.replace(',', " ")).expect("no bytes")
}
