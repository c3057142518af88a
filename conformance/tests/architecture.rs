//! Checks the invariants of `ARCHITECTURE.md` against the manifests and the sources.

#![allow(clippy::unwrap_used, clippy::indexing_slicing)] // tests may stop at a surprise

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use actucheck_spec::wire::Wire;
use serde_json::Value;

/// A member's dependencies of one kind, by name.
type Dependencies = BTreeMap<String, BTreeSet<String>>;

/// The members, by their folders and their crates' names.
const MEMBERS: [(&str, &str); 5] = [
    ("spec", "actucheck_spec"),
    ("codec", "actucheck_codec"),
    ("conformance", "actucheck"),
    ("fuzz", "actucheck_fuzz"),
    ("benches", "actucheck_benches"),
];

/// The places outside the suite that use it.
const USERS: [&str; 3] =
    ["fuzz/src/targets/bus", "fuzz/src/targets/forms", "fuzz/src/targets/readers"];

fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

/// For each member its dependencies of a kind: `null` is a normal one.
fn dependencies(kind: &Value) -> Dependencies {
    let output = Command::new(env!("CARGO"))
        .args(["metadata", "--format-version", "1", "--no-deps", "--offline"])
        .args(["--manifest-path", root().join("Cargo.toml").to_str().unwrap()])
        .output()
        .unwrap();
    let metadata: Value = serde_json::from_slice(&output.stdout).unwrap();
    let name = |value: &Value| value["name"].as_str().unwrap().to_owned();
    let members = metadata["packages"].as_array().unwrap().iter().map(|package| {
        let all = package["dependencies"].as_array().unwrap();
        let of_kind = all.iter().filter(|dependency| dependency["kind"] == *kind);
        (name(package), of_kind.map(name).collect())
    });
    members.collect()
}

fn members(names: &BTreeSet<String>) -> Vec<&str> {
    names.iter().map(String::as_str).filter(|name| name.starts_with("actucheck")).collect()
}

/// The Rust files below a folder, by their paths from the workspace's top.
fn sources(folder: &str) -> Vec<(String, String)> {
    fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() && !path.ends_with("target") && !path.ends_with("adapters") {
                collect(&path, files);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                files.push(path);
            }
        }
    }
    let mut files = Vec::new();
    collect(&root().join(folder), &mut files);
    let source = |path: PathBuf| {
        let name = path.strip_prefix(root()).unwrap().to_str().unwrap().replace('\\', "/");
        (name, fs::read_to_string(path).unwrap())
    };
    files.into_iter().map(source).collect()
}

/// The lines of a file that are no comments, up to its tests.
fn code(text: &str) -> impl Iterator<Item = &str> {
    let product = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
    product.lines().filter(|line| !line.trim_start().starts_with("//"))
}

#[test]
fn data_flows_one_way() {
    let normal = dependencies(&Value::Null);
    assert_eq!(normal.len(), MEMBERS.len(), "members of the workspace");
    assert!(members(&normal["actucheck-spec"]).is_empty());
    assert_eq!(members(&normal["actucheck"]), ["actucheck-codec", "actucheck-spec"]);
    let all = ["actucheck", "actucheck-codec", "actucheck-spec"];
    assert_eq!(members(&normal["actucheck-fuzz"]), all);
    for (member, dependencies) in &normal {
        let may = member == "actucheck-fuzz";
        assert!(may || !dependencies.contains("actucheck"), "{member} depends on the suite");
    }
}

#[test]
fn the_codec_needs_nothing_at_run_time() {
    assert!(dependencies(&Value::Null)["actucheck-codec"].is_empty());
    assert_eq!(members(&dependencies(&"build".into())["actucheck-codec"]), ["actucheck-spec"]);
}

/// The manifests show the allowed dependencies, the sources the actual ones.
#[test]
fn sources_use_no_more_than_they_may() {
    for (folder, may) in [
        ("spec/src", &[][..]),
        ("codec/src", &[]),
        ("conformance/src", &["actucheck_spec", "actucheck_codec", "actucheck"]),
        ("fuzz", &["actucheck_spec", "actucheck_codec"]),
    ] {
        for (path, text) in sources(folder) {
            // They feed the suite's readers and virtual devices.
            let feeds = USERS.iter().any(|user| path.starts_with(user));
            let may = if feeds { &[may, &["actucheck"]].concat() } else { may };
            // The generator writes the codec's name for crates that use it.
            for line in code(&text).filter(|line| !line.contains("quote!(")) {
                for (own, member) in MEMBERS {
                    let named = line.contains(&format!("{member}::"));
                    let may = may.contains(&member) || path.starts_with(own);
                    assert!(may || !named, "{path} uses {member}: {line}");
                }
            }
        }
    }
}

/// A file is part of one crate, that of its folder.
#[test]
fn no_module_is_taken_from_another_crate() {
    for (folder, _) in MEMBERS {
        for (path, text) in sources(folder) {
            for line in code(&text).filter(|line| line.trim_start().starts_with("#[path")) {
                assert!(!line.contains(".."), "{path}: {line}");
            }
        }
    }
}

