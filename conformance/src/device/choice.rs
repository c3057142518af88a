//! The words with which a user chooses control tables.

use std::collections::BTreeMap;
use std::fmt::Display;
use std::path::Path;
use std::rc::Rc;
use std::str::FromStr;

use actucheck_codec::register::Device;
use actucheck_spec::{Spec, model};
use thiserror::Error;

use super::table::{self, Absent};
use super::{Bus, Chosen, KNOWN, NONE, Tables, model_file};
use crate::input::{self, InputError};
use crate::legible::{LONGEST_TEXT, first_hidden, legible};
use crate::names::nearest;

/// Defects of a file that are told.
const TOLD: usize = 10;

/// Why words choose no control tables.
#[derive(Debug, Error)]
pub enum DeviceError {
    /// No device has this name.
    #[error("no device is called `{name}`; {hint}")]
    Unknown {
        /// The name.
        name: String,
        /// What may be meant.
        hint: String,
    },
    /// What comes before `=` is the ID of no device.
    #[error("`{0}` begins with no ID; write it as 1=ja40")]
    NoId(String),
    /// Two tables are for the same device.
    #[error("`{0}` is the second table for the same devices; give each ID one")]
    Twice(String),
    /// The file can't be read.
    #[error(transparent)]
    Input(#[from] InputError),
    /// The file is no control table.
    #[error("{0}")]
    Defects(String),
}

/// `ja40`, `1=ja40,2=my-servo.yaml,3=xl430_w250.model`, or `none`. A file is read once, and kept to the program's end.
impl FromStr for Tables {
    type Err = DeviceError;

    fn from_str(text: &str) -> Result<Self, DeviceError> {
        let mut bus = Bus::default();
        let mut files = BTreeMap::new();
        for word in text.split(',').map(str::trim) {
            let (id, name) = parts(word)?;
            let chosen = chosen(name, &mut files)?;
            let earlier = match id {
                Some(id) => bus.chosen.insert(id, chosen),
                None => bus.others.replace(chosen),
            };
            if earlier.is_some() {
                return Err(DeviceError::Twice(legible(word, LONGEST_TEXT)));
            }
        }
        Ok(Self(Some(Rc::new(bus))))
    }
}

impl Tables {
    /// The tables of devices that are named one by one. Of several with the same ID the first counts.
    ///
    /// # Errors
    /// If a name is no device.
    pub(crate) fn of_each<'a>(
        devices: impl IntoIterator<Item = (u8, &'a str)>,
    ) -> Result<Self, DeviceError> {
        let mut bus = Bus::default();
        let mut files = BTreeMap::new();
        for (id, name) in devices {
            let chosen = chosen(name, &mut files)?;
            bus.chosen.entry(id).or_insert(chosen);
        }
        Ok(if bus.chosen.is_empty() { Self::default() } else { Self(Some(Rc::new(bus))) })
    }
}

/// The table of this name. Each of the `files` is read once.
fn chosen<'a>(name: &'a str, files: &mut BTreeMap<&'a str, Chosen>) -> Result<Chosen, DeviceError> {
    match (known(name), files.get(name)) {
        (Some(chosen), _) | (None, Some(&chosen)) => Ok(chosen),
        (None, None) if is_file(name) => {
            let chosen = read(name)?;
            files.insert(name, chosen);
            Ok(chosen)
        }
        (None, None) => Err(unknown(name, ids)),
    }
}

/// Whether a device has this name, or it is that of a file.
pub(crate) fn knows(name: &str) -> bool {
    KNOWN.iter().any(|device| device.id == name) || is_file(name)
}

fn ids() -> impl Iterator<Item = String> {
    KNOWN.into_iter().chain([&NONE]).map(|device| device.id.to_owned())
}

/// The ID, if the word begins with one, and the table's name.
fn parts(word: &str) -> Result<(Option<u8>, &str), DeviceError> {
    match word.split_once('=') {
        Some((id, name)) if id.bytes().all(|digit| digit.is_ascii_digit()) => {
            let no_id = |_| DeviceError::NoId(legible(word, LONGEST_TEXT));
            id.parse().map(|id| (Some(id), name)).map_err(no_id)
        }
        _ => Ok((None, word)),
    }
}

fn known(name: &str) -> Option<Chosen> {
    let found = names().find(|device| device.id == name);
    found.map(|table| Chosen { table, file: None })
}

fn names() -> impl Iterator<Item = &'static Device> {
    KNOWN.into_iter().chain([&NONE])
}

fn is_file(name: &str) -> bool {
    let ending = Path::new(name).extension();
    ending.is_some_and(|ending| ending == "yaml" || ending == "yml") || is_model_file(name)
}

fn is_model_file(name: &str) -> bool {
    Path::new(name).extension().is_some_and(|ending| ending == "model")
}

/// No device has this name, but some have others.
pub(crate) fn unknown<I: Iterator<Item = String>>(
    name: &str,
    others: impl Fn() -> I,
) -> DeviceError {
    let all = || {
        let ids = others().collect::<Vec<_>>().join(", ");
        format!("there are {ids}, and files that end in .yaml or .model")
    };
    let hint = nearest(name, others()).map_or_else(all, |meant| format!("did you mean `{meant}`?"));
    DeviceError::Unknown { name: legible(name, LONGEST_TEXT), hint }
}

/// Reads a user's file.
fn read(path: &str) -> Result<Chosen, DeviceError> {
    let (device, table) = if is_model_file(path) { model_file(path)? } else { yaml_file(path)? };
    let texts = serde_json::to_value(&device)
        .map_err(|error| DeviceError::Defects(format!("{path}: {error}")))?;
    if let Some(text) = first_hidden(&texts, LONGEST_TEXT) {
        let message = format!("{path}: `{text}` is too long, or has characters that do not show");
        return Err(DeviceError::Defects(message));
    }
    let absent = |Absent(name)| DeviceError::Defects(format!("{path} has no {name}"));
    let table = table.map_err(absent)?;
    Ok(Chosen { table: Box::leak(Box::new(table)), file: Some(Box::leak(Box::new(device))) })
}

type File = (model::Device, Result<Device, Absent>);

/// With the rules that the spec's own files keep.
fn yaml_file(path: &str) -> Result<File, DeviceError> {
    let text = input::yaml_text(Path::new(path))?;
    let spec = Spec::with_own_device(path, &text).map_err(|defects| told(&defects))?;
    let none = || DeviceError::Defects(format!("{path} has no device"));
    let device = spec.devices.first().ok_or_else(none)?.content.clone();
    let table = table::of(&|range| spec.settles(range), &device);
    Ok((device, table))
}

fn model_file(path: &str) -> Result<File, DeviceError> {
    let text = input::model_text(Path::new(path))?;
    let id = Path::new(path).file_stem().map_or(path.into(), |stem| stem.to_string_lossy());
    let line = |(line, message): model_file::Defect| format!("{path}:{line}: {message}");
    let device = model_file::read(&id, &text)
        .map_err(|defects| told(&defects.into_iter().map(line).collect::<Vec<_>>()))?;
    // It has no ranges.
    let table = table::of(&|_| true, &device);
    Ok((device, table))
}

/// The first defects, a line each with its place.
fn told<D: Display>(defects: &[D]) -> DeviceError {
    let line = |defect: &D| legible(&defect.to_string(), LONGEST_TEXT);
    let mut lines: Vec<_> = defects.iter().take(TOLD).map(line).collect();
    if defects.len() > TOLD {
        lines.push(format!("and {} more", defects.len() - TOLD));
    }
    DeviceError::Defects(lines.join("\n"))
}
