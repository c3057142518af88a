//! Faults of what a hardware error shows.

use super::change::{each, read_of};
use super::fault::{Fault, answering};

const HARDWARE_ERROR_STATUS: (u16, u16) = (518, 1);
const ALERT: u8 = 0x80;

/// The faults. `found_by` is a check's id after `dynamixel2.device.`.
pub(crate) const FAULTS: &[Fault] = &[
    answering(
        "never-too-hot",
        "shows no hardware error above its Temperature Limit",
        "alarm.temperature-limit/raised",
        |asked, answer| shows(asked, answer, 0),
    ),
    answering(
        "heat-as-overload",
        "shows an overload where it is too hot",
        "alarm.overheating/bit",
        |asked, answer| shows(asked, answer, 0x20),
    ),
    answering(
        "alert-or-error",
        "leaves the alert out of an answer with an error number",
        "alarm.alert/every-answer",
        |_, answer| {
            each(answer, |_, error, _| {
                if *error & !ALERT != 0 {
                    *error &= !ALERT;
                }
            })
        },
    ),
];

/// Shows another hardware error than there is.
fn shows(asked: &[u8], answer: Vec<u8>, other: u8) -> Vec<u8> {
    if read_of(asked) != Some(HARDWARE_ERROR_STATUS) {
        return answer;
    }
    each(answer, |_, _, data| {
        if data[0] != 0 {
            data[0] = other;
        }
    })
}
