//! The words with which a user puts devices on a bus.

use std::path::Path;
use std::str::FromStr;

use serde::Deserialize;
use thiserror::Error;

use super::{Own, WIRES};
use crate::compose::{ComposeError, Word};
use crate::device::{DeviceError, Tables, unknown};
use crate::input::{self, InputError};
use crate::legible::{LONGEST_NAME, legible};

/// A device on a bus, in words: `ja40@2:present-position=2000,torque-enable=1`, `dd-6010@6`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// A device of the spec, a YAML file like the spec's, a `.model` file, or a model of actuator.
    pub device: String,
    /// Its ID, or its address.
    pub id: u8,
    /// What registers hold at the beginning, or what commands read.
    pub registers: Vec<Word>,
}

/// A device in words, or the devices of a YAML file that has such words: `bench.yaml`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Places(pub Vec<Place>);

/// A bus as a file has it.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct BusFile {
    devices: Vec<String>,
}

/// Why words put no devices on a bus.
#[derive(Debug, Error)]
pub enum PlaceError {
    /// The words have another form.
    #[error("`{0}` is no device with its ID; write it as ja40@1 or ja40@1:goal-position=2000")]
    Form(String),
    /// A file can't be read.
    #[error(transparent)]
    Input(#[from] InputError),
    /// A file has something else than devices.
    #[error("{path}: {error}")]
    File {
        /// The file.
        path: String,
        /// What is wrong.
        error: String,
    },
    /// No device may have the ID.
    #[error("`{text}` has no ID from {min} to {max} after the @")]
    Id {
        /// The words.
        text: String,
        /// The smallest ID.
        min: u8,
        /// The largest ID.
        max: u8,
    },
    /// Two devices can't be on one bus.
    #[error("`{0}` and `{1}` are not of one wire; give each a bus of its own")]
    Wires(String, String),
    /// The wire has no rate.
    #[error("a board is on a network, which has no such rate; take --realtime away")]
    Rate,
    /// The devices have no such reading.
    #[error("`{0}` is no reading of these devices; take it out of --readings")]
    Reading(String),
    /// A register can't hold this at the beginning.
    #[error(
        "no device begins with `{0}`: it measures that itself, or its document does not allow it"
    )]
    Preset(String),
    /// There is no device.
    #[error("a bus needs a device; write it as ja40@1")]
    None,
    /// The program's own spec has defects.
    #[error("the program's own spec has {0} defects; build it again from clean sources")]
    Spec(usize),
    /// There is no such device.
    #[error(transparent)]
    Device(#[from] DeviceError),
    /// There is no such register, or it can't hold the value.
    #[error(transparent)]
    Register(#[from] ComposeError),
}

impl FromStr for Place {
    type Err = PlaceError;

    fn from_str(text: &str) -> Result<Self, PlaceError> {
        let shown = || legible(text, LONGEST_NAME);
        let (device, rest) = text.rsplit_once('@').ok_or_else(|| PlaceError::Form(shown()))?;
        let (id, registers) = match rest.split_once(':') {
            Some((id, registers)) => (id, registers.split(',').collect()),
            None => (rest, Vec::new()),
        };
        let ids = &own(device)?.ids;
        let (min, max) = (*ids.start(), *ids.end());
        let id = id.parse().ok().filter(|id| ids.contains(id));
        let id = id.ok_or_else(|| PlaceError::Id { text: shown(), min, max })?;
        let word = |text: &str| {
            let Ok(word) = text.parse::<Word>();
            let is_whole = word.value.is_some() && word.id.is_none();
            if is_whole { Ok(word) } else { Err(PlaceError::Form(shown())) }
        };
        let registers = registers.into_iter().map(word).collect::<Result<_, _>>()?;
        Ok(Self { device: device.to_owned(), id, registers })
    }
}

impl FromStr for Places {
    type Err = PlaceError;

    fn from_str(text: &str) -> Result<Self, PlaceError> {
        let ending = Path::new(text).extension();
        if ending.is_none_or(|ending| ending != "yaml" && ending != "yml") {
            return Ok(Self(vec![text.parse()?]));
        }
        let failed = |error: String| PlaceError::File { path: legible(text, LONGEST_NAME), error };
        let file: BusFile = input::yaml(&input::yaml_text(Path::new(text))?).map_err(failed)?;
        let place =
            |words: &String| words.parse().map_err(|error: PlaceError| failed(error.to_string()));
        file.devices.iter().map(place).collect::<Result<_, _>>().map(Self)
    }
}

/// The wire on which there are devices of this name.
fn own(device: &str) -> Result<&'static Own, PlaceError> {
    let names = || WIRES.iter().flat_map(|own| (own.names)());
    let found = WIRES.iter().find(|own| (own.knows)(device));
    found.ok_or_else(|| PlaceError::Device(unknown(device, names)))
}

/// The one wire of devices.
pub(super) fn wire(places: &[Place]) -> Result<&'static Own, PlaceError> {
    let first = places.first().ok_or(PlaceError::None)?;
    let wire = own(&first.device)?;
    for other in places {
        if own(&other.device)?.wire != wire.wire {
            return Err(PlaceError::Wires(first.device.clone(), other.device.clone()));
        }
    }
    Ok(wire)
}

/// The control tables of devices, as far as their wire has any. If two have the same ID, the first
/// counts.
///
/// # Errors
/// If a device is not known.
pub fn tables(places: &[Place]) -> Result<Tables, DeviceError> {
    let has_table = |place: &&Place| own(&place.device).is_ok_and(|own| own.has_tables);
    let places = places.iter().filter(has_table);
    Tables::of_each(places.map(|place| (place.id, place.device.as_str())))
}
