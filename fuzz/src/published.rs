//! What is generated into this folder: seeds from the golden vectors, dictionaries from the spec,
//! libFuzzer's options from the table of targets.

use std::collections::BTreeSet;
use std::fmt::Write;
use std::fs;

use actucheck_spec::model::{Bound, Register};
use actucheck_spec::{Spec, load};

use crate::targets::spec_yaml;
use crate::{Seeds, TARGETS, Target};

/// Inputs of so many bytes are short.
const SHORT: usize = 300;

/// A generated file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct File {
    /// Its path below this folder, with forward slashes.
    pub path: String,
    /// All of it.
    pub bytes: Vec<u8>,
}

/// Every generated file.
#[must_use]
pub fn all(spec: &Spec) -> Vec<File> {
    let mut files = Vec::new();
    for seeds in Seeds::ALL {
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

/// The seeds of a family by name: the vectors of a wire by their ids, the loader's files by their
/// paths, or by the cases that they are of.
fn seeds(spec: &Spec, seeds: Seeds) -> Vec<(String, Vec<u8>)> {
    if seeds == Seeds::Yaml {
        let file = |(path, text): &(&str, &str)| {
            (path.replace('/', "."), format!("# as {path}\n{text}").into())
        };
        return spec_yaml::BASE.iter().map(file).chain(cases()).collect();
    }
    let vectors = spec.vectors().filter(|(file, _)| file.wire.id() == seeds.name());
    vectors.map(|(_, vector)| (vector.id.clone(), vector.frame().to_vec())).collect()
}

/// The files of the loader's own cases, each with a defect or a register of each kind.
fn cases() -> Vec<(String, Vec<u8>)> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../spec/tests/cases");
    let case = |entry: std::io::Result<fs::DirEntry>| {
        let entry = entry.unwrap();
        let name = entry.file_name().into_string().unwrap();
        (name, fs::read(entry.path().join("input.yaml")).unwrap())
    };
    fs::read_dir(folder).unwrap().map(case).collect()
}

/// What `ClusterFuzz` reads beside a target's binary, and `flags` here.
fn options(target: &Target) -> String {
    let Target { max_len, seeds, .. } = target;
    let mut text = format!("[libfuzzer]\nmax_len = {max_len}\ndict = {}.dict\n", seeds.name());
    // To look for a shorter input of the same features takes a quarter of a short one's time, and
    // pays for long ones alone.
    if *max_len <= SHORT {
        text.push_str("reduce_inputs = 0\n");
    }
    text
}

/// Pieces of inputs of a family, in libFuzzer's form.
fn dictionary(spec: &Spec, seeds: Seeds) -> String {
    let tokens = match seeds {
        Seeds::Dynamixel2 => packets(spec),
        Seeds::Innfos => frames(spec),
        Seeds::Yaml => keys(),
    };
    let mut text = "# Generated from the YAML in spec/.\n".to_owned();
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

type Tokens = BTreeSet<Vec<u8>>;

/// Header, pattern and stuffing, IDs, codes, addresses, and the limits of the registers with what
/// lies just outside.
fn packets(spec: &Spec) -> Tokens {
    let mut tokens = Tokens::new();
    let wire = &spec.wires.dynamixel2.content;
    let (framing, stuffing) = (&wire.framing, &wire.stuffing);
    tokens.insert(framing.header.clone());
    tokens.insert(stuffing.pattern.clone());
    tokens.insert([&stuffing.pattern[..], &[stuffing.insert]].concat());
    for id in [framing.id.min, framing.id.max, framing.id.broadcast] {
        tokens.insert(vec![id]);
        tokens.insert([&framing.header[..], &[id]].concat());
    }
    tokens.insert(framing.length.minimum.to_le_bytes().to_vec());
    tokens.insert(vec![wire.status.instruction]);
    tokens.extend(wire.instructions.iter().map(|row| vec![row.code]));
    for register in spec.devices.iter().flat_map(|file| &file.content.registers) {
        tokens.insert(register.address.to_le_bytes().to_vec());
        tokens.extend(values(register));
    }
    tokens
}

/// The limits of a register and what lies just outside, as its bytes.
fn values(register: &Register) -> impl Iterator<Item = Vec<u8>> {
    let size = usize::from(register.kind.size());
    let range = register.range.iter();
    let bounds = range.clone().flat_map(|range| range.min.iter().chain(&range.max));
    let numbers = bounds.filter_map(|bound| match bound {
        Bound::Value(value) => Some(*value),
        Bound::Register(_) => None,
    });
    let values = numbers.chain(range.flat_map(|range| range.one_of.iter().flatten().copied()));
    values
        .flat_map(|value| [value - 1, value, value + 1])
        .map(move |value| value.to_le_bytes()[..size].to_vec())
}

/// Header and end, codes, commands with the length of their data, and how a frame of each begins.
fn frames(spec: &Spec) -> Tokens {
    let innfos = &spec.wires.innfos.content;
    let (header, tail) = (innfos.framing.header, innfos.framing.tail);
    let mut tokens = Tokens::from([vec![header], vec![tail], vec![tail, header]]);
    for command in &innfos.commands {
        for length in command.reply.iter().chain([&command.request]) {
            let [high, low] = length.to_be_bytes();
            tokens.insert(vec![command.code, high, low]);
            tokens.insert(vec![header, 1, command.code, high, low]);
        }
    }
    tokens
}

/// The YAML's keys, and what YAML itself is made of.
fn keys() -> Tokens {
    let word = |character: char| character.is_ascii_lowercase() || character == '_';
    let mut tokens = Tokens::new();
    for source in load::embedded() {
        let keys = source.text.split(|character| !word(character) && character != ':');
        let keys = keys.filter(|key| key.len() > 2 && key.find(':') == Some(key.len() - 1));
        tokens.extend(keys.map(|key| format!("{key} ").into()));
    }
    let syntax = [
        "- ", "\n  ", "[", "]", "{", "}", "'", "\"", "#", "&a ", "*a", "!!str ", "|\n", "---\n",
        "§", "𝄞",
    ];
    tokens.extend(syntax.map(|token| token.as_bytes().to_vec()));
    tokens
}
