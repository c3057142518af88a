//! The way back to what a device held.

use actucheck_spec::model::HexBytes;
use actucheck_spec::wire::{Packet, Wire};
use thiserror::Error;

use super::{Journal, Layout, Neighbour, Place, Run, Snapshot};
use crate::adapter::{Permission, Permissions, Reported};
use crate::suite::device::{Instructions, hello, identity, instructions};

/// How often the device is called until it answers: it may take a few packets for the rest of one that was
/// cut, or restart.
const CALLS: usize = 10;
/// How often one packet is sent until it is answered.
const TRIES: usize = 3;
/// How often all is written that still differs: a limit may have to be there before what it limits.
const PASSES: usize = 4;

/// Who sends packets to a device, and hears it.
pub trait Ask {
    /// Sends a packet, and returns what the device with this ID answers, if anything.
    ///
    /// # Errors
    /// If the port is gone, as a sentence.
    fn ask(&mut self, id: u8, packet: &Packet) -> Result<Option<Reported>, String>;
}

/// Why a device is not as it was.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum RestoreError {
    /// The port is gone.
    #[error("{0}")]
    Port(String),
    /// Nothing answers.
    #[error("the device with ID {0} does not answer; is it on, and alone with this ID?")]
    Silent(u8),
    /// Registers can't be read.
    #[error(
        "{1} bytes from address {0} on can't be read, so it is not known what the device holds; check with --allow read only, and mend that first"
    )]
    Unreadable(u16, u16),
    /// It is another device.
    #[error(
        "another device has the ID: its model number is {found}, not {wanted}; connect the right one"
    )]
    OtherModel {
        /// What it tells.
        found: u16,
        /// What the journal tells.
        wanted: u16,
    },
    /// Torque is on.
    #[error(
        "torque is on, and it was not switched on by this run; support what the device carries, switch torque off, and restore again"
    )]
    Torque,
    /// Registers differ still.
    #[error("it does not take back what it held: {}; restart the device, and restore again", .0.join(", "))]
    Left(Vec<String>),
    /// Its wire has no registers.
    #[error("devices on {0} have no registers that are kept; there is nothing to restore")]
    Wire(Wire),
    /// The neighbour is not as it was.
    #[error("its neighbour with ID {0}: {1}")]
    Neighbour(u8, Box<Self>),
}

/// Gives a device and its neighbour back what they held, and looks whether they hold it. Only what differs is
/// written. Returns how many registers that were.
///
/// # Errors
/// If one of them can't be restored now. The neighbour is restored even if the device can't be.
pub fn restore(journal: &Journal, ask: &mut dyn Ask) -> Result<usize, RestoreError> {
    let device = restore_device(journal, ask);
    let Some(neighbour) = &journal.neighbour else { return device };
    let other = Way::to_neighbour(journal.wire, neighbour, ask).and_then(Way::go);
    let told = |error| RestoreError::Neighbour(neighbour.id, Box::new(error));
    Ok(device? + other.map_err(told)?)
}

/// The same for the device alone, after what did not write to its neighbour.
///
/// # Errors
/// If it can't be restored now.
pub fn restore_device(journal: &Journal, ask: &mut dyn Ask) -> Result<usize, RestoreError> {
    Way::to_device(journal, ask)?.go()
}

/// Whether a device answers to an ID, after noise and restarts too. Returns its model number.
///
/// # Errors
/// If it does not.
pub fn reached(wire: Wire, id: u8, ask: &mut dyn Ask) -> Result<Option<u16>, RestoreError> {
    let packet = hello(wire, id).ok_or(RestoreError::Wire(wire))?;
    for _ in 0..CALLS {
        if let Some(answer) = ask.ask(id, &packet).map_err(RestoreError::Port)? {
            return Ok(identity(wire, &answer).model_number);
        }
    }
    Err(RestoreError::Silent(id))
}

/// What the registers of a layout hold.
///
/// # Errors
/// If they can't be read.
pub fn snapshot(
    wire: Wire,
    id: u8,
    layout: &Layout,
    ask: &mut dyn Ask,
) -> Result<Snapshot, RestoreError> {
    let instructions = instructions(wire).ok_or(RestoreError::Wire(wire))?;
    let mut snapshot = Snapshot::default();
    for (address, length) in &layout.read {
        let packet = (instructions.read)(id, *address, *length);
        let answer = tried(id, &packet, ask)?;
        let data = answer.filter(|answer| answer.error.unwrap_or_default() == 0);
        let data = data.and_then(|answer| answer.data);
        let data = data.map(|data| HexBytes::from((instructions.held)(&data.0).to_vec()));
        let data = data.filter(|data| data.0.len() == usize::from(*length));
        let data = data.ok_or(RestoreError::Unreadable(*address, *length))?;
        snapshot.0.push(Run { address: *address, data });
    }
    Ok(snapshot)
}

/// Lets a shaft without torque stay where it is when it gets torque: its goal is where it is.
///
/// # Errors
/// If the port is gone, or the place can't be read.
pub fn stand_still(journal: &Journal, ask: &mut dyn Ask) -> Result<(), RestoreError> {
    let Journal { wire, id, layout, .. } = journal;
    let instructions = instructions(*wire).ok_or(RestoreError::Wire(*wire))?;
    let Some((goal, present)) = &layout.position else { return Ok(()) };
    let packet = (instructions.read)(*id, present.address, present.size);
    let answer = tried(*id, &packet, ask)?.and_then(|answer| answer.data);
    let data = answer.ok_or(RestoreError::Unreadable(present.address, present.size))?;
    let packet = (instructions.write)(*id, goal.address, &data.0);
    tried(*id, &packet, ask).map(drop)
}

