//! The file of a journal.

use std::fs::{self, File, OpenOptions};
use std::io::{self, ErrorKind, Write as _};
use std::path::Path;

use serde::Deserialize;
use thiserror::Error;

use super::{Journal, Layout, OLDEST, Place, Snapshot, VERSION};
use crate::input::{self, InputError};
use crate::legible::{LONGEST_TEXT, legible};

/// The most registers, and the most runs of them, of a journal: several times those of the largest table.
const MOST: usize = 4096;

/// Why a journal can't be written, or is not read.
#[derive(Debug, Error)]
pub enum JournalError {
    /// There is one already.
    #[error(
        "{0} is there already, and may be what restores a device; `actucheck device restore {0}`, or name another with --journal"
    )]
    Exists(String),
    /// It can't be written.
    #[error("cannot write the journal {0}: {1}; name another place with --journal")]
    Write(String, io::Error),
    /// It can't be removed.
    #[error("the device is restored, but cannot remove the journal {0}: {1}; remove it yourself")]
    Remove(String, io::Error),
    /// It can't be read.
    #[error(transparent)]
    Read(#[from] InputError),
    /// It is no journal.
    #[error(
        "{path} is no journal of a device, or is damaged: {error}; nothing was written to the device"
    )]
    Damaged {
        /// The file.
        path: String,
        /// What is wrong.
        error: String,
    },
    /// It is one of another version.
    #[error(
        "{path} is a journal of version {found}, this program reads {OLDEST} to {VERSION}; use the actucheck that wrote it"
    )]
    Version {
        /// The file.
        path: String,
        /// Its version.
        found: u32,
    },
}

/// The field that every version has.
#[derive(Deserialize)]
struct Versioned {
    version: u32,
}

impl Journal {
    /// Writes it to a new file. When this returns, it is on the disk.
    ///
    /// # Errors
    /// If there is such a file already, or it can't be written.
    pub fn write(&self, path: &Path) -> Result<(), JournalError> {
        let name = || path.display().to_string();
        let mut text = serde_json::to_vec_pretty(self)
            .map_err(|error| JournalError::Write(name(), error.into()))?;
        text.push(b'\n');
        let written = || -> io::Result<()> {
            let mut file = OpenOptions::new().write(true).create_new(true).open(path)?;
            file.write_all(&text)?;
            file.sync_all()?;
            // The folder has to know the file too.
            let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
            File::open(folder.unwrap_or_else(|| Path::new(".")))?.sync_all()
        };
        written().map_err(|error| match error.kind() {
            ErrorKind::AlreadyExists => JournalError::Exists(name()),
            _ => JournalError::Write(name(), error),
        })
    }

    /// Reads one.
    ///
    /// # Errors
    /// If it can't be read, or is not what it should be.
    pub fn read(path: &Path) -> Result<Self, JournalError> {
        Self::parse(&path.display().to_string(), &input::json_text(path)?)
    }

    /// Reads the text of the journal `name`.
    ///
    /// # Errors
    /// If it is not what it should be.
    pub fn parse(name: &str, text: &str) -> Result<Self, JournalError> {
        let name = || name.to_owned();
        let damaged = |error: String| JournalError::Damaged {
            path: name(),
            error: legible(&error, LONGEST_TEXT),
        };
        let parsed = |error: serde_json::Error| damaged(error.to_string());
        let Versioned { version } = serde_json::from_str(text).map_err(parsed)?;
        if !(OLDEST..=VERSION).contains(&version) {
            return Err(JournalError::Version { path: name(), found: version });
        }
        let mut journal: Self = serde_json::from_str(text).map_err(parsed)?;
        journal.complaint().map_or(Ok(()), |what| Err(damaged(what)))?;
        journal.device = legible(&journal.device, LONGEST_TEXT);
        if let Some(neighbour) = &mut journal.neighbour {
            neighbour.device = legible(&neighbour.device, LONGEST_TEXT);
        }
        Ok(journal)
    }

    /// Removes the file of a device that is restored.
    ///
    /// # Errors
    /// If it can't be removed.
    pub fn remove(path: &Path) -> Result<(), JournalError> {
        fs::remove_file(path)
            .map_err(|error| JournalError::Remove(path.display().to_string(), error))
    }

    /// What contradicts itself in it.
    fn complaint(&self) -> Option<String> {
        let neighbour = self.neighbour.as_ref();
        if neighbour.is_some_and(|neighbour| neighbour.id == self.id) {
            return Some("the neighbour is the device itself".to_owned());
        }
        let of_neighbour = || {
            let neighbour = neighbour?;
            neighbour.layout.complaint(&neighbour.held)
        };
        self.layout.complaint(&self.held).or_else(of_neighbour)
    }
}

impl Layout {
    /// What contradicts itself in it, or in what it says was held.
    fn complaint(&self, held: &Snapshot) -> Option<String> {
        let layout = self;
        let places = || {
            let pairs = layout.indirect.iter().flat_map(|(data, address)| [data, address]);
            let switch = layout.goals_switch.iter().map(|(place, _)| place);
            let roles = [&layout.torque, &layout.level, &layout.registered, &layout.alarms];
            let position = layout.position.iter().flat_map(|(goal, present)| [goal, present]);
            layout
                .restored
                .iter()
                .chain(pairs)
                .chain(position)
                .chain(switch)
                .chain(roles.into_iter().flatten())
        };
        let many = [layout.read.len(), layout.restored.len(), layout.indirect.len()];
        if many.into_iter().any(|count| count > MOST) || held.0.len() > MOST {
            return Some(format!("it has more than {MOST} registers"));
        }
        let is_odd = |place: &&Place| !matches!(place.size, 1 | 2 | 4);
        if let Some(place) = places().find(is_odd) {
            return Some(format!(
                "{} has {} bytes",
                legible(&place.name, LONGEST_TEXT),
                place.size
            ));
        }
        let ends = layout.read.iter().map(|(address, length)| address.checked_add(*length));
        let runs = held.0.iter().map(|run| (run.address, run.data.0.len()));
        let read = layout.read.iter().map(|(address, length)| (*address, usize::from(*length)));
        if ends.into_iter().any(|end| end.is_none()) || !runs.eq(read) {
            return Some("what was read is not what it says".to_owned());
        }
        let lost = places().find(|place| held.get(place).is_none())?;
        Some(format!("it does not have what {} held", legible(&lost.name, LONGEST_TEXT)))
    }
}
