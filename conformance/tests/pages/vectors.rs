//! The tests that the page of the test vectors shows: they pass, and fail if a vector is wrong.

use std::fs;
use std::path::Path;
use std::process::Command;

use super::{blocks, root};

/// A language, and how its program is run: a file of this name, built and started by this line.
const LANGUAGES: [(&str, &str, &str); 3] = [
    ("python", "vectors.py", "python3 vectors.py"),
    ("javascript", "vectors.js", "node vectors.js"),
    (
        "c",
        "vectors.c",
        "cc -std=c99 -Wall -Wextra -pedantic -o vectors vectors.c -lcjson && ./vectors",
    ),
];

/// What a language needs to be there.
fn there(language: &str) -> bool {
    let looks = match language {
        "python" => "command -v python3",
        "javascript" => "command -v node",
        _ => "echo '#include <cjson/cJSON.h>' | cc -E -",
    };
    Command::new("sh").args(["-c", looks]).output().unwrap().status.success()
}

fn passes(line: &str, folder: &Path) -> bool {
    let output = Command::new("sh").args(["-c", line]).current_dir(folder).output().unwrap();
    if !output.status.success() {
        eprintln!("{line}: {}", String::from_utf8_lossy(&output.stderr));
    }
    output.status.success()
}

#[test]
fn the_tests_of_the_page_pass_and_can_fail() {
    let page = fs::read_to_string(root().join("spec/export/README.md")).unwrap();
    let vectors = fs::read_to_string(root().join("spec/export/vectors.json")).unwrap();
    // The last byte of the printed Action is another.
    let wrong = vectors.replacen("\"fffffd000103000502ce\"", "\"fffffd000103000502cf\"", 1);
    assert_ne!(vectors, wrong);
    for (language, file, line) in LANGUAGES {
        let block = blocks(&page).find(|block| block.language == language);
        if !there(language) {
            eprintln!("skipped: there is nothing to run {language} with");
            continue;
        }
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join(file), block.unwrap().body).unwrap();
        fs::write(folder.path().join("vectors.json"), &vectors).unwrap();
        assert!(passes(line, folder.path()), "{language}");
        fs::write(folder.path().join("vectors.json"), &wrong).unwrap();
        assert!(!passes(line, folder.path()), "{language} takes a wrong vector");
    }
}
