//! Defects of a spec, one folder per case: `input.yaml` replaces the file that its first line names
//! in the small spec of `tests/base`, and `diagnostics.txt` has the expected messages. Generation
//! cases have `expected.rs` instead.
//!
//! `ACCEPT=1 cargo test --workspace --test cases` writes the expected files anew; read the
//! difference before you commit it.

#![allow(clippy::unwrap_used, clippy::indexing_slicing)] // tests may stop at a surprise

use std::fs;
use std::path::{Path, PathBuf};

use actucheck_spec::load::Source;
use actucheck_spec::{Spec, generate};

fn tests() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests")
}

fn base() -> Vec<Source> {
    let mut sources = Vec::new();
    collect(&tests().join("base"), "", &mut sources);
    sources
}

fn collect(folder: &Path, prefix: &str, sources: &mut Vec<Source>) {
    let mut entries: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap()).collect();
    entries.sort_by_key(fs::DirEntry::file_name);
    for entry in entries {
        let name = format!("{prefix}{}", entry.file_name().to_str().unwrap());
        if entry.path().is_dir() {
            collect(&entry.path(), &format!("{name}/"), sources);
        } else {
            sources.push(Source::new(&name, &fs::read_to_string(entry.path()).unwrap()));
        }
    }
}

/// The base with the file that the case replaces or adds.
fn with_input(folder: &Path) -> Vec<Source> {
    let text = fs::read_to_string(folder.join("input.yaml")).unwrap();
    let name = text.lines().next().and_then(|line| line.strip_prefix("# as ")).unwrap();
    let input = Source::new(name, &text);
    let mut sources = base();
    sources.retain(|source| source.path != input.path);
    sources.push(input);
    sources
}

fn outcome(sources: &[Source]) -> (&'static str, String) {
    match Spec::read(sources) {
        Ok(spec) => {
            let modules = generate::codec(&spec).unwrap();
            let text: Vec<_> = modules.into_iter().map(|module| module.source).collect();
            ("expected.rs", text.join("\n"))
        }
        Err(defects) => {
            let text: Vec<_> =
                defects.iter().map(|defect| format!("{defect}\n{}\n", defect.excerpt())).collect();
            ("diagnostics.txt", text.join("\n"))
        }
    }
}

#[test]
fn the_base_has_no_defect() {
    let (kind, text) = outcome(&base());
    assert_eq!(kind, "expected.rs", "{text}");
}

#[test]
fn each_case_says_what_is_expected() {
    let accept = std::env::var_os("ACCEPT").is_some();
    let mut cases: Vec<_> =
        fs::read_dir(tests().join("cases")).unwrap().map(|entry| entry.unwrap().path()).collect();
    cases.sort();
    let mut wrong = Vec::new();
    for case in &cases {
        let (kind, text) = outcome(&with_input(case));
        // A case whose file no longer has the right keys would show nothing else.
        let misread = text.contains("unknown field") && !case.to_string_lossy().ends_with("-field");
        assert!(!misread, "{}: {text}", case.display());
        let expected = case.join(kind);
        if accept {
            fs::write(&expected, &text).unwrap();
        }
        let expected_text = fs::read_to_string(&expected).unwrap_or_default();
        if expected_text != text {
            wrong.push(format!(
                "{}\n--- expected\n{expected_text}\n--- got\n{text}",
                case.display()
            ));
        }
    }
    assert!(cases.len() >= 20, "only {} cases", cases.len());
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}
