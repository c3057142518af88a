//! The direction of dependencies in `ARCHITECTURE.md`, compared with the manifests.

#![allow(clippy::unwrap_used, clippy::indexing_slicing)] // tests may stop at a surprise

use std::collections::{BTreeMap, BTreeSet};
use std::process::Command;

use serde_json::Value;

/// A member's dependencies of one kind, by name.
type Dependencies = BTreeMap<String, BTreeSet<String>>;

/// Cargo's metadata of each member.
fn packages() -> Vec<Value> {
    let output = Command::new(env!("CARGO"))
        .args(["metadata", "--format-version", "1", "--no-deps", "--offline"])
        .args(["--manifest-path", concat!(env!("CARGO_MANIFEST_DIR"), "/../Cargo.toml")])
        .output()
        .unwrap();
    let metadata: Value = serde_json::from_slice(&output.stdout).unwrap();
    metadata["packages"].as_array().unwrap().clone()
}

/// For each member its dependencies of a kind: `null` is a normal one.
fn dependencies(kind: &Value) -> Dependencies {
    let name = |value: &Value| value["name"].as_str().unwrap().to_owned();
    let packages = packages();
    let members = packages.iter().map(|package| {
        let all = package["dependencies"].as_array().unwrap();
        let of_kind = all.iter().filter(|dependency| dependency["kind"] == *kind);
        (name(package), of_kind.map(name).collect())
    });
    members.collect()
}

fn members(names: &BTreeSet<String>) -> Vec<&str> {
    names.iter().map(String::as_str).filter(|name| name.starts_with("actucheck")).collect()
}

#[test]
fn data_flows_one_way() {
    let normal = dependencies(&Value::Null);
    assert_eq!(normal.len(), 5, "members of the workspace");
    assert!(members(&normal["actucheck-spec"]).is_empty());
    assert_eq!(members(&normal["actucheck"]), ["actucheck-codec", "actucheck-spec"]);
    for (member, dependencies) in &normal {
        assert!(!dependencies.contains("actucheck"), "{member} depends on the suite");
    }
}

#[test]
fn the_codec_needs_nothing_at_run_time() {
    assert!(dependencies(&Value::Null)["actucheck-codec"].is_empty());
    assert_eq!(members(&dependencies(&"build".into())["actucheck-codec"]), ["actucheck-spec"]);
}
