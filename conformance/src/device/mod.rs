//! The control tables that give registers their names: those of the spec, and users' own.
//!
//! A user chooses them with words: `ja40` for all devices, `1=ja40,2=my-servo.yaml` by ID, or `none`. A file
//! is YAML as in the spec, or a `.model` file of the ROS 2 hardware interface for DYNAMIXEL devices.
//! [`Tables`] know what was chosen, and beside that what devices answered to Ping. Nothing takes a
//! register's name from a table that neither of them tells.

mod choice;
mod model_file;
mod table;

use std::collections::BTreeMap;
use std::rc::Rc;

use actucheck_codec::register::Device;
use actucheck_codec::{ja_variant, ja40, xl330_m288, xm430_w210};
use actucheck_spec::{Spec, model};

pub use self::choice::DeviceError;
pub(crate) use self::choice::{knows, unknown};

/// The devices of the spec.
pub const KNOWN: [&Device; 4] =
    [&ja40::DEVICE, &ja_variant::DEVICE, &xl330_m288::DEVICE, &xm430_w210::DEVICE];

/// A table without registers, for users who want none named.
pub const NONE: Device = Device {
    id: "none",
    name: "no device",
    model_number: None,
    complete: false,
    instructions: &[],
    eeprom_lock: None,
    registers: &[],
};

/// The device of the spec that answers Ping with this model number.
#[must_use]
pub fn of_model(model: u16) -> Option<&'static Device> {
    KNOWN.into_iter().find(|device| device.model_number == Some(model))
}

/// The control tables of the devices of a bus. A copy is cheap.
#[derive(Clone, Debug, Default)]
pub struct Tables(Option<Rc<Bus>>);

#[derive(Clone, Debug, Default)]
struct Bus {
    /// What the user chose for single IDs.
    chosen: BTreeMap<u8, Chosen>,
    /// What the user chose for all others.
    others: Option<Chosen>,
    /// What devices told, by ID. It is looked up for every packet.
    told: Vec<Option<&'static Device>>,
}

/// A control table that the user chose.
#[derive(Clone, Copy, Debug)]
struct Chosen {
    table: &'static Device,
    /// The content of the user's file, if it is from one.
    file: Option<&'static model::Device>,
}

impl Tables {
    /// The control table of a device, if it is known.
    #[must_use]
    pub fn of(&self, id: u8) -> Option<&'static Device> {
        self.chosen(id).map(|chosen| chosen.table).or_else(|| self.told(id))
    }

    /// The same as it is in the spec or in the user's file, if the user chose it.
    #[must_use]
    pub fn written<'s>(&self, id: u8, spec: &'s Spec) -> Option<&'s model::Device> {
        let chosen = self.chosen(id)?;
        chosen.file.or_else(|| spec.device(chosen.table.id))
    }

    /// Whether nothing is known.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.0.is_none()
    }

    /// Takes the model number that a device told. The user's choice stays.
    pub fn learn(&mut self, id: u8, model: u16) {
        let device = of_model(model);
        // A change copies the whole bus if there are copies of it.
        if self.told(id).map(|known| known.id) == device.map(|device| device.id) {
            return;
        }
        let told = &mut Rc::make_mut(self.0.get_or_insert_default()).told;
        let id = usize::from(id);
        told.resize(told.len().max(id + 1), None);
        if let Some(known) = told.get_mut(id) {
            *known = device;
        }
    }

    fn told(&self, id: u8) -> Option<&'static Device> {
        self.0.as_ref()?.told.get(usize::from(id)).copied().flatten()
    }

    fn chosen(&self, id: u8) -> Option<Chosen> {
        let bus = self.0.as_ref()?;
        bus.chosen.get(&id).copied().or(bus.others)
    }
}

/// The same table for all devices.
impl From<&'static Device> for Tables {
    fn from(table: &'static Device) -> Self {
        let others = Some(Chosen { table, file: None });
        Self(Some(Rc::new(Bus { others, ..Bus::default() })))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_choice_is_stronger_than_what_a_device_tells() {
        let of = |tables: &Tables, id| tables.of(id).map(|device| device.id);
        let mut tables: Tables = "1=ja40".parse().unwrap();
        assert_eq!([1, 2].map(|id| of(&tables, id)), [Some("ja40"), None]);
        let before = tables.clone();
        for id in [1, 2] {
            tables.learn(id, 1030);
        }
        assert_eq!([1, 2].map(|id| of(&tables, id)), [Some("ja40"), Some("xm430-w210")]);
        assert_eq!(of(&before, 2), None);
        tables.learn(2, 1);
        assert_eq!(of(&tables, 2), None, "another device is there now");
        let mut tables = Tables::default();
        tables.learn(1, 1);
        assert!(tables.is_empty(), "no table is known for that model");
    }
}
