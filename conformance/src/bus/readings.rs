//! What the documents leave unspecified about devices, and the readings that a user chooses.

use std::str::FromStr;

use thiserror::Error;

use super::{PlaceError, WIRES};
use crate::legible::{LONGEST_NAME, legible};

/// A name, its ways with the default first, and its erratum.
pub type Reading = (&'static str, &'static [&'static str], &'static str);

/// Defines the readings of a wire: field, name, erratum, and the ways with the default first.
macro_rules! readings {
    ($readings:ident, $($(#[$doc:meta])* $field:ident: $name:literal, $erratum:literal, $kind:ident {
        $($(#[$way_doc:meta])* $way:ident: $word:literal,)*
    },)*) => {
        $($(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub(super) enum $kind {
            $($(#[$way_doc])* $way,)*
        })*

        /// What is done where the documents say nothing, or two things. Each has a row in the errata.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub(in super::super) struct $readings {
            $($(#[$doc])* pub(super) $field: $kind,)*
        }

        impl $readings {
            pub(in super::super) const ALL: &[$crate::bus::Reading] =
                &[$(($name, &[$($word),*], $erratum)),*];

            /// Takes a way; `false` if there is none.
            pub(in super::super) fn choose(&mut self, name: &str, way: &str) -> bool {
                match (name, way) {
                    $($(($name, $word) => self.$field = $kind::$way,)*)*
                    _ => return false,
                }
                true
            }
        }
    };
}

pub(super) use readings;

/// Readings in words: `after-missing=silent,restore=eeprom`. The others keep their defaults.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Readings(Vec<(String, String)>);

impl Readings {
    /// Every reading of every wire.
    pub fn all() -> impl Iterator<Item = &'static Reading> {
        WIRES.iter().flat_map(|own| own.readings)
    }

    /// Hands each to the devices of a bus, which take those that they have.
    ///
    /// # Errors
    /// If they do not have one.
    pub(super) fn chosen(
        &self,
        mut choose: impl FnMut(&str, &str) -> bool,
    ) -> Result<(), PlaceError> {
        match self.0.iter().find(|(name, way)| !choose(name, way)) {
            None => Ok(()),
            Some((name, _)) => Err(PlaceError::Reading(name.clone())),
        }
    }
}

/// Why words choose no reading.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("`{text}` is no reading; there are {known}")]
pub struct ReadingError {
    text: String,
    known: String,
}

impl FromStr for Readings {
    type Err = ReadingError;

    fn from_str(text: &str) -> Result<Self, ReadingError> {
        let read = |word: &str| {
            let known = |name: &str, way: &str| {
                Self::all().any(|(known, ways, _)| *known == name && ways.contains(&way))
            };
            let chosen = word.split_once('=').filter(|(name, way)| known(name, way));
            chosen.map(|(name, way)| (name.to_owned(), way.to_owned())).ok_or_else(|| {
                let line = |(name, ways, _): &Reading| format!("{name}={}", ways.join("|"));
                let known = Self::all().map(line).collect::<Vec<_>>().join(", ");
                ReadingError { text: legible(word, LONGEST_NAME), known }
            })
        };
        text.split(',').map(str::trim).map(read).collect::<Result<_, _>>().map(Self)
    }
}
