//! Hardware errors: when their bits are set, and what follows.

use super::memory::Memory;
use super::model::{Model, Watch, mask};
use super::readings::Overheated;

impl Watch {
    /// Sets the bit if the register passes a limit.
    pub(super) fn look(&self, memory: &mut Memory, model: &Model) {
        let value = memory.value(self.watched);
        let passes = memory.get(self.below).is_some_and(|least| value < least)
            || memory.get(self.above).is_some_and(|most| value > most);
        let holds = self.when.as_ref().is_none_or(|when| when.holds(memory.value(when.row)));
        if !passes || !holds {
            return;
        }
        raise(memory, model, self.bit);
    }
}

/// Sets a bit of Hardware Error Status, and turns torque off if Shutdown says so, or a reading where
/// there is no Shutdown.
pub(super) fn raise(memory: &mut Memory, model: &Model, bit: i64) {
    let roles = &model.roles;
    let status = memory.get(roles.hardware_error_status).unwrap_or_default() | bit;
    memory.set(roles.hardware_error_status, status);
    let names = |name| {
        roles.hardware_error_status.is_some_and(|row| {
            row.bits.iter().any(|bits| bits.name == name && mask(bits.lowest, bits.width) == bit)
        })
    };
    let overheated =
        || model.readings.overheated == Overheated::TorqueOff && names("Overheating Error");
    if memory.get(roles.shutdown).map_or_else(overheated, |bits| bits & bit != 0) {
        memory.set(roles.torque_enable, 0);
    }
}
