//! A half-duplex line with devices that have control tables (DYNAMIXEL Protocol 2.0; JA40 document).

mod alarm;
mod damaged;
mod device;
mod hearing;
mod indirect;
mod line;
mod memory;
mod model;
mod readings;
mod shaft;

use std::collections::BTreeMap;
use std::sync::Arc;

use actucheck_spec::Spec;
use actucheck_spec::model::Device;

use super::{Devices, Place, PlaceError, Reading, Setup};
use crate::compose::{self, Word};
use crate::device::{KNOWN, Tables};
use crate::names::as_word;
use line::Line;
use model::Model;
use readings::LineReadings;

pub use device::VirtualDevice;

/// The largest ID of a device.
pub(super) const LARGEST_ID: u8 = 252;

/// What the documents leave unspecified, and a user chooses.
pub(super) const READINGS: &[Reading] = LineReadings::ALL;

/// A line with devices.
pub(super) fn line(
    spec: &Spec,
    places: &[Place],
    setup: &Setup,
) -> Result<Box<dyn Devices>, PlaceError> {
    let mut readings = LineReadings::default();
    setup.readings.chosen(|name, way| readings.choose(name, way))?;
    let mut models = BTreeMap::new();
    let mut devices = Vec::new();
    for place in places {
        if !models.contains_key(&place.device) {
            let tables = Tables::of_each([(place.id, place.device.as_str())])?;
            let known = tables.of(place.id).zip(tables.written(place.id, spec));
            let (table, written) = known.ok_or(PlaceError::None)?;
            let model = Arc::new(Model::new(table, written, readings));
            models.insert(&place.device, (model, written));
        }
        let Some((model, written)) = models.get(&place.device) else { continue };
        let mut device = VirtualDevice::new(Arc::clone(model), place.id);
        begin(&mut device, written, &place.registers)?;
        devices.push(device);
    }
    Ok(Box::new(Line::new(devices, readings, setup.rate)))
}

/// The names of the devices.
pub(super) fn names() -> Vec<String> {
    KNOWN.iter().map(|device| device.id.to_owned()).collect()
}

/// Sets what registers hold at the beginning: measurements after what they depend on, and goals last, as
/// a shaft that is put somewhere stays there.
fn begin(device: &mut VirtualDevice, written: &Device, words: &[Word]) -> Result<(), PlaceError> {
    let mut words: Vec<_> = words.iter().collect();
    let starts = |word: &Word, start| as_word(&word.name).starts_with(start);
    words.sort_by_key(|word| (starts(word, "goal"), starts(word, "present")));
    for word in words {
        let (address, data) = compose::register(written, word)?;
        device.preset(address, &data);
        if !device.holds(address, &data) {
            return Err(PlaceError::Preset(word.to_string()));
        }
    }
    Ok(())
}
