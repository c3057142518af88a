//! The devices of a stream.

/// Which devices there are, each with its model number if it told it. A list by ID: a stream has
/// millions of packets, and there are 256 IDs.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Devices(Vec<Option<Device>>);

/// A device that was seen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Device {
    model: Option<u16>,
}

impl Devices {
    /// Takes that a packet was for or from a device, and the model number that it tells.
    pub(super) fn see(&mut self, id: u8, model: Option<u16>) {
        let index = usize::from(id);
        if index >= self.0.len() {
            self.0.resize(index + 1, None);
        }
        if let Some(device) = self.0.get_mut(index) {
            let device = device.get_or_insert_default();
            device.model = model.or(device.model);
        }
    }

    /// The IDs, rising, with the model numbers.
    pub fn iter(&self) -> impl Iterator<Item = (u8, Option<u16>)> {
        (0..=u8::MAX).zip(&self.0).filter_map(|(id, device)| Some((id, (*device)?.model)))
    }
}
