//! What people paste: a folder of `cases` for each, with `input`, the arguments if they are not `-`,
//! and what the program says. `ACCEPT=1` writes the latter anew; then every line of it is compared with
//! the documents by eye.
//!
//! `mistakes` makes packets wrong on purpose, as `made` has it. The fuzz target `forms` writes bytes in every form and reads
//! them again.

#![allow(clippy::unwrap_used, clippy::indexing_slicing)] // tests may stop at a surprise

mod answers;
mod bad;
mod made;
mod mistakes;
mod vectors;

use std::fs;
use std::path::{Path, PathBuf};

use assert_cmd::Command;

fn folders() -> Vec<PathBuf> {
    let cases = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/paste/cases");
    let mut folders: Vec<_> =
        fs::read_dir(cases).unwrap().map(|entry| entry.unwrap().path()).collect();
    folders.sort();
    folders
}

/// What the program says: its output, its error if any, and its exit status.
///
/// In `arguments` INPUT is the text of the input, and FILE its path.
fn said(folder: &Path) -> String {
    let input = fs::read(folder.join("input")).unwrap();
    let file = fs::read_to_string(folder.join("arguments")).unwrap_or_else(|_| "-".to_owned());
    let arguments = file.split_whitespace().map(|word| match word {
        "INPUT" => String::from_utf8(input.clone()).unwrap().trim_end().to_owned(),
        "FILE" => folder.join("input").to_str().unwrap().to_owned(),
        other => other.to_owned(),
    });
    let mut command = Command::cargo_bin("actucheck").unwrap();
    let output = command.arg("decode").args(arguments).write_stdin(input.clone()).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    let (out, error) = (text(output.stdout), text(output.stderr));
    let rule = if error.is_empty() { "" } else { "--- standard error\n" };
    format!("{out}{rule}{error}--- exit status {}\n", output.status.code().unwrap())
}

#[test]
fn what_people_paste_is_explained() {
    let mut wrong = Vec::new();
    for folder in folders() {
        let said = said(&folder);
        let file = folder.join("expected");
        if std::env::var_os("ACCEPT").is_some() {
            fs::write(&file, &said).unwrap();
        }
        let expected = fs::read_to_string(&file).unwrap_or_default();
        if expected != said {
            let name = folder.file_name().unwrap().to_str().unwrap().to_owned();
            wrong.push(format!("{name}:\n{said}\nwas expected to be\n{expected}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The lines of `--json` have the shape that their schema says.
#[test]
fn objects_fit_their_schema() {
    let (name, schema) = actucheck::explain::stream::lines::schema();
    let file = format!("{}/schema/{name}.schema.json", env!("CARGO_MANIFEST_DIR"));
    if std::env::var_os("ACCEPT").is_some() {
        fs::write(&file, &schema).unwrap();
    }
    assert!(fs::read_to_string(&file).unwrap() == schema, "ACCEPT=1 cargo test --test paste");
    let schema = jsonschema::validator_for(&serde_json::from_str(&schema).unwrap()).unwrap();
    let mut seen = 0;
    for folder in folders() {
        let expected = fs::read_to_string(folder.join("expected")).unwrap();
        for line in expected.lines().filter(|line| line.starts_with("{\"line\"")) {
            let value: serde_json::Value = serde_json::from_str(line).unwrap();
            let faults: Vec<_> =
                schema.iter_errors(&value).map(|fault| fault.to_string()).collect();
            assert!(faults.is_empty(), "{line}: {faults:?}");
            let mut broken = value;
            broken.as_object_mut().unwrap().remove("line");
            assert!(!schema.is_valid(&broken));
            seen += 1;
        }
    }
    assert!(seen > 5, "{seen} lines");
}
