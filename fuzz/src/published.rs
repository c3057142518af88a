//! The generated files of this folder: seeds from the test vectors, dictionaries from the spec,
//! libFuzzer's options from the table of targets.

use std::fmt::Write;
use std::fs;

use actucheck_spec::{Spec, load};

use crate::dictionary::{self, Tokens};
use crate::targets::{forms, readers, spec_yaml};
use crate::{Seeds, TARGETS, Target};

/// Inputs up to this many bytes are short.
const SHORT: usize = 300;

/// A generated file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct File {
    /// Its path below this folder, with forward slashes.
    pub path: String,
    /// Its content.
    pub bytes: Vec<u8>,
}

/// Every generated file.
#[must_use]
pub fn all(spec: &Spec) -> Vec<File> {
    let mut files = Vec::new();
    for seeds in Seeds::all() {
        let file = |(name, bytes)| File { path: format!("seeds/{}/{name}", seeds.name()), bytes };
        files.extend(self::seeds(spec, seeds).into_iter().map(file));
        let path = format!("dictionaries/{}.dict", seeds.name());
        files.push(File { path, bytes: dictionary(spec, seeds).into() });
    }
    files.extend(TARGETS.iter().map(|target| File {
        path: format!("options/{}.options", target.name),
        bytes: options(target).into(),
    }));
    files
}

/// The seeds of a family by name: a wire's vectors by their ids; the loader's files by their paths
/// or by their cases.
fn seeds(spec: &Spec, seeds: Seeds) -> Vec<(String, Vec<u8>)> {
    let wire = match seeds {
        Seeds::Wire(wire) => wire,
        Seeds::Texts => return readers::seeds(),
        Seeds::Forms => return forms::seeds(spec),
        Seeds::Yaml => return files().collect(),
    };
    let vectors = spec.vectors().filter(|(file, _)| file.wire == wire);
    vectors.map(|(_, vector)| (vector.id.clone(), vector.frame().to_vec())).collect()
}

/// The loader's files.
fn files() -> impl Iterator<Item = (String, Vec<u8>)> {
    let file = |(path, text): &(&str, &str)| {
        (path.replace('/', "."), format!("# as {path}\n{text}").into())
    };
    spec_yaml::BASE.iter().map(file).chain(cases())
}

/// The files of the loader's test cases, each with a defect or with a register of each kind.
fn cases() -> Vec<(String, Vec<u8>)> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../spec/tests/cases");
    let case = |entry: std::io::Result<fs::DirEntry>| {
        let entry = entry.unwrap();
        let name = entry.file_name().into_string().unwrap();
        (name, fs::read(entry.path().join("input.yaml")).unwrap())
    };
    fs::read_dir(folder).unwrap().map(case).collect()
}

/// The options file that `ClusterFuzz` reads next to a target's binary, and `flags` here.
fn options(target: &Target) -> String {
    let Target { max_len, seeds, .. } = target;
    let mut text = format!("[libfuzzer]\nmax_len = {max_len}\ndict = {}.dict\n", seeds.name());
    // Searching for a shorter input with the same features takes a quarter of the time of a short
    // input, and is worth it only for long ones.
    if *max_len <= SHORT {
        text.push_str("reduce_inputs = 0\n");
    }
    text
}

/// Pieces of inputs of a family, in libFuzzer's form.
fn dictionary(spec: &Spec, seeds: Seeds) -> String {
    let tokens = match seeds {
        Seeds::Wire(wire) => dictionary::of(wire, spec),
        Seeds::Yaml => keys(load::embedded().iter().map(|source| source.text.as_str())),
        Seeds::Texts => {
            let seeds = readers::seeds();
            keys(seeds.iter().filter_map(|(_, text)| std::str::from_utf8(text).ok()))
        }
        Seeds::Forms => forms::TOKENS.map(|token| token.as_bytes().to_vec()).into(),
    };
    let mut text = "# Generated; see `src/published.rs`.\n".to_owned();
    for token in tokens.iter().filter(|token| !token.is_empty()) {
        text.push('"');
        for byte in token {
            match byte {
                b'"' | b'\\' => text.extend(['\\', char::from(*byte)]),
                b' '..=b'~' => text.push(char::from(*byte)),
                _ => write!(text, "\\x{byte:02X}").unwrap(),
            }
        }
        text.push_str("\"\n");
    }
    text
}

/// The keys of the texts, YAML's own syntax, and the largest number.
fn keys<'a>(texts: impl IntoIterator<Item = &'a str>) -> Tokens {
    let word = |character: char| character.is_ascii_lowercase() || character == '_';
    let mut tokens = Tokens::new();
    for text in texts {
        let keys = text.split(|character| !word(character) && character != ':');
        let keys = keys.filter(|key| key.len() > 2 && key.find(':') == Some(key.len() - 1));
        tokens.extend(keys.map(|key| format!("{key} ").into()));
        // In JSON a quote is between a key and its colon.
        let parts: Vec<_> = text.split('"').collect();
        let keys = parts.windows(2).filter(|pair| pair[1].starts_with(':'));
        let keys = keys.map(|pair| pair[0]).filter(|key| key.chars().all(word));
        tokens.extend(keys.map(|key| format!("\"{key}\":").into()));
    }
    let syntax = [
        "- ",
        "\n  ",
        "[",
        "]",
        "{",
        "}",
        "'",
        "\"",
        "#",
        "&a ",
        "*a",
        "!!str ",
        "|\n",
        "---\n",
        "§",
        "𝄞",
        "18446744073709551615",
    ];
    tokens.extend(syntax.map(|token| token.as_bytes().to_vec()));
    tokens
}