/// Sends a packet until it is answered.
fn tried(id: u8, packet: &Packet, ask: &mut dyn Ask) -> Result<Option<Reported>, RestoreError> {
    for _ in 0..TRIES {
        let answer = ask.ask(id, packet).map_err(RestoreError::Port)?;
        if answer.is_some() {
            return Ok(answer);
        }
    }
    Ok(None)
}

/// The way back of one device.
struct Way<'a> {
    wire: Wire,
    id: u8,
    model_number: Option<u16>,
    /// What may have been done to it.
    allowed: Permissions,
    layout: &'a Layout,
    held: &'a Snapshot,
    instructions: &'static Instructions,
    ask: &'a mut dyn Ask,
    /// The addresses of the registers that were written.
    written: Vec<u16>,
}

impl<'a> Way<'a> {
    fn to_device(journal: &'a Journal, ask: &'a mut dyn Ask) -> Result<Self, RestoreError> {
        let Journal { wire, id, model_number, layout, held, .. } = journal;
        Ok(Self {
            wire: *wire,
            id: *id,
            model_number: *model_number,
            allowed: journal.allowed.clone(),
            layout,
            held,
            instructions: instructions(*wire).ok_or(RestoreError::Wire(*wire))?,
            ask,
            written: Vec::new(),
        })
    }

    /// Nothing but its RAM area was ever written.
    fn to_neighbour(
        wire: Wire,
        neighbour: &'a Neighbour,
        ask: &'a mut dyn Ask,
    ) -> Result<Self, RestoreError> {
        let Neighbour { id, model_number, layout, held, .. } = neighbour;
        Ok(Self {
            wire,
            id: *id,
            model_number: *model_number,
            allowed: [Permission::WriteRam].into(),
            layout,
            held,
            instructions: instructions(wire).ok_or(RestoreError::Wire(wire))?,
            ask,
            written: Vec::new(),
        })
    }

    fn go(mut self) -> Result<usize, RestoreError> {
        let Self { layout, held, .. } = self;
        let mut now = self.arrive()?;
        if now.is_set(layout.torque.as_ref()) {
            let is_ours =
                self.allowed.has(Permission::Motion) && !held.is_set(layout.torque.as_ref());
            let torque = layout.torque.as_ref().filter(|_| is_ours).ok_or(RestoreError::Torque)?;
            self.write(torque, &vec![0; torque.size.into()])?;
            now = self.look()?;
            if now.is_set(layout.torque.as_ref()) {
                return Err(RestoreError::Torque);
            }
        }
        if now.is_set(layout.registered.as_ref())
            && !held.is_set(layout.registered.as_ref())
            && let Some(action) = self.instructions.action
        {
            tried(self.id, &action(self.id), self.ask)?;
            now = self.look()?;
        }
        now = self.set_back(now)?;
        // Only when the limits are back does an alarm stay away.
        let reboot = self.instructions.reboot.filter(|_| self.allowed.has(Permission::Reboot));
        if let Some(reboot) = reboot.filter(|_| self.has_new_alarm(&now)) {
            let packet = reboot(self.id);
            self.ask.ask(self.id, &packet).map_err(RestoreError::Port)?;
            now = self.arrive()?;
            self.set_back(now)?;
        }
        self.written.sort_unstable();
        self.written.dedup();
        Ok(self.written.len())
    }

    /// Writes what differs, until nothing does.
    fn set_back(&mut self, mut now: Snapshot) -> Result<Snapshot, RestoreError> {
        let Self { layout, held, .. } = *self;
        for _ in 0..PASSES {
            let differing = layout.differing(held, &now);
            if differing.is_empty() {
                return Ok(now);
            }
            for place in differing {
                self.write(place, held.get(place).unwrap_or_default())?;
                self.written.push(place.address);
            }
            now = self.look()?;
        }
        let left = layout.differing(held, &now);
        if left.is_empty() {
            return Ok(now);
        }
        Err(RestoreError::Left(left.into_iter().map(|place| place.name.clone()).collect()))
    }

    /// Reads the registers; if they can't be read, calls the device first, and lets it answer.
    fn arrive(&mut self) -> Result<Snapshot, RestoreError> {
        let Self { wire, id, model_number, layout, held, .. } = *self;
        let found = reached(wire, id, self.ask)?;
        if let (Some(found), Some(wanted)) = (found, model_number)
            && found != wanted
        {
            return Err(RestoreError::OtherModel { found, wanted });
        }
        let level = layout.level.as_ref().and_then(|level| Some((level, held.get(level)?)));
        match (self.look(), level) {
            (Err(RestoreError::Unreadable(..)), Some((level, data))) => {
                self.write(level, data)?;
                self.look()
            }
            (looked, _) => looked,
        }
    }

    fn look(&mut self) -> Result<Snapshot, RestoreError> {
        snapshot(self.wire, self.id, self.layout, self.ask)
    }

    /// Writes a register. Whether it holds that then is looked at later: not every device answers.
    fn write(&mut self, place: &Place, data: &[u8]) -> Result<(), RestoreError> {
        let packet = (self.instructions.write)(self.id, place.address, data);
        self.ask.ask(self.id, &packet).map_err(RestoreError::Port)?;
        Ok(())
    }

    fn has_new_alarm(&self, now: &Snapshot) -> bool {
        let Self { layout, held, .. } = *self;
        let number = |snapshot: &Snapshot| {
            layout.alarms.as_ref().and_then(|alarms| snapshot.number(alarms)).unwrap_or_default()
        };
        number(now) & !number(held) != 0
    }
}
