//! A control board with actuators behind it (INNFOS document).
//!
//! What the document leaves unspecified, and what is done here beside what `readings.rs` lets choose:
//!
//! - All actuators obey a request to address 0 that is not for the board.
//! - The board's greeting has no CRC, and a MAC address has four bytes, as printed.
//! - The speeds of the profiles are fractions of the full scale too; an acceleration of 1.0 reaches it
//!   in a second. A profile's value that nobody set bounds nothing.
//! - A value that is refused is not stored: 00 answers it. A read with data is not answered.
//! - An actuator begins switched off, in current mode, at position 0.

mod actuator;
mod board;
#[cfg(unix)]
mod greeted;
mod readings;
mod shaft;
mod values;

use std::ops::RangeInclusive;

use actucheck_codec::innfos::{ACTUATORS, Actuator as Model, Frame, MAX_ADDRESS, MIN_ADDRESS};
use actucheck_codec::innfos::{Direction as Way, Message};
use actucheck_spec::Spec;
use actucheck_spec::wire::{Direction, innfos};

use super::{Devices, Place, PlaceError, Reading, Setup};
use crate::compose::{ComposeError, Phrase, Word, compose};
use crate::device::Tables;
use crate::names::as_word;
use actuator::Actuator;
use board::Board;
#[cfg(unix)]
pub(super) use greeted::greeted;
use readings::BoardReadings;

/// The addresses of actuators.
pub(super) const ADDRESSES: RangeInclusive<u8> = MIN_ADDRESS..=MAX_ADDRESS;

/// What the document leaves unspecified, and a user chooses.
pub(super) const READINGS: &[Reading] = BoardReadings::ALL;

/// Whether a model of actuator has this name.
pub(super) fn knows(name: &str) -> bool {
    model(name).is_some()
}

/// The names of the models.
pub(super) fn names() -> Vec<String> {
    ACTUATORS.iter().map(|model| as_word(model.name)).collect()
}

fn model(name: &str) -> Option<&'static Model> {
    ACTUATORS.iter().find(|model| as_word(model.name) == as_word(name))
}

/// A board with actuators.
pub(super) fn board(
    spec: &Spec,
    places: &[Place],
    setup: &Setup,
) -> Result<Box<dyn Devices>, PlaceError> {
    if setup.rate.is_some() {
        return Err(PlaceError::Rate);
    }
    let mut readings = BoardReadings::default();
    setup.readings.chosen(|name, way| readings.choose(name, way))?;
    let mut actuators = Vec::new();
    for (number, place) in (0_u32..).zip(places) {
        let Some(model) = model(&place.device) else { continue };
        let mut actuator = Actuator::new(place.id, number, model, readings);
        for word in &place.registers {
            let bytes = answer(spec, place, word)?;
            let frame = Frame::parse(Way::Reply, &bytes).ok();
            let message = frame.and_then(|frame| Message::parse(&frame).ok());
            let Some(Message { command, value: Some(value), .. }) = message else { continue };
            if !actuator.preset(command, value) {
                return Err(PlaceError::Preset(word.to_string()));
            }
        }
        actuators.push(actuator);
    }
    Ok(Box::new(Board::new(actuators, readings, spec.wires.innfos.content.udp.query_milliseconds)))
}

/// The answer to a read that finds what a word says.
fn answer(spec: &Spec, place: &Place, word: &Word) -> Result<Vec<u8>, ComposeError> {
    let phrase = Phrase {
        verb: "read",
        direction: Direction::Reply,
        ids: &[place.id],
        tables: &Tables::default(),
        actuator: Some(&place.device),
        words: std::slice::from_ref(word),
    };
    let composed = compose(spec, innfos::WIRE, &phrase)?;
    match composed.refused.into_iter().next() {
        None => Ok(composed.bytes),
        Some(refused) => Err(ComposeError::Misplaced(refused)),
    }
}
