//! The modules of `report` are in an order: no module imports a later one.

use std::fs;
use std::path::Path;

/// Each module is after the modules that it may import. Modules of one row do not import each
/// other.
const REPORT: &[&[&str]] = &[
    &["model"],
    &["result"],
    &["smallest"],
    &["sums"],
    &["collect", "read"],
    &["merge"],
    &["fit", "words", "course"],
    &["view"],
    &["json", "jsonl", "junit", "tap", "github", "markdown", "html", "text"],
    &["badge"],
    &["format", "screen"],
    &["compare"],
    &["schema"],
];
const COMPARE: &[&[&str]] =
    &[&["model"], &["words"], &["regression"], &["text", "markdown", "html"]];

/// The modules after `path` that a source names, as in `path::one` or `path::{one, two::Type}`.
fn named<'a>(source: &'a str, path: &str) -> Vec<&'a str> {
    let word = |text: &'a str| text.split(|it: char| !it.is_alphanumeric() && it != '_').next();
    let mut found = Vec::new();
    for (at, _) in source.match_indices(path) {
        let rest = &source[at + path.len()..];
        match rest.strip_prefix('{').and_then(|rest| rest.split_once("};")) {
            Some((list, _)) => found.extend(list.split(',').filter_map(|item| word(item.trim()))),
            None => found.extend(word(rest)),
        }
    }
    found
}

fn later(order: &[&[&str]], source: &str, own: usize) -> Vec<String> {
    let names = named(source, "super::").into_iter();
    let row = |name: &&str| order.iter().position(|row| row.contains(name));
    names.filter(|name| row(name).is_some_and(|row| row >= own)).map(str::to_owned).collect()
}

#[test]
fn no_module_imports_one_that_comes_after_it() {
    let report = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/report");
    for (order, folder) in [(REPORT, report.clone()), (COMPARE, report.join("compare"))] {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            let name = path.file_stem().unwrap().to_str().unwrap();
            if name == "mod" {
                continue; // It is the folder's own name one level up, or the list of modules.
            }
            let own = order.iter().position(|row| row.contains(&name));
            let own = own.unwrap_or_else(|| panic!("{name} has no place in the order"));
            let file = if path.is_dir() { path.join("mod.rs") } else { path.clone() };
            let source = fs::read_to_string(file).unwrap();
            assert_eq!(later(order, &source, own), Vec::<String>::new(), "{name}");
        }
    }
}

#[test]
fn an_import_of_a_later_module_is_seen() {
    let source = "use super::{json, model::Report};\nuse super::compare::Cell;";
    assert_eq!(later(REPORT, source, 3), ["json", "compare"]);
    assert_eq!(later(REPORT, source, 10), ["compare"]);
}
