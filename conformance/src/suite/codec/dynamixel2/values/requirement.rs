//! The requirement that says what a value of a register means.

use actucheck_spec::Spec;
use actucheck_spec::model::{Access, Area, Device, Register};
use actucheck_spec::wire::Form;

use super::cases::Case;
use crate::adapter::Given;

/// The id of the requirement. The documents of some devices have no control table; then it is that
/// of the bytes in a packet.
pub(super) fn of(
    spec: &Spec,
    device: &Device,
    register: &Register,
    case: &Case<'_>,
    given: &Given,
) -> String {
    let parts = match &case.form {
        Form::Unit(_) => of_number(register),
        Form::Names(_) => of_name(register, case),
        Form::Flags(_) => of_flags(register, case.raw),
    };
    let mut ids = parts.iter().map(|part| format!("{}.{part}", device.device));
    let own = ids.find(|id| spec.requirement(id).is_some());
    own.unwrap_or_else(|| {
        let part = match given {
            _ if case.raw < 0 => "packet.parameters.negative",
            Given::Bytes(_) => "read.status",
            Given::Value(_) => "write.parameters",
        };
        format!("{}.{part}", device.wire)
    })
}

/// The devices' documents do not have the same sentences, so that there are several to try.
type Parts = &'static [&'static str];

fn of_number(register: &Register) -> Parts {
    match (register.name.as_str(), register.access, register.area) {
        ("Realtime Tick", ..) => &["realtime-tick.value"],
        ("Present Velocity", ..) => &["present-velocity.unit"],
        ("Velocity Trajectory", ..) => &["velocity-trajectory.moving"],
        ("Position Trajectory", ..) => &["position-trajectory.moving", "position-trajectory.modes"],
        (_, Access::Rw, _) if register.unit.is_some() => &["table.units"],
        (_, Access::R, _) if register.unit.is_some() => &["present-values.units"],
        (.., Area::Ram) => &["table.ram-registers", "table.registers"],
        (.., Area::Eeprom) => &["table.registers"],
    }
}

fn of_name(register: &Register, case: &Case<'_>) -> Parts {
    match (register.name.as_str(), case.raw) {
        ("Operating Mode", 0) => &["operating-mode.current"],
        ("Operating Mode", 1) => &["operating-mode.velocity"],
        ("Operating Mode", 3) => &["operating-mode.position"],
        ("Operating Mode", 4) => &["operating-mode.extended-position"],
        ("Operating Mode", 17) => &["operating-mode.calibration"],
        ("Baud Rate", _) => &["baud-rate.values"],
        ("Torque Enable", _) => &["torque-enable.values", "torque-enable.torque"],
        ("Moving Status", _) => &["moving-status.profile"],
        ("Backup Ready", _) => &["backup.ready"],
        _ => &[],
    }
}

/// The requirement on the only flag that is set, else that on the register as a whole.
fn of_flags(register: &Register, raw: i64) -> Parts {
    let flag = register.bits.iter().find(|bits| bits.width == 1 && raw == 1 << bits.lowest);
    match (register.name.as_str(), flag.map_or("", |bits| bits.name.as_str())) {
        ("Moving Status", _) => &["moving-status.in-position"],
        (_, "Reverse Mode") => &["drive-mode.direction"],
        (_, "Disable Profile" | "Enable Profile") => &["drive-mode.profile"],
        (_, "Profile Configuration") => &["drive-mode.profile-kind"],
        ("Drive Mode", _) if raw == 0 => &["drive-mode.unused-bits"],
        ("Drive Mode", _) => &["drive-mode.profile-kind", "drive-mode.profile"],
        (_, "Velocity Limit Reached Error") => &["hardware-error.velocity"],
        (_, "Overheating Error") => &["hardware-error.overheating"],
        (_, "Encoder Error" | "Motor Encoder Error") => &["hardware-error.encoder"],
        (_, "Electrical Shock Error") => &["hardware-error.shock"],
        (_, "Overload Error") => &["hardware-error.overload"],
        (_, "Position Limit Reached Error" | "Position Limit Error") => {
            &["hardware-error.position"]
        }
        (_, "Check EEPROM Area Error") => &["hardware-error.eeprom"],
        ("Hardware Error Status", _) => &["hardware-error.unused-bits"],
        _ => &[],
    }
}
