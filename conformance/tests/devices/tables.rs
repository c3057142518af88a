//! Faults of firmware in single registers.

use std::sync::atomic::{AtomicBool, Ordering};

use super::change::{each, is, read_of, refuses, register_missing, tells};
use super::code::FACTORY_RESET;
use super::fault::{Fault, answering, hearing, on};
use super::rewrite::changed;

const VARIANT: &str = "ja-variant@1";
/// The address of Movement Duration in the JA variant.
const MOVEMENT: u16 = 522;

/// The faults. `found_by` is a check's id after `dynamixel2.device.`.
pub(crate) const FAULTS: &[Fault] = &[
    // Tables.
    answering(
        "no-rate",
        "has no register for its rate",
        "table.baud-rate/read",
        |asked, answer| register_missing(asked, answer, (8, 1)),
    ),
    answering(
        "profile-2",
        "tells a profile of an unknown kind",
        "table.moving-status/bits",
        |asked, answer| tells(asked, answer, (571, 1), 0x20),
    ),
    answering(
        "pwm-half",
        "refuses the largest PWM Limit",
        "written.pwm-limit/kept",
        |asked, answer| refuses(asked, answer, 36, &37_500_u16.to_le_bytes(), 4),
    ),
    answering(
        "current-half",
        "refuses the largest Current Limit",
        "written.current-limit/kept",
        |asked, answer| refuses(asked, answer, 38, &15_000_u16.to_le_bytes(), 4),
    ),
    answering(
        "acceleration-half",
        "refuses the largest Acceleration Limit",
        "written.acceleration-limit/kept",
        |asked, answer| refuses(asked, answer, 40, &3_992_644_u32.to_le_bytes(), 4),
    ),
    answering(
        "turns-bounded",
        "refuses the largest Max Position Limit",
        "written.max-position-limit/kept",
        |asked, answer| refuses(asked, answer, 48, &i32::MAX.to_le_bytes(), 4),
    ),
    answering(
        "time-half",
        "refuses the largest Profile Time",
        "written.profile-time/kept",
        |asked, answer| refuses(asked, answer, 522, &[0xFF, 0xFF], 4),
    ),
    answering(
        "gain-half",
        "refuses the largest Position D Gain",
        "written.position-d-gain/kept",
        |asked, answer| refuses(asked, answer, 528, &[0xFF, 0x7F], 4),
    ),
    on(
        VARIANT,
        answering(
            "duration-half",
            "refuses the largest Movement Duration",
            "written.movement-duration/kept",
            |asked, answer| {
                let answer = refuses(asked, answer, MOVEMENT, &[0xFF, 0x7F], 4);
                refuses(asked, answer, MOVEMENT, &[0xFF, 0xFF], 4)
            },
        ),
    ),
    on(
        VARIANT,
        hearing(
            "torque-stays-off-v",
            "does not switch torque on",
            "sentence.torque-enable-torque/shown",
            |heard| changed(heard, 512, |data| data.fill(0)),
        ),
    ),
    // Factory Reset.
    answering(
        "reset-with-data",
        "answers a Factory Reset with a byte",
        "reset.keep-id-and-baud-rate/answer",
        |asked, answer| {
            if is(asked, FACTORY_RESET) { each(answer, |_, _, data| data.push(0)) } else { answer }
        },
    ),
    answering(
        "reset-tells-another-rate",
        "tells another rate after a Factory Reset",
        "reset.keep-id-and-baud-rate/rate",
        |asked, answer| {
            static WAS_RESET: AtomicBool = AtomicBool::new(false);
            if is(asked, FACTORY_RESET) {
                WAS_RESET.store(true, Ordering::Relaxed);
            }
            if read_of(asked) == Some((8, 1)) && WAS_RESET.swap(false, Ordering::Relaxed) {
                each(answer, |_, _, data| data[0] ^= 1)
            } else {
                answer
            }
        },
    ),
];
