//! A half-duplex line with devices that have control tables (DYNAMIXEL Protocol 2.0; JA40 document).

mod alarm;
mod device;
mod hearing;
mod line;
mod memory;
mod model;
mod readings;
mod shaft;

use std::collections::BTreeMap;
use std::sync::Arc;

use actucheck_spec::Spec;

use super::{Devices, Place, PlaceError, Setup};
use crate::compose;
use crate::device::Tables;
use line::Line;
use model::Model;

pub use device::VirtualDevice;
pub use readings::{ReadingError, Readings};

/// The largest ID of a device.
pub(super) const LARGEST_ID: u8 = 252;

/// A line with devices.
pub(super) fn line(
    spec: &Spec,
    places: &[Place],
    setup: &Setup,
) -> Result<Box<dyn Devices>, PlaceError> {
    let mut models = BTreeMap::new();
    let mut devices = Vec::new();
    for place in places {
        if !models.contains_key(&place.device) {
            let tables: Tables = place.device.parse()?;
            let known = tables.of(place.id).zip(tables.written(place.id, spec));
            let (table, written) = known.ok_or(PlaceError::None)?;
            let model = Arc::new(Model::new(table, written, setup.readings));
            models.insert(&place.device, (model, tables));
        }
        let Some((model, tables)) = models.get(&place.device) else { continue };
        let mut device = VirtualDevice::new(Arc::clone(model), place.id);
        if let Some(written) = tables.written(place.id, spec) {
            for word in &place.registers {
                let (address, data) = compose::register(written, word)?;
                device.preset(address, &data);
            }
        }
        devices.push(device);
    }
    Ok(Box::new(Line::new(devices, setup.readings, setup.rate)))
}
