//! Faults of firmware in modes, in what depends on them, and in Status Return Level.

use std::sync::atomic::{AtomicBool, Ordering};

use actucheck_spec::wire::dynamixel2::reference::frame;

use super::change::{each, is, read_of, refuses};
use super::code::{PING, READ, WRITE};
use super::fault::{Fault, answering, hearing, on};
use super::rewrite::{Written as _, changed, never_refuses};

const XM430: &str = "xm430-w210@1";
const IN_POSITION_MODE: &str = "ja40@1:operating-mode=3";
const WITH_TIMES: &str = "ja40@1:drive-mode=4";

/// The faults. `found_by` is a check's id after `dynamixel2.device.`.
pub(crate) const FAULTS: &[Fault] = &[
    answering(
        "any-mode",
        "answers without an error whatever Operating Mode is written",
        "sentence.operating-mode-values/shown",
        |asked, answer| never_refuses(asked, answer, 4),
    ),
    answering(
        "goal-within-a-turn",
        "refuses goals of many turns",
        "sentence.goal-position-extended-range/shown",
        |asked, answer| refuses(asked, answer, 564, &i32::MAX.to_le_bytes(), 4),
    ),
    answering(
        "limit-in-every-mode",
        "refuses a goal above a limit in mode 4",
        "sentence.operating-mode-extended-position/shown",
        |asked, answer| refuses(asked, answer, 564, &3001_u32.to_le_bytes(), 6),
    ),
    answering(
        "low-limit-in-every-mode",
        "refuses a goal below a limit in mode 4",
        "sentence.position-limit-mode/shown",
        |asked, answer| refuses(asked, answer, 564, &999_u32.to_le_bytes(), 6),
    ),
    on(
        IN_POSITION_MODE,
        answering(
            "goal-at-a-limit-refused",
            "refuses a goal at a limit",
            "limit.goal-position/at",
            |asked, answer| refuses(asked, answer, 564, &3000_u32.to_le_bytes(), 6),
        ),
    ),
    on(
        IN_POSITION_MODE,
        answering(
            "goal-above-a-limit",
            "answers a goal above a limit without an error",
            "limit.goal-position/above",
            |asked, answer| never_refuses(asked, answer, 6),
        ),
    ),
    on(
        "xm430-w210@1",
        answering(
            "goal-below-a-limit",
            "answers a goal below a limit with Data Range Error",
            "limit.goal-position/below",
            |asked, answer| refuses(asked, answer, 116, &999_u32.to_le_bytes(), 4),
        ),
    ),
    answering(
        "position-without-offset",
        "does not add Homing Offset",
        "sentence.homing-offset-effect/shown",
        |asked, answer| {
            if read_of(asked) == Some((580, 4)) {
                each(answer, |_, _, data| data.fill(0))
            } else {
                answer
            }
        },
    ),
    answering(
        "offset-within-half-a-turn",
        "refuses a Homing Offset of a turn",
        "sentence.homing-offset-range/shown",
        |asked, answer| refuses(asked, answer, 20, &32_768_u32.to_le_bytes(), 4),
    ),
    answering(
        "drive-mode-of-one-bit",
        "refuses a Drive Mode of 3",
        "sentence.drive-mode-range/shown",
        |asked, answer| refuses(asked, answer, 10, &[3], 4),
    ),
    answering(
        "acceleration-unlimited",
        "answers a Profile Acceleration beyond its limit without an error",
        "limit.profile-acceleration/above",
        |asked, answer| never_refuses(asked, answer, 6),
    ),
    answering(
        "velocity-unlimited",
        "answers a Profile Velocity beyond Velocity Limit without an error",
        "limit.profile-velocity/above",
        |asked, answer| never_refuses(asked, answer, 6),
    ),
    on(
        WITH_TIMES,
        answering(
            "acceleration-time-short",
            "refuses a Profile Acceleration of 32,767 ms",
            "sentence.profile-acceleration-range/shown",
            |asked, answer| refuses(asked, answer, 556, &32_767_u32.to_le_bytes(), 4),
        ),
    ),
    on(
        WITH_TIMES,
        answering(
            "profile-time-short",
            "refuses a Profile Velocity of 32,767 ms",
            "sentence.profile-velocity-range/shown",
            |asked, answer| refuses(asked, answer, 560, &32_767_u32.to_le_bytes(), 4),
        ),
    ),
    on(
        XM430,
        answering("level-0-reads", "answers a Read at level 0", "level.0/read", |asked, answer| {
            if answer.is_empty() && is(asked, READ) { frame(1, &[0x55, 0, 0, 0]) } else { answer }
        }),
    ),
    on(
        XM430,
        answering(
            "level-0-writes",
            "answers a Write at level 0",
            "level.0/write",
            |asked, answer| {
                if answer.is_empty() && is(asked, WRITE) { frame(1, &[0x55, 0]) } else { answer }
            },
        ),
    ),
    on(
        XM430,
        hearing("level-1-is-0", "answers no Read at level 1", "level.1/read", |heard| {
            level(heard, 1, 0)
        }),
    ),
    on(
        XM430,
        hearing("level-1-is-2", "answers a Write at level 1", "level.1/write", |heard| {
            level(heard, 1, 2)
        }),
    ),
    on(
        XM430,
        hearing("level-2-late", "takes level 2 only the second time", "level.2/answers", |heard| {
            static IS_SECOND: AtomicBool = AtomicBool::new(false);
            let is_it = heard.ends_with_write(68, &[2]);
            if is_it && !IS_SECOND.fetch_not(Ordering::Relaxed) {
                level(heard, 2, 1)
            } else {
                heard
            }
        }),
    ),
    on(
        XM430,
        answering(
            "level-0-silent",
            "does not answer the first Ping at level 0",
            "level.every/ping",
            |asked, answer| {
                static WAS_SET: AtomicBool = AtomicBool::new(false);
                if asked.ends_with_write(68, &[0]) {
                    WAS_SET.store(true, Ordering::Relaxed);
                }
                let is_first = is(asked, PING) && WAS_SET.swap(false, Ordering::Relaxed);
                if is_first { Vec::new() } else { answer }
            },
        ),
    ),
];

/// Takes another Status Return Level than the one that is written.
fn level(heard: Vec<u8>, from: u8, to: u8) -> Vec<u8> {
    changed(heard, 68, |data| {
        if *data == [from] {
            data[0] = to;
        }
    })
}
