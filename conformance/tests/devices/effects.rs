//! Faults of firmware that sentences about single instructions find.

use std::sync::atomic::{AtomicBool, Ordering};

use actucheck_spec::wire::dynamixel2::reference::repair;

use super::change::{each, failed, is, read_of, renamed, with_params};
use super::code::{ACTION, CLEAR, FACTORY_RESET, FAST_SYNC_READ, PING, REBOOT, REG_WRITE, WRITE};
use super::fault::{Fault, answering, hearing, on};
use super::rewrite::{changed, never_refuses, packet, unstuffed, with_code};

const XM430: &str = "xm430-w210@1";
/// One that has Clear, after two turns and a part of one.
const TURNED: &str = "xm430-w210@1:firmware-version=42,present-position=10000";

/// The faults. `found_by` is a check's id after `dynamixel2.device.`.
pub(crate) const FAULTS: &[Fault] = &[
    hearing("any-id", "does not look at the ID", "sentence.receive-id/shown", |heard| {
        renamed(heard, |id, _| id == 253 || id == 255)
    }),
    answering(
        "backup-2",
        "has a Backup Ready of 2",
        "table.backup-ready/value",
        |asked, answer| {
            if read_of(asked) == Some((878, 1)) {
                each(answer, |_, _, data| data[0] = 2)
            } else {
                answer
            }
        },
    ),
    hearing(
        "write-high-first",
        "reads the address of a Write high byte first",
        "sentence.write-parameters/shown",
        |heard| with_params(heard, WRITE, |params| params.swap(0, 1)),
    ),
    on(
        XM430,
        hearing(
            "write-low-byte-only",
            "reads one byte of the address of a Write",
            "sentence.write-parameters/shown",
            // The register is at 90, and it takes it for 91.
            |heard| with_params(heard, WRITE, |params| params[0] |= 1),
        ),
    ),
    answering(
        "reboot-wants-a-parameter",
        "answers a Reboot without parameters with Data Length Error",
        "sentence.reboot-parameters/shown",
        |asked, answer| failed(asked, answer, REBOOT, 5),
    ),
    hearing(
        "reboot-is-a-ping",
        "does not restart at a Reboot",
        "sentence.reboot-effect/shown",
        |heard| if is(&heard, REBOOT) { with_code(&heard, PING) } else { heard },
    ),
    answering(
        "reset-wants-a-key",
        "answers a Factory Reset with an option alone with Data Length Error",
        "sentence.factory-reset-parameters/shown",
        |asked, answer| failed(asked, answer, FACTORY_RESET, 5),
    ),
    hearing(
        "reset-without-restart",
        "does not restart after a Factory Reset",
        "sentence.factory-reset-reboot/shown",
        // Acceleration Limit gets its initial value.
        |heard| {
            if is(&heard, FACTORY_RESET) { packet(WRITE, &[40, 0, 0xD0, 7, 0, 0]) } else { heard }
        },
    ),
    answering(
        "clear-with-data",
        "answers Clear with a byte",
        "sentence.clear-status/shown",
        |asked, answer| {
            if is(asked, CLEAR) { each(answer, |_, _, data| data.push(0)) } else { answer }
        },
    ),
    on(
        XM430,
        answering(
            "clear-wants-another-key",
            "answers the key of Clear with Data Range Error",
            "sentence.clear-parameters/shown",
            |asked, answer| failed(asked, answer, CLEAR, 4),
        ),
    ),
    on(
        TURNED,
        hearing(
            "clear-clears-nothing",
            "keeps its turns at a Clear",
            "sentence.clear-position/shown",
            // The LED is off, as it was.
            |heard| if is(&heard, CLEAR) { packet(WRITE, &[65, 0, 0]) } else { heard },
        ),
    ),
    on(
        TURNED,
        answering(
            "clear-with-any-option",
            "tells a position within a turn after a Clear with any option",
            "sentence.clear-unused-options/shown",
            |asked, answer| {
                static WAS_CLEARED: AtomicBool = AtomicBool::new(false);
                if is(asked, CLEAR) {
                    WAS_CLEARED.store(true, Ordering::Relaxed);
                }
                let is_next = read_of(asked) == Some((132, 4));
                if is_next && WAS_CLEARED.swap(false, Ordering::Relaxed) {
                    // A turn has 4,096 counts.
                    each(answer, |_, _, data| {
                        data[1] &= 0x0F;
                        data[2..].fill(0);
                    })
                } else {
                    answer
                }
            },
        ),
    ),
    hearing(
        "torque-stays-off",
        "does not switch torque on",
        "sentence.torque-enable-values/shown",
        |heard| changed(heard, 512, |data| data.fill(0)),
    ),
    answering(
        "lock-not-told",
        "answers a Write to the locked area without an error",
        "lock.table/refused",
        |asked, answer| never_refuses(asked, answer, 7),
    ),
    answering(
        "read-unstuffed",
        "does not stuff what it answers to a Read",
        "stuffed.neighbours/sent",
        |asked, answer| if read_of(asked) == Some((522, 4)) { unstuffed(&answer) } else { answer },
    ),
    answering(
        "fast-read-stuffed",
        "stuffs a fast status packet",
        "stuffed.fast-sync-read/sent",
        |asked, mut answer| {
            let pattern = answer.windows(3).skip(1).position(|part| part == [0xFF, 0xFF, 0xFD]);
            if let Some(place) = pattern.filter(|_| is(asked, FAST_SYNC_READ)) {
                answer.insert(place + 4, 0xFD);
                answer[5] += 1;
                repair(&mut answer);
            }
            answer
        },
    ),
    on(
        XM430,
        hearing(
            "reg-write-high-first",
            "reads the address of a Reg Write high byte first",
            "sentence.reg-write-parameters/shown",
            |heard| with_params(heard, REG_WRITE, |params| params.swap(0, 1)),
        ),
    ),
    on(
        XM430,
        answering(
            "action-wants-a-parameter",
            "answers an Action without parameters with Data Length Error",
            "sentence.action-parameters/shown",
            |asked, answer| failed(asked, answer, ACTION, 5),
        ),
    ),
    // The LED is off, as it was.
    on(
        XM430,
        hearing(
            "action-of-none",
            "answers an Action, and does nothing",
            "registered.action/effect",
            |heard| {
                if is(&heard, ACTION) { packet(WRITE, &[65, 0, 0]) } else { heard }
            },
        ),
    ),
    on(
        XM430,
        answering(
            "flag-stays",
            "shows for ever that a write is registered",
            "registered.flag-after-action/effect",
            |asked, answer| {
                if read_of(asked) == Some((69, 1)) {
                    each(answer, |_, _, data| data.fill(1))
                } else {
                    answer
                }
            },
        ),
    ),
];
