//! A document's lines with their headings.

use std::fs;

use actucheck_spec::Spec;

use super::folder;

/// A document as it was read.
pub(crate) struct Document {
    /// Its id in `documents.yaml`.
    pub(crate) id: String,
    /// Its lines.
    pub(crate) lines: Vec<Line>,
}

/// A line of a document.
pub(crate) struct Line {
    /// From 1.
    pub(crate) number: usize,
    /// Its headings, the outermost first.
    pub(crate) headings: Vec<String>,
    /// The line itself.
    pub(crate) text: String,
}

impl Document {
    /// Splits a document into lines.
    pub(crate) fn parse(id: &str, text: &str) -> Self {
        let mut open: Vec<(usize, String)> = Vec::new();
        let mut lines = Vec::new();
        for (index, text) in text.lines().enumerate() {
            if let Some((level, title)) = heading(text) {
                open.retain(|(outer, _)| *outer < level);
                open.push((level, title));
            }
            lines.push(Line {
                number: index + 1,
                headings: open.iter().map(|(_, title)| title.clone()).collect(),
                text: text.to_owned(),
            });
        }
        Self { id: id.to_owned(), lines }
    }
}

impl Line {
    /// Whether the line is in a section, given by its number or its heading.
    pub(crate) fn is_under(&self, section: &str) -> bool {
        self.headings.iter().any(|heading| {
            heading
                .strip_prefix(section)
                .is_some_and(|rest| !rest.starts_with(|c: char| c.is_ascii_digit()))
        })
    }

    /// The cells of a table's row, without emphasis; none in any other line.
    pub(crate) fn cells(&self) -> Vec<String> {
        let Some(row) = self.text.trim().strip_prefix('|') else {
            return Vec::new();
        };
        let row = row.strip_suffix('|').unwrap_or(row);
        row.split('|').map(|cell| cell.replace(['*', '`'], "").trim().to_owned()).collect()
    }
}

/// The level and the words of a heading.
fn heading(line: &str) -> Option<(usize, String)> {
    let words = line.trim_start_matches('#');
    let level = line.len() - words.len();
    let words = words.strip_prefix(' ').filter(|_| level > 0)?;
    let words = words.split("](").next().unwrap_or(words);
    Some((level, words.replace(['*', '['], "").trim().to_owned()))
}

/// The documents with these ids; if the folder is missing, prints a note and returns `None`.
pub(crate) fn read(spec: &Spec, ids: &[&str]) -> Option<Vec<Document>> {
    let folder = folder::documents()?;
    let documents = ids.iter().map(|id| {
        let document = spec.document(id).expect("documents.yaml has it");
        let file = document.file.as_ref().expect("the document has a file");
        let text = fs::read_to_string(folder.join(file)).expect("the document is there");
        Document::parse(id, &text)
    });
    Some(documents.collect())
}

#[test]
fn a_line_knows_its_headings_and_cells() {
    let text = "# [1.A](#a)\n## **1.1 B**\n| 0x01 | **2** |\n# 2.C\nwords\n";
    let document = Document::parse("x", text);
    assert_eq!(document.lines[2].headings, ["1.A", "1.1 B"]);
    assert_eq!(document.lines[2].cells(), ["0x01", "2"]);
    assert_eq!(document.lines[4].headings, ["2.C"]);
    assert!(document.lines[4].cells().is_empty());
    assert!(document.lines[2].is_under("1.1") && !document.lines[2].is_under("2.C"));
}
