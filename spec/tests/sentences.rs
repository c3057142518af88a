//! `sentences/` has every sentence of the documents, and no others.
//!
//! The tests that read the documents need their folder; without it they print a note and pass.

#![allow(clippy::unwrap_used, clippy::indexing_slicing)] // tests may stop at a surprise

#[path = "support/folder.rs"]
mod folder;

use std::fs;
use std::path::Path;

use actucheck_spec::Spec;

/// A sentence of a document: the line that it begins on, from 1, and its text.
type Sentence = (usize, String);

/// The sentences of a document. Headings don't count. A row of a table, a block of code and the
/// text before the document are one sentence each. Any other line is split at its full stops; a
/// part counts if it has a letter or a digit.
fn sentences(text: &str) -> Vec<Sentence> {
    let lines: Vec<_> = text.lines().collect();
    let indented = text.contains("<table");
    let mut found = Vec::new();
    let mut next = 0;
    while let Some(line) = lines.get(next) {
        let start = next;
        let block = |last: fn(&str) -> bool| {
            let behind = lines.iter().skip(start + 1);
            start + 1 + behind.take_while(|line| !last(line)).count()
        };
        next += 1;
        if start == 0 && *line == "---" {
            next = block(|line| line == "---") + 1;
            found.push((1, plain(&lines[..next].join(" "))));
        } else if line.starts_with("```") {
            next = block(|line| line.starts_with("```")) + 1;
            found.push((start + 1, words(&lines[start..next].join(" "))));
        } else if line.starts_with("<table") {
            next =
                start + lines[start..].iter().take_while(|line| !line.contains("</table>")).count();
            next += 1;
            found.extend(rows(start + 1, &lines[start..next].join("\n")));
        } else if indented && line.starts_with("    ") && !line.trim().is_empty() {
            next = block(|line| !line.starts_with("    ") && !line.trim().is_empty());
            found.push((start + 1, words(&lines[start..next].join(" "))));
        } else if line.trim_start().starts_with('|') {
            found.push((start + 1, plain(line)));
        } else if !is_heading(line) {
            found.extend(split(&plain(line)).into_iter().map(|text| (start + 1, text)));
        }
    }
    found.retain(|(_, text)| text.chars().any(char::is_alphanumeric));
    found
}

/// The documents that have a file, with its text.
fn documents(spec: &Spec, folder: &Path) -> Vec<(String, String)> {
    let documents = &spec.documents.content.documents;
    let read = |file| fs::read_to_string(folder.join(file)).unwrap();
    documents.iter().filter_map(|row| Some((row.id.clone(), read(row.file.as_ref()?)))).collect()
}

fn is_heading(line: &str) -> bool {
    line.trim_start_matches('#').starts_with(' ') && line.starts_with('#')
}

/// The rows of an HTML table that begins on line `first`.
fn rows(first: usize, table: &str) -> Vec<Sentence> {
    let mut parts = table.split("<tr");
    let mut line = first + parts.next().map_or(0, |head| head.matches('\n').count());
    let row = |part: &str| {
        let row = (line, plain(&format!("<tr{part}")));
        line += part.matches('\n').count();
        row
    };
    parts.map(row).collect()
}

/// A text without tags, with single spaces.
fn plain(text: &str) -> String {
    let mut out = String::new();
    let mut inside = false;
    let mut characters = text.chars().peekable();
    while let Some(character) = characters.next() {
        let tag = |next: &char| next.is_ascii_alphabetic() || *next == '/';
        match character {
            '<' if !inside && characters.peek().is_some_and(tag) => {
                inside = true;
                out.push(' ');
            }
            '>' if inside => inside = false,
            _ if !inside => out.push(character),
            _ => {}
        }
    }
    words(&out)
}

fn words(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Splits a line at full stops, question and exclamation marks, unless the next word begins with a
/// small letter or a digit. The number of a list item does not end a sentence.
fn split(line: &str) -> Vec<String> {
    let mut parts = Vec::new();
    let mut start = 0;
    for (at, _) in line.match_indices(['.', '?', '!']) {
        let mut behind = line[at + 1..].chars();
        let next = behind.next().filter(|next| *next == ' ').and_then(|_| behind.next());
        let goes_on = next.is_none_or(|next| next.is_lowercase() || next.is_numeric());
        let before = line[start..at].trim();
        let number = !before.is_empty() && before.chars().all(|digit| digit.is_ascii_digit());
        if !goes_on && !number {
            parts.push(line[start..=at].trim().to_owned());
            start = at + 1;
        }
    }
    parts.push(line[start..].trim().to_owned());
    parts
}

/// FNV-1a.
fn hash(text: &str) -> u32 {
    text.bytes().fold(0x811C_9DC5, |hash, byte| (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193))
}

#[test]
fn every_sentence_is_written_down_and_nothing_else() {
    let spec = Spec::embedded().unwrap();
    let Some(folder) = folder::documents() else { return };
    let mut faults = Vec::new();
    for (document, text) in documents(&spec, &folder) {
        let file = spec.sentences_of(&document).unwrap();
        let written: Vec<_> = file.sentences().map(|(_, row)| (row.line, row.hash)).collect();
        let printed: Vec<_> =
            sentences(&text).iter().map(|(line, text)| (*line, hash(text))).collect();
        let missing = printed.iter().filter(|row| !written.contains(row));
        faults.extend(missing.map(|(line, hash)| {
            format!("{document} line {line}: a sentence with hash {hash:#010x} is not there")
        }));
        let extra = written.iter().filter(|row| !printed.contains(row));
        faults.extend(extra.map(|(line, hash)| {
            format!("{document} line {line}: no sentence has hash {hash:#010x}")
        }));
        assert_eq!(written.len(), printed.len(), "{document}");
    }
    assert!(faults.is_empty(), "\n{}", faults.join("\n"));
}

#[test]
fn every_section_begins_on_its_line() {
    let spec = Spec::embedded().unwrap();
    let Some(folder) = folder::documents() else { return };
    for (document, text) in documents(&spec, &folder) {
        let lines: Vec<_> = text.lines().collect();
        for section in &spec.sentences_of(&document).unwrap().sections {
            // A heading that is not in English is followed by its meaning.
            let name = match section.section.rsplit_once(" (") {
                Some((name, _)) if !name.is_ascii() => name,
                _ => &section.section,
            };
            let line = lines[section.line - 1].replace(['*', '['], "");
            let is_first = section.line == 1 && section.level == 1;
            assert!(line.contains(name) || is_first, "{document} line {}", section.line);
        }
    }
}

#[test]
fn a_text_falls_into_its_sentences() {
    let text = "---\ntitle: x\n---\n# [Heading](#x)\n1. One. Two 2.0 is e.g. this. 3 more\n\n\
                | a | b |\n|:-:|---|\n| 1 | <b>2</b> |\n```\nint x;\ny\n```\n<!-- -->a < b\n";
    let found: Vec<_> =
        sentences(text).into_iter().map(|(line, text)| format!("{line} {text}")).collect();
    assert_eq!(
        found,
        [
            "1 --- title: x ---",
            "5 1. One.",
            "5 Two 2.0 is e.g. this. 3 more",
            "7 | a | b |",
            "9 | 1 | 2 |",
            "10 ``` int x; y ```",
            "14 <!-- -->a < b",
        ]
    );
    let table = "<table class=x>\n<tr><td>1</td></tr><tr>\n<td>2</td></tr></table>\n    code\n";
    let found: Vec<_> =
        sentences(table).into_iter().map(|(line, text)| format!("{line} {text}")).collect();
    assert_eq!(found, ["2 1", "2 2", "4 code"]);
}
