//! The loader on a file of a small spec folder.

use std::fmt::Debug;

use actucheck_spec::load::Source;
use actucheck_spec::model::{Device, DocumentsFile, ErrataFile, RequirementsFile, VectorsFile};
use actucheck_spec::wire::dynamixel2::Dynamixel2;
use actucheck_spec::wire::innfos::Innfos;
use actucheck_spec::{Diagnostic, Spec, generate};
use serde::Serialize;
use serde::de::DeserializeOwned;

/// The small spec folder of the loader's own tests.
macro_rules! base {
    ($($path:literal),*) => {
        [$(($path, include_str!(concat!("../../../spec/tests/base/", $path)))),*]
    };
}
pub(crate) const BASE: [(&str, &str); 7] = base![
    "documents.yaml",
    "errata.yaml",
    "wires/dynamixel2.yaml",
    "wires/innfos.yaml",
    "devices/motor.yaml",
    "vectors/ping.yaml",
    "requirements/book.yaml"
];

/// The input is a file, whose path its first line names as `# as devices/motor.yaml`.
///
/// # Panics
/// If the loader panics, accepts what can't be generated, or a file that it accepts says something
/// else when it is written and read again.
pub fn check(input: &[u8]) {
    let Ok(text) = std::str::from_utf8(input) else { return };
    let first = text.lines().next().and_then(|line| line.strip_prefix("# as "));
    let Some((path, _)) = BASE.iter().find(|(path, _)| Some(*path) == first) else { return };
    let sources =
        BASE.map(|(other, base)| Source::new(other, if other == *path { text } else { base }));
    match Spec::read(&sources) {
        Ok(spec) => accepted(&spec),
        Err(defects) => defects.iter().for_each(|defect| well_said(defect, &sources)),
    }
}

/// A defect can be shown, at the place that it names if that is in the file.
fn well_said(defect: &Diagnostic, sources: &[Source]) {
    let Diagnostic { path, line, column, message, .. } = defect;
    assert!(!message.is_empty(), "{defect}");
    let excerpt = defect.excerpt();
    let text = sources.iter().find(|source| source.path == *path).map_or("", |source| &source.text);
    if text.lines().nth(line - 1).is_some_and(|line| *column <= line.chars().count()) {
        assert!(excerpt.contains(&format!("{path}:{line}:{column}\n")), "{defect}\n{excerpt}");
    }
}

fn accepted(spec: &Spec) {
    generate::codec(spec).unwrap_or_else(|error| panic!("{error}"));
    stays::<DocumentsFile>(&spec.documents.content);
    stays::<ErrataFile>(&spec.errata.content);
    stays::<Dynamixel2>(&spec.wires.dynamixel2.content);
    stays::<Innfos>(&spec.wires.innfos.content);
    spec.devices.iter().for_each(|file| stays::<Device>(&file.content));
    spec.vectors.iter().for_each(|file| stays::<VectorsFile>(&file.content));
    spec.requirements.iter().for_each(|file| stays::<RequirementsFile>(&file.content));
}

/// Written and read again it says the same.
fn stays<T: Serialize + DeserializeOwned + Debug>(content: &T) {
    let text = serde_yaml::to_string(content).unwrap();
    let again: T = serde_yaml::from_str(&text).unwrap_or_else(|error| panic!("{error}\n{text}"));
    assert_eq!(format!("{again:?}"), format!("{content:?}"));
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Else every input is refused, and nothing is held.
    #[test]
    fn the_small_folder_is_whole() {
        let base = BASE.map(|(path, text)| Source::new(path, text));
        assert!(Spec::read(&base).is_ok());
    }
}
