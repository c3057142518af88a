//! The words with which a user puts devices on a bus.

use std::str::FromStr;

use thiserror::Error;

use crate::compose::{ComposeError, Word};
use crate::device::DeviceError;
use crate::legible::{LONGEST_NAME, legible};

/// A device on a bus, in words: `ja40@2:present-position=2000,torque-enable=1`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// A device of the spec, a YAML file like the spec's, or a `.model` file.
    pub device: String,
    /// Its ID.
    pub id: u8,
    /// What registers hold at the beginning.
    pub registers: Vec<Word>,
}

/// Why words put no devices on a bus.
#[derive(Debug, Error)]
pub enum PlaceError {
    /// The words have another form.
    #[error("`{0}` is no device with its ID; write it as ja40@1 or ja40@1:goal-position=2000")]
    Form(String),
    /// No device may have the ID.
    #[error("`{0}` has no ID from 0 to 252 after the @")]
    Id(String),
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
        let id = id.parse().ok().filter(|id| *id <= LARGEST_ID);
        let id = id.ok_or_else(|| PlaceError::Id(shown()))?;
        let word = |text: &str| {
            let Ok(word) = text.parse::<Word>();
            let is_whole = word.value.is_some() && word.id.is_none();
            if is_whole { Ok(word) } else { Err(PlaceError::Form(shown())) }
        };
        let registers = registers.into_iter().map(word).collect::<Result<_, _>>()?;
        Ok(Self { device: device.to_owned(), id, registers })
    }
}

/// The largest ID of a device.
const LARGEST_ID: u8 = 252;
