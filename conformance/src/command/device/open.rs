//! Opens the line to a device, wherever it is.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use actucheck::adapter::{Implementation, Settings, Wire};
use actucheck::device::{NONE, Tables, of_model};
use actucheck::port::Place;
use actucheck::subject::device::{Line, Slave, SlaveError};
use actucheck::suite::device::{Identity, has_tables, hello, hello_all, identity, reported};
use actucheck_spec::{Spec, model};

use super::super::shared::Failure;

/// What is opened.
pub(crate) struct Opening<'a> {
    pub(crate) wire: Wire,
    pub(crate) place: &'a Place,
    /// Whether the place is the command of an adapter.
    pub(crate) is_adapter: bool,
    /// The rate of a serial port, if it is chosen.
    pub(crate) baud: Option<u32>,
    /// How long an answer is awaited.
    pub(crate) limit: Duration,
    /// The device's ID.
    pub(crate) id: u8,
}

/// A device that answers, and what else is on its line.
pub(crate) struct Found<'s> {
    pub(crate) line: Line,
    /// What an adapter says of its library.
    pub(crate) library: Option<Implementation>,
    /// Its control table, if it is known.
    pub(crate) device: Option<&'s model::Device>,
    /// What it says of itself.
    pub(crate) said: Identity,
    /// What each device on the line says of itself, by rising ID.
    pub(crate) all: BTreeMap<u8, Identity>,
    /// The rate of a serial port.
    pub(crate) baud: u32,
}

/// The rate of most devices that leave the factory.
pub(crate) const BAUD: u32 = 57_600;

/// How long a program may take to start.
const START: Duration = Duration::from_secs(5);

/// How long it is listened for more devices.
const MORE: Duration = Duration::from_millis(100);

impl Opening<'_> {
    /// Opens the port, and looks who is there.
    pub(crate) fn find<'s>(
        &self,
        spec: &'s Spec,
        tables: &mut Tables,
        interrupted: &Arc<AtomicBool>,
    ) -> Result<Found<'s>, Failure> {
        let Self { wire, place, id, .. } = *self;
        let baud = self.baud.or_else(|| factory_rate(table_of(tables, id, spec)?));
        let baud = baud.unwrap_or(BAUD);
        let (mut line, library) = self.line(baud, interrupted)?;
        // A program has to start first; what is sent meanwhile waits.
        let limit = match place {
            Place::Program(_) => START.max(self.limit),
            _ => self.limit,
        };
        let greeted = line.greet(limit).map_err(Failure::not_started)?;
        let mut ask = |packet, limit, awaits| {
            let answers = line.exchange(&packet, limit, awaits).map_err(Failure::not_started)?;
            let answers = answers.iter().flat_map(|answer| reported(wire, answer));
            Ok::<_, Failure>(answers.collect::<Vec<_>>())
        };
        let mut found = None;
        if let Some(packet) = hello(wire, id) {
            let answers = ask(packet, limit, 1)?;
            found = answers.into_iter().find(|answer| answer.id == id);
        }
        let Some(found) = found else { return Err(self.nothing_answers(baud)) };
        let others = match (greeted, hello_all(wire)) {
            (Some(found), _) => found.iter().flat_map(|answer| reported(wire, answer)).collect(),
            (None, Some(packet)) => ask(packet, MORE, usize::MAX)?,
            (None, None) => Vec::new(),
        };
        let said = identity(wire, &found);
        let mut all: BTreeMap<_, _> =
            others.iter().map(|answer| (answer.id, identity(wire, answer))).collect();
        all.insert(id, said);
        if let Some(model) = said.model_number {
            tables.learn(id, model);
        }
        let device = table_of(tables, id, spec);
        Ok(Found { line, library, device, said, all, baud })
    }

    fn nothing_answers(&self, baud: u32) -> Failure {
        let Self { place, id, .. } = self;
        let rate = if place.has_rate() { format!(", --baud {baud}") } else { String::new() };
        Failure::not_started(format!(
            "{place}: nothing answers; is the device on, and are --id {id}{rate} and the wiring right? \
             `actucheck scan` looks for devices at every rate"
        ))
    }

    /// The line, and what an adapter says of its library.
    pub(crate) fn line(
        &self,
        baud: u32,
        interrupted: &Arc<AtomicBool>,
    ) -> Result<(Line, Option<Implementation>), Failure> {
        let Self { wire, place, limit, .. } = *self;
        let interrupted = Arc::clone(interrupted);
        let command = match place {
            Place::Program(command) if self.is_adapter => command,
            _ => {
                let line = Line::open(wire, place, baud, limit, interrupted);
                return Ok((line.map_err(Failure::not_started)?, None));
            }
        };
        // An interruption does not end it, as the device is restored after one.
        let (slave, library) =
            Slave::start(command, &Settings::default(), wire).map_err(|error| match error {
                SlaveError::Start(error) => Failure::not_started(error),
                error @ SlaveError::NoDevice(_) => Failure::usage(error),
            })?;
        Ok((Line::on(wire, place, Box::new(slave), limit, interrupted), Some(library)))
    }
}

/// What a device is called.
pub(crate) fn name_of(wire: Wire, device: Option<&model::Device>) -> &str {
    let unknown = if has_tables(wire) { "a device that is not known" } else { "an actuator" };
    device.map_or(unknown, |device| &device.title)
}

/// The control table of a device, as the spec or the user's file has it.
pub(crate) fn table_of<'s>(tables: &Tables, id: u8, spec: &'s Spec) -> Option<&'s model::Device> {
    tables.written(id, spec).or_else(|| {
        let table = tables.of(id).filter(|table| table.id != NONE.id)?;
        spec.device(of_model(table.model_number?)?.id)
    })
}

/// The rate with which a device leaves the factory.
pub(crate) fn factory_rate(device: &model::Device) -> Option<u32> {
    let register = device.register("Baud Rate")?;
    let value = register.values.iter().find(|value| Some(value.value) == register.initial)?;
    value.actual.and_then(|rate| rate.try_into().ok())
}