/// The reference model is there to find the codec and the generator wrong.
#[test]
fn the_reference_shares_nothing_with_what_it_judges() {
    let mut files = 0;
    for (path, text) in sources("spec/src/wire") {
        if !path.contains("/reference") {
            continue;
        }
        files += 1;
        for line in code(&text).filter(|line| line.trim_start().starts_with("use ")) {
            let judged = ["codec", "generate", "validate"];
            assert!(!judged.iter().any(|word| line.contains(word)), "{path}: {line}");
        }
    }
    assert!(files >= Wire::ALL.len(), "{files} files");
}

#[test]
fn unsafe_code_is_in_few_places() {
    let places = ["codec/src/simd/", "benches/", "fuzz/src/lib.rs"];
    for (folder, _) in MEMBERS {
        for (path, text) in sources(folder) {
            let used = code(&text).any(|line| {
                ["unsafe {", "unsafe fn", "unsafe impl", "allow(unsafe_code"]
                    .iter()
                    .any(|word| line.contains(word))
            });
            let may = places.iter().any(|place| path.starts_with(place))
                || path == "conformance/tests/architecture.rs";
            assert!(!used || may, "{path} has unsafe code");
        }
    }
}

/// The places outside a wire's own folders that name it: registries, with one line per wire, and
/// code that is about one wire by its nature.
const NAMED: [(&str, &str); 32] = [
    ("spec/src/wire/mod.rs", "registry"),
    ("spec/src/generate/device.rs", "control tables are of one wire"),
    ("codec/src/lib.rs", "registry"),
    ("codec/src/error.rs", "registry: the one error that those of all wires turn into"),
    ("codec/src/crc/mod.rs", "registry: the CRCs' constants, held to the documents'"),
    ("codec/src/simd/", "searches for the pattern of byte stuffing, which one wire has"),
    ("codec/src/register/", "control tables are of one wire"),
    ("codec/examples/", "a program for a device is for one wire"),
    ("conformance/src/device/", "control tables are of one wire"),
    ("conformance/src/suite/codec/mod.rs", "registry"),
    ("conformance/src/suite/host/mod.rs", "registry"),
    ("conformance/src/suite/device/mod.rs", "registry"),
    ("conformance/src/subject/builtin/mod.rs", "registry"),
    ("conformance/src/bus/mod.rs", "registry"),
    ("conformance/src/compose/mod.rs", "registry"),
    ("conformance/src/explain/mod.rs", "registry"),
    ("conformance/src/blackbox/wire/mod.rs", "registry"),
    ("conformance/src/adapter/lint/example.rs", "registry: questions that any adapter can take"),
    ("conformance/src/command/codec.rs", "an example in a help text"),
    ("conformance/src/command/device.rs", "an example in a help text"),
    ("conformance/src/command/decode.rs", "an example in a help text"),
    ("conformance/src/command/encode.rs", "an example in a help text"),
    ("conformance/src/command/fuzz.rs", "an example in a help text"),
    ("conformance/src/command/host.rs", "an example in a help text"),
    ("conformance/src/command/list.rs", "an example in a help text"),
    ("conformance/src/command/replay.rs", "an example in a help text"),
    ("conformance/src/command/show.rs", "an example in a help text"),
    ("conformance/src/command/spec/coverage.rs", "an example in a help text"),
    ("conformance/src/command/spec/show.rs", "an example in a help text"),
    ("fuzz/src/lib.rs", "registry: the targets"),
    ("fuzz/src/dictionary/mod.rs", "registry"),
    ("fuzz/src/targets/", "a target is about one wire; `mod.rs` and `spec_yaml.rs` list them"),
];

/// Whether a path is in a folder of the wire, or is its file.
fn is_own(path: &str, wire: &str) -> bool {
    path.split(['/', '.']).any(|part| part == wire)
}

/// To add a wire takes folders, and a line in each registry.
#[test]
fn a_wire_is_named_in_its_folders_and_in_registries() {
    let ids = Wire::ALL.map(|wire| wire.id());
    let mut unused: BTreeSet<_> = NAMED.iter().map(|(place, _)| *place).collect();
    let mut wrong = Vec::new();
    for folder in ["spec/src", "codec/src", "codec/examples", "conformance/src", "fuzz/src"] {
        for (path, text) in sources(folder) {
            if path.ends_with("/tests.rs") || ids.iter().any(|id| is_own(&path, id)) {
                continue;
            }
            let names = |line: &&str| {
                let line = line.to_lowercase();
                ids.iter().any(|id| line.contains(id))
            };
            let Some(line) = code(&text).find(names) else { continue };
            match NAMED.iter().find(|(place, _)| path.starts_with(place)) {
                Some((place, _)) => drop(unused.remove(place)),
                None => wrong.push(format!("{path}: {}", line.trim())),
            }
        }
    }
    assert!(wrong.is_empty(), "a wire is named in\n{}", wrong.join("\n"));
    assert!(unused.is_empty(), "no wire is named in {unused:?} any more");
}
