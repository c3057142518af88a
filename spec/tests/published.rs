//! The generated files in this folder are up to date, and the YAML files fit their schemas.
//!
//! `ACCEPT=1 cargo test --workspace --test published` writes the files anew.

#![allow(clippy::unwrap_used, clippy::indexing_slicing)] // tests may stop at a surprise

use std::fs;
use std::path::Path;

use actucheck_spec::load::{self, Source};
use actucheck_spec::schema::{self, SchemaFile};
use actucheck_spec::{Spec, export};
use jsonschema::Validator;
use serde_json::Value;

fn spec() -> Spec {
    Spec::embedded().unwrap()
}

/// The generated files by their paths below the spec folder.
fn generated() -> Vec<(String, String)> {
    let mut files: Vec<_> =
        schema::all().into_iter().map(|SchemaFile { path, text }| (path, text)).collect();
    let vectors = export::vectors::export(&spec()).unwrap();
    files.push(("export/vectors.json".to_owned(), vectors));
    files.push(("export/actucheck.lua".to_owned(), export::wireshark::export(&spec())));
    files
}

fn validator(path: &str) -> Validator {
    let file = schema::all().into_iter().find(|file| file.path == path).unwrap();
    let schema: Value = serde_json::from_str(&file.text).unwrap();
    jsonschema::validator_for(&schema).unwrap()
}

/// The errors of a value by a schema, with their places.
fn faults(validator: &Validator, value: &Value) -> Vec<String> {
    let faults = validator.iter_errors(value);
    faults.map(|fault| format!("{}: {fault}", fault.instance_path())).collect()
}

fn name(source: &Source) -> &str {
    source.path.strip_prefix("spec/").unwrap()
}

#[test]
fn the_generated_files_are_fresh() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let accept = std::env::var_os("ACCEPT").is_some();
    let mut stale = Vec::new();
    for (path, text) in generated() {
        let file = folder.join(&path);
        if accept {
            fs::create_dir_all(file.parent().unwrap()).unwrap();
            fs::write(&file, &text).unwrap();
        }
        if fs::read_to_string(&file).is_ok_and(|there| there == text) {
            continue;
        }
        stale.push(path);
    }
    assert!(stale.is_empty(), "stale: {stale:?}; ACCEPT=1 cargo test --workspace --test published");
}

#[test]
fn every_yaml_file_names_its_schema_first_and_fits_it() {
    for source in load::embedded() {
        let schema = schema::of_source(name(&source)).unwrap();
        let up = "../".repeat(name(&source).matches('/').count());
        let first = format!("# yaml-language-server: $schema={up}{schema}");
        assert_eq!(source.text.lines().next(), Some(first.as_str()), "{}", source.path);

        let value: Value = serde_yaml::from_str(&source.text).unwrap();
        let faults = faults(&validator(&schema), &value);
        assert!(faults.is_empty(), "{}\n{}", source.path, faults.join("\n"));
    }
}

#[test]
fn a_broken_yaml_file_does_not_fit() {
    let sources = load::embedded();
    for (path, right, wrong) in [
        ("devices/ja40.yaml", "type: u16", "type: u17"),
        ("devices/ja40.yaml", "access: r\n", "acess: r\n"),
        ("devices/ja40.yaml", "[ja40 §2.2]", "[ja40 2.2]"),
        ("devices/ja40.yaml", "{min: 0, max: 252", "{min: 0, max: [252]"),
        ("wires/dynamixel2.yaml", "size: rest", "size: -1"),
        ("wires/innfos.yaml", "operation: read", "operation: both"),
        ("vectors/dynamixel2/ping.yaml", "kind: status", "kind: answer"),
        ("vectors/dynamixel2/ping.yaml", "printed: FF", "printed: FG"),
        ("requirements/ja40.yaml", "level: must", "level: shall"),
        ("errata.yaml", "    held_right: 5A 14 07\n", ""),
        ("documents.yaml", "id: ja40", "id: 40"),
    ] {
        let source = sources.iter().find(|source| name(source) == path).unwrap();
        assert!(source.text.contains(right), "{path} has no `{right}`");
        let broken = source.text.replacen(right, wrong, 1);
        let value: Value = serde_yaml::from_str(&broken).unwrap();
        let validator = validator(&schema::of_source(path).unwrap());
        assert!(!validator.is_valid(&value), "{path} with `{wrong}`");
    }
}

#[test]
fn the_json_exports_fit_their_schemas() {
    let spec = spec();
    for (schema, text) in [
        ("schema/export/spec.schema.json", export::json::export(&spec)),
        ("schema/export/vectors.schema.json", export::vectors::export(&spec)),
    ] {
        let mut value: Value = serde_json::from_str(&text.unwrap()).unwrap();
        let validator = validator(schema);
        let faults = faults(&validator, &value);
        assert!(faults.is_empty(), "{schema}\n{}", faults.join("\n"));
        value.as_object_mut().unwrap().remove("version");
        assert!(!validator.is_valid(&value), "{schema} without a version");
    }
}
