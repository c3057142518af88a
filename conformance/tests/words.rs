//! One word per concept: words that this project does not use, and what it says instead.

#![allow(clippy::unwrap_used)] // tests may stop at a surprise

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use actucheck_spec::Spec;

/// A text in lower case that is not used, the word to use, and the files that may have it.
const WORDS: [(&str, &str, &[&str]); 11] = [
    ("testee", "subject", &[]),
    ("presume", "require", &["conformance/src/suite/check.rs"]), // reads older files of checks
    ("framekind", "direction", &[]),
    ("golden", "test vector", &[]),
    ("leave open", "leave unspecified", &[]),
    ("leaves open", "leaves unspecified", &[]),
    // At the end of a sentence of a YAML file. An erratum or a file may be open.
    ("is open\n", "is unspecified", &[]),
    ("is open:", "is unspecified", &[]),
    ("bit stuffing", "byte stuffing", &[]),
    ("register map", "control table", &[]),
    ("known failure", "expected failure", &[]),
];

const FOLDERS: [&str; 5] = ["spec", "codec", "conformance", "fuzz", "benches"];
const ENDINGS: [&str; 4] = ["rs", "md", "yaml", "html"];

fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

/// The text files of the repository, relative to its root.
fn files() -> Vec<PathBuf> {
    let pages = ["README.md", "ARCHITECTURE.md", "CHANGELOG.md", "CONTRIBUTING.md", "SECURITY.md"];
    let mut files: Vec<PathBuf> = pages.map(PathBuf::from).into();
    let mut folders: Vec<PathBuf> = FOLDERS.map(PathBuf::from).into();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(root().join(&folder)).unwrap() {
            let entry = entry.unwrap();
            let path = folder.join(entry.file_name());
            let name = entry.file_name().into_string().unwrap();
            let built = ["target", ".venv", "node_modules"].contains(&name.as_str());
            if entry.file_type().unwrap().is_dir() && !built {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ENDINGS.iter().any(|e| ending == *e)) {
                files.push(path);
            }
        }
    }
    files.retain(|path| path != Path::new("conformance/tests/words.rs"));
    files
}

#[test]
fn each_concept_has_one_word() {
    let files = files();
    assert!(files.len() > 300, "{} files", files.len());
    let mut wrong = Vec::new();
    for path in &files {
        let text = fs::read_to_string(root().join(path)).unwrap();
        let text = format!("{} {text}", path.display()).to_lowercase();
        for (word, instead, allowed) in WORDS {
            let may = allowed.iter().any(|file| path == Path::new(file));
            if text.contains(word) && !may {
                wrong.push(format!("{}: `{word}`; use `{instead}`", path.display()));
            }
            assert!(!may || text.contains(word), "{} no longer has {word}", path.display());
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn a_heading_has_one_gloss() {
    let spec = Spec::embedded().unwrap();
    let requirements = spec.requirements.iter().flat_map(|file| &file.content.requirements);
    let errata = &spec.errata.content.errata;
    let sections = requirements
        .map(|row| &row.source.section)
        .chain(errata.iter().map(|row| &row.source.section))
        .filter(|section| !section.is_ascii());
    let mut glosses = BTreeMap::new();
    for section in sections {
        let (heading, gloss) = section.rsplit_once(" (").unwrap();
        assert_eq!(*glosses.entry(heading).or_insert(gloss), gloss, "{heading}");
    }
    assert!(!glosses.is_empty(), "no citation has a gloss");
}
