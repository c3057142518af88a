//! What a run may do to a device, and where its journal is.

use std::path::PathBuf;
use std::time::SystemTime;

use actucheck::adapter::{Permission, Permissions, Wire};
use actucheck::journal::{self, Journal, Layout, Snapshot, VERSION};
use actucheck::names::as_word;
use actucheck::port::Place;
use actucheck::subject::device::{Device, Keeper, Kept};
use actucheck::suite::device::{Neighbour, kept};
use actucheck_spec::{Spec, model};
use chrono::{DateTime, SecondsFormat, Utc};
use clap::Args;

use super::super::shared::{Failure, one_of};
use super::open::name_of;

/// What may be done to the device.
#[derive(Debug, Args)]
pub(crate) struct Writing {
    /// What a run may do beside reading; several with commas, or given more than once. None of them contains
    /// another
    #[arg(long, value_name = "WHAT", value_delimiter = ',', value_parser = permission())]
    allow: Vec<Option<Permission>>,
    /// The file that keeps what the device holds while it is written to [default: one in this folder, with
    /// the device's name, its ID and the time]
    #[arg(long, value_name = "FILE")]
    journal: Option<PathBuf>,
}

/// Where a device is.
pub(crate) struct At<'a> {
    pub(crate) wire: Wire,
    pub(crate) place: &'a Place,
    pub(crate) baud: u32,
    pub(crate) id: u8,
    /// The model number that it told.
    pub(crate) model: Option<u16>,
    /// Another device that may be written to.
    pub(crate) neighbour: Option<Neighbour<'a>>,
}

/// What is kept of a device while it is written to.
pub(super) fn layout(spec: &Spec, wire: Wire, device: Option<&model::Device>) -> Option<Layout> {
    device.map(Layout::of).or_else(|| kept(wire, spec).map(Layout::of_values))
}

/// What is kept of its neighbour, if that is written to.
fn beside(wire: Wire, neighbour: Neighbour<'_>) -> Option<journal::Neighbour> {
    let Neighbour { id, device } = neighbour;
    let device = device?;
    Some(journal::Neighbour {
        device: name_of(wire, Some(device)).to_owned(),
        model_number: device.model_number,
        id,
        layout: Layout::of(device),
        held: Snapshot::default(),
    })
}

/// Sets a device back that was written to, and tells that.
///
/// # Errors
/// If it does not hold what it held.
pub(crate) fn end(subject: &Device) -> Result<(), Failure> {
    match subject.end() {
        Some(Kept::Left(sentence)) => Err(Failure::incomplete(sentence)),
        Some(Kept::Restored) => {
            let said = "the device holds what it held before; that was read back";
            anstream::eprintln!("actucheck: {said}");
            Ok(())
        }
        None => Ok(()),
    }
}

fn permission() -> impl clap::builder::TypedValueParser<Value = Option<Permission>> {
    let meaning = |permission| match permission {
        Permission::WriteRam => {
            "write registers of the RAM area, or an actuator's values, while torque is off, and set them back"
        }
        Permission::Eeprom => "write registers of the EEPROM area, which wear, and set them back",
        Permission::Reboot => {
            "restart the device, which forgets how many turns it made, and clears its alarms"
        }
        Permission::Reset => {
            "set the device back to factory settings, and then to what it held; ID and rate only if they are those of the factory already"
        }
        Permission::Backup => {
            "store the control table in the device's backup area; what was stored there before is lost, as it can't be read"
        }
        Permission::Motion => {
            "switch torque on and off, and send the shaft 3 degrees on and back: it must be free to turn, and nothing may be in its way; a run that is cut off leaves it within these degrees, without torque"
        }
    };
    let read = (None, "read", "read, and send what must be refused; it is always allowed");
    let others = Permission::ALL.map(|one| (Some(one), one.word(), meaning(one)));
    one_of([read].into_iter().chain(others))
}

impl Writing {
    pub(crate) fn allowed(&self) -> Permissions {
        self.allow.iter().flatten().copied().collect()
    }

    /// Lets what the device holds be kept, if it may be written to.
    pub(crate) fn keep(
        &self,
        subject: Device,
        spec: &Spec,
        device: Option<&model::Device>,
        at: &At<'_>,
    ) -> Device {
        let layout = layout(spec, at.wire, device).filter(|_| !self.allowed().only_read());
        let Some(layout) = layout else { return subject };
        let word = device.map_or(at.wire.id(), |device| &device.device);
        let (journal, path) = self.journal((word, name_of(at.wire, device)), layout, at);
        subject.kept_by(Keeper::new(journal, path))
    }

    /// The journal of a device with this word in file names and this title, which holds nothing yet, and its file.
    fn journal(
        &self,
        (word, title): (&str, &str),
        layout: Layout,
        at: &At<'_>,
    ) -> (Journal, PathBuf) {
        let At { wire, place, baud, id, model, neighbour } = at;
        let is_allowed = self.allowed().has(Permission::WriteRam);
        let neighbour = neighbour.filter(|_| is_allowed);
        let now: DateTime<Utc> = SystemTime::now().into();
        let path = self.journal.clone().unwrap_or_else(|| {
            let (name, time) = (as_word(word), now.format("%Y%m%dT%H%M%SZ"));
            format!("actucheck-{name}-{id}-{time}.journal.json").into()
        });
        let journal = Journal {
            version: VERSION,
            date: now.to_rfc3339_opts(SecondsFormat::Secs, true),
            wire: *wire,
            device: title.to_owned(),
            model_number: *model,
            id: *id,
            port: (!matches!(place, Place::Program(_))).then(|| place.to_string()),
            baud: *baud,
            allowed: self.allowed(),
            layout,
            held: Snapshot::default(),
            neighbour: neighbour.and_then(|neighbour| beside(*wire, neighbour)),
        };
        (journal, path)
    }
}
