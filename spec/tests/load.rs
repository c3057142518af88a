//! The spec folder is read as it is meant to be, as YAML and as JSON.

#![allow(clippy::unwrap_used, clippy::indexing_slicing, clippy::panic)] // tests may stop at a surprise

use actucheck_spec::load::embedded;
use actucheck_spec::{Diagnostic, Spec};

#[test]
fn the_folder_is_free_of_defects() {
    if let Err(defects) = Spec::read(&embedded()) {
        let list: Vec<_> = defects.iter().map(Diagnostic::excerpt).collect();
        panic!("{}", list.join("\n"));
    }
}

#[test]
fn the_json_says_what_the_yaml_says() {
    let (yaml, json) = (Spec::read(&embedded()).unwrap(), Spec::embedded().unwrap());
    assert!(format!("{yaml:?}") == format!("{json:?}"), "a file is read otherwise as JSON");
}

#[test]
fn a_missing_file_is_a_defect() {
    let without: Vec<_> =
        embedded().into_iter().filter(|file| file.path != "spec/errata.yaml").collect();
    let defects = Spec::read(&without).unwrap_err();
    assert_eq!(defects[0].message, "the file errata.yaml is missing from the spec folder");
}
