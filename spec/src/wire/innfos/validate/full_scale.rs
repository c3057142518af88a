//! Rule: an actuator's full scales are larger than 0.

use crate::Diagnostic;
use crate::load::File;
use crate::wire::innfos::Innfos;

pub(super) fn check(file: &File<Innfos>) -> Vec<Diagnostic> {
    let mut defects = Vec::new();
    for (index, row) in file.content.actuators.rows.iter().enumerate() {
        let scales = [
            ("current", row.current),
            ("motor_speed", row.motor_speed),
            ("output_speed", row.output_speed),
        ];
        for (field, value) in scales {
            if !(value.is_finite() && value > 0.0) {
                let message =
                    format!("{}: {value} is no full scale; it is larger than 0", row.name);
                defects.push(file.diagnostic(&format!("actuators.rows[{index}].{field}"), message));
            }
        }
    }
    defects
}
