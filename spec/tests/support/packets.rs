//! Example packets, printed as rows of tables.

use actucheck_spec::model::{HexBytes, ProofKind};
use actucheck_spec::wire::dynamixel2::Dynamixel2;

use super::Finding;
use super::document::{Document, Line};

/// The fewest bytes in a row that counts as (a part of) a packet.
const FEWEST: usize = 4;

/// A packet as a document prints it.
pub(crate) struct Example<'a> {
    /// The line of its first row.
    pub(crate) line: &'a Line,
    /// The line of its last row, which has its CRC.
    pub(crate) last: &'a Line,
    /// Its bytes; where a cell is empty, none.
    pub(crate) bytes: Vec<u8>,
}

/// Every example packet. A row that does not begin with a header continues the row before it.
pub(crate) fn examples<'a>(wire: &Dynamixel2, document: &'a Document) -> Vec<Example<'a>> {
    let header = &wire.framing.header;
    let mut examples: Vec<Example> = Vec::new();
    for line in &document.lines {
        let Some(bytes) = row(line).filter(|bytes| bytes.len() >= FEWEST) else {
            continue;
        };
        match examples.last_mut() {
            Some(example) if !bytes.starts_with(header) => {
                example.bytes.extend(bytes);
                example.last = line;
            }
            _ => examples.push(Example { line, last: line, bytes }),
        }
    }
    examples
}

/// The bytes of a row in which every cell has bytes or is empty.
fn row(line: &Line) -> Option<Vec<u8>> {
    let mut bytes = Vec::new();
    for cell in line.cells() {
        for word in cell.split_whitespace() {
            let digits = word.trim_start_matches("0x");
            let digits = if digits.is_empty() { word } else { digits };
            bytes.push(u8::from_str_radix(digits, 16).ok().filter(|_| word.len() > 1)?);
        }
    }
    Some(bytes)
}

/// Whether header, length and CRC are right. In a fast status packet the last CRC covers the
/// others.
pub(crate) fn is_intact(wire: &Dynamixel2, bytes: &[u8]) -> bool {
    let header = wire.framing.header.len();
    let Some((covered, crc)) = bytes.split_last_chunk::<2>() else {
        return false;
    };
    let length = match bytes.get(header + 1..header + 3) {
        Some([low, high]) => usize::from(u16::from_le_bytes([*low, *high])),
        _ => return false,
    };
    bytes.starts_with(&wire.framing.header)
        && bytes.len() == header + 3 + length
        && wire.crc.compute(covered) == u16::from_le_bytes(*crc)
}

/// The example packets that are not intact.
pub(crate) fn findings(wire: &Dynamixel2, document: &Document) -> Vec<Finding> {
    examples(wire, document)
        .iter()
        .filter(|example| !is_intact(wire, &example.bytes))
        .map(|example| Finding {
            document: document.id.clone(),
            line: example.last.number,
            kind: ProofKind::Packet,
            what: format!("length or CRC of {} is wrong", HexBytes(example.bytes.clone())),
        })
        .collect()
}

#[test]
fn split_rows_are_joined_and_a_wrong_crc_is_found() {
    let spec = actucheck_spec::Spec::embedded().unwrap();
    let wire = &spec.wires.dynamixel2.content;
    let text = "| H1 | H2 |\n|:--:|:--:|\n\
                | 0xFF | 0xFF | 0xFD | 0x00 | 0x01 | 0x03 |\n\n\
                | 0x00 | **0x01** | 19 | 4E |\n\
                | FF FF FD 00 | 01 | 03 00 | 01 | 19 4F |\n";
    let document = Document::parse("x", text);
    let examples = examples(wire, &document);
    assert_eq!(examples.len(), 2);
    assert!(is_intact(wire, &examples[0].bytes));
    let lines: Vec<_> = findings(wire, &document).iter().map(|f| f.line).collect();
    assert_eq!(lines, [6]);
}
