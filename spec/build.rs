//! Lists the YAML files of this folder as Rust source, so that they are part of the crate; each as JSON
//! too, which is read ten times as fast.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{env, fs, io};

/// The files and folders of `spec/` that are data. Folders are searched recursively.
const DATA: [&str; 7] =
    ["documents.yaml", "errata.yaml", "wires", "devices", "vectors", "requirements", "sentences"];

fn main() -> io::Result<()> {
    let root = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default());
    let mut files = Vec::new();
    for name in DATA {
        println!("cargo::rerun-if-changed={name}");
        collect(&root.join(name), &mut files)?;
    }
    files.sort();

    let mut list = String::from("&[\n");
    for file in &files {
        let name = file.strip_prefix(&root).unwrap_or(file).to_string_lossy().replace('\\', "/");
        let json = match as_json(&fs::read_to_string(file)?) {
            Ok(json) => json,
            Err(why) => {
                println!("cargo::error=spec/{name}: {why}"); // which ends the build
                return Ok(());
            }
        };
        let file = file.to_string_lossy();
        let _ = writeln!(list, "    ({name:?}, include_str!({file:?}), {json:?}),");
    }
    list.push(']');
    let out = PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default());
    fs::write(out.join("sources.rs"), list)
}

/// The reader's message ends with line and column.
fn as_json(yaml: &str) -> Result<String, String> {
    let value: serde_yaml::Value = serde_yaml::from_str(yaml).map_err(|error| error.to_string())?;
    serde_json::to_string(&value).map_err(|error| error.to_string())
}

fn collect(path: &Path, files: &mut Vec<PathBuf>) -> io::Result<()> {
    if path.is_dir() {
        for entry in fs::read_dir(path)? {
            collect(&entry?.path(), files)?;
        }
    } else if path.extension().is_some_and(|extension| extension == "yaml") {
        files.push(path.to_owned());
    }
    Ok(())
}
