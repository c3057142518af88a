//! Keeps what a device holds while it is written to.

use std::path::PathBuf;

use super::Line;
use crate::adapter::{Permission, Permissions, Reported};
use crate::journal::{
    Ask, Journal, JournalError, Layout, Neighbour, Snapshot, restore, restore_device, snapshot,
    stand_still,
};
use crate::suite::device::reported;
use actucheck_spec::wire::{Packet, Wire};

/// Keeps the registers of a device and its neighbour: writes them to a journal before the first write, sets them
/// back after each check that writes, and removes the journal when all is as it was.
#[derive(Debug)]
pub struct Keeper {
    /// The journal, without what the registers hold.
    journal: Journal,
    path: PathBuf,
    state: State,
    /// Why the neighbour may not be written to, though the device may.
    left_out: Option<String>,
}

#[derive(Debug)]
enum State {
    /// Nothing was written yet.
    Untouched,
    /// Nothing may be written, for this reason.
    Barred(String),
    /// The journal is on the disk.
    Kept,
    /// The device could not be restored, for this reason.
    Lost(String),
}

/// What became of a device that was written to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Kept {
    /// It holds what it held, and the journal is gone.
    Restored,
    /// It does not, or the journal is still there; a sentence.
    Left(String),
}

impl Keeper {
    /// Keeps a device; `journal` says which, and `path` is where the file will be.
    #[must_use]
    pub const fn new(journal: Journal, path: PathBuf) -> Self {
        Self { journal, path, state: State::Untouched, left_out: None }
    }

    /// Before a check that writes, to this neighbour too: the journal is on the disk after that.
    ///
    /// # Errors
    /// Why it may not write.
    pub(super) fn before(
        &mut self,
        needs: &Permissions,
        neighbour: Option<u8>,
        line: &mut dyn Ask,
    ) -> Result<(), String> {
        if matches!(self.state, State::Untouched) {
            self.state = match self.begin(line) {
                Ok(()) => State::Kept,
                Err(reason) => State::Barred(reason),
            };
        }
        let kept = self.journal.neighbour.as_ref().map(|kept| kept.id);
        match &self.state {
            State::Barred(reason) | State::Lost(reason) => Err(reason.clone()),
            State::Untouched | State::Kept if neighbour.is_some() && neighbour != kept => {
                let nobody = || "nothing keeps what its neighbour holds".to_owned();
                Err(self.left_out.clone().unwrap_or_else(nobody))
            }
            State::Untouched | State::Kept if needs.has(Permission::Motion) => {
                stand_still(&self.journal, line).map_err(|error| error.to_string())
            }
            State::Untouched | State::Kept => Ok(()),
        }
    }

    fn begin(&mut self, line: &mut dyn Ask) -> Result<(), String> {
        let Journal { wire, id, layout, .. } = &self.journal;
        let held = snapshot(*wire, *id, layout, line).map_err(|error| error.to_string())?;
        barred(layout, &held).map_or(Ok(()), Err)?;
        self.journal.held = held;
        if let Some(mut neighbour) = self.journal.neighbour.take() {
            match hold(self.journal.wire, &mut neighbour, line) {
                Ok(()) => self.journal.neighbour = Some(neighbour),
                Err(reason) => {
                    self.left_out =
                        Some(format!("its neighbour with ID {}: {reason}", neighbour.id));
                }
            }
        }
        self.journal.write(&self.path).map_err(|error| error.to_string())
    }

    /// After a check that writes, to the neighbour too or not: what was written to holds what it held before.
    pub(super) fn after(&mut self, neighbour: Option<u8>, line: &mut dyn Ask) {
        let restore = if neighbour.is_some() { restore } else { restore_device };
        if let Err(error) = restore(&self.journal, line) {
            self.state = State::Lost(format!("the device is not restored: {error}"));
        }
    }

    /// At the end: looks once more whether the device holds what it held, and removes the journal then.
    /// Returns `None` if nothing was written.
    pub(super) fn end(&mut self, line: &mut dyn Ask) -> Option<Kept> {
        if matches!(self.state, State::Untouched | State::Barred(_)) {
            return None;
        }
        Some(match self.finish(line) {
            Ok(()) => {
                self.state = State::Untouched;
                Kept::Restored
            }
            Err(sentence) => Kept::Left(sentence),
        })
    }

    fn finish(&self, line: &mut dyn Ask) -> Result<(), String> {
        let path = self.path.display();
        let command = if self.journal.port.is_none() { " -- COMMAND" } else { "" };
        restore(&self.journal, line).map_err(|error| {
            format!("the device does not hold yet what it held: {error}; `actucheck device restore {path}{command}` does it")
        })?;
        Journal::remove(&self.path).map_err(|error: JournalError| error.to_string())
    }
}

/// Reads what a neighbour holds.
///
/// # Errors
/// Why it may not be written to.
fn hold(wire: Wire, neighbour: &mut Neighbour, line: &mut dyn Ask) -> Result<(), String> {
    let Neighbour { id, layout, held, .. } = neighbour;
    *held = snapshot(wire, *id, layout, line).map_err(|error| error.to_string())?;
    barred(layout, held).map_or(Ok(()), Err)
}

/// Why a device that holds this may not be written to.
fn barred(layout: &Layout, held: &Snapshot) -> Option<String> {
    if held.is_set(layout.torque.as_ref()) {
        return Some(
            "torque is on, and what the device carries may fall or move: support it, switch torque off, \
             and run again"
                .to_owned(),
        );
    }
    let switch = layout.goals_switch.as_ref();
    if switch.is_some_and(|(place, mask)| held.number(place).unwrap_or_default() & mask != 0) {
        return Some("Drive Mode lets a goal that is written switch torque on: clear that bit, and run again".to_owned());
    }
    if held.is_set(layout.registered.as_ref()) {
        return Some("a Reg Write waits for its Action: send the Action or restart the device, and run again".to_owned());
    }
    None
}

/// The device's answers, also after Ctrl-C: a device is restored then.
impl Ask for Line {
    fn ask(&mut self, id: u8, packet: &Packet) -> Result<Option<Reported>, String> {
        let (wire, limit) = (self.wire, self.limit);
        self.is_restoring = true;
        let answers = self.exchange(packet, limit, 1);
        self.is_restoring = false;
        let answers = answers.map_err(|error| error.to_string())?;
        let mut answers = answers.iter().flat_map(|answer| reported(wire, answer));
        Ok(answers.find(|answer| answer.id == id))
    }
}
