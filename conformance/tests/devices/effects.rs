//! Faults of firmware that sentences about single instructions, modes and levels find.

use std::sync::atomic::{AtomicBool, Ordering};

use actucheck_spec::wire::dynamixel2::reference::{frame, repair};

use super::change::{each, instruction, read_of, renamed, with_params};
use super::fault::{Fault, answering, hearing, on};
use super::rewrite::{
    WRITE, Written as _, after_first, changed, never_refuses, packet, unstuffed, with_code,
};

/// The codes of instructions.
const REG_WRITE: u8 = 0x04;
const ACTION: u8 = 0x05;
const FACTORY_RESET: u8 = 0x06;
const REBOOT: u8 = 0x08;
const CLEAR: u8 = 0x10;
const SYNC_WRITE: u8 = 0x83;
const FAST_SYNC_READ: u8 = 0x8A;
const FAST_SYNC_WRITE: u8 = 0x8B;
const BULK_WRITE: u8 = 0x93;

const XM430: &str = "xm430-w210@1";
/// One that has Clear, after two turns and a part of one.
const TURNED: &str = "xm430-w210@1:firmware-version=42,present-position=10000";
const IN_POSITION_MODE: &str = "ja40@1:operating-mode=3";
const WITH_TIMES: &str = "ja40@1:drive-mode=4";

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
    hearing(
        "fast-write-address-high-first",
        "reads the address of a Fast Sync Write high byte first",
        "sentence.fast-sync-write-parameters/shown",
        |heard| with_params(heard, FAST_SYNC_WRITE, |params| params.swap(0, 1)),
    ),
    answering(
        "fast-write-own-id",
        "answers a Fast Sync Write with its own ID",
        "sentence.fast-sync-write-broadcast-id/shown",
        |asked, answer| repaired(asked, answer, FAST_SYNC_WRITE, |answer| answer[4] = 1),
    ),
    hearing(
        "fast-write-next-register",
        "writes a Fast Sync Write to the next register",
        "sentence.fast-sync-write-same-registers/shown",
        |heard| with_params(heard, FAST_SYNC_WRITE, |params| params[0] -= 2),
    ),
    answering(
        "fast-write-length",
        "leaves the CRC out of the length of the answer to a Fast Sync Write",
        "sentence.fast-sync-write-length/shown",
        |asked, answer| repaired(asked, answer, FAST_SYNC_WRITE, |answer| answer[5] -= 2),
    ),
    on(
        "ja40@1 ja40@2",
        hearing(
            "fast-write-by-id",
            "answers a Fast Sync Write by rising ID",
            "sentence.fast-sync-write-order/shown",
            |heard| {
                with_params(heard, FAST_SYNC_WRITE, |params| {
                    if params.len() == 8 && params[4] > params[6] {
                        params.swap(4, 6);
                    }
                })
            },
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
        |heard| if is(&heard, REBOOT) { with_code(&heard, 0x01) } else { heard },
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
            |asked, answer| {
                if asked.ends_with_write(116, &999_u32.to_le_bytes()) {
                    each(answer, |_, error, _| *error = 4)
                } else {
                    answer
                }
            },
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
            if answer.is_empty() && is(asked, 0x02) { frame(1, &[0x55, 0, 0, 0]) } else { answer }
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
                let is_first = is(asked, 0x01) && WAS_SET.swap(false, Ordering::Relaxed);
                if is_first { Vec::new() } else { answer }
            },
        ),
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
    on(
        XM430,
        hearing(
            "sync-write-high-first",
            "reads the address of a Sync Write high byte first",
            "sentence.sync-write-parameters/shown",
            |heard| with_params(heard, SYNC_WRITE, |params| params.swap(0, 1)),
        ),
    ),
    on(
        XM430,
        hearing(
            "sync-write-own-id-only",
            "ignores a Sync Write to the broadcast ID",
            "sentence.sync-write-broadcast-id/shown",
            |heard| if is(&heard, SYNC_WRITE) { after_first(&heard) } else { heard },
        ),
    ),
    on(
        XM430,
        hearing(
            "bulk-write-high-first",
            "reads the address of a Bulk Write high byte first",
            "sentence.bulk-write-parameters/shown",
            |heard| with_params(heard, BULK_WRITE, |params| params.swap(1, 2)),
        ),
    ),
    on(
        XM430,
        hearing(
            "bulk-write-own-id-only",
            "ignores a Bulk Write to the broadcast ID",
            "sentence.bulk-write-broadcast-id/shown",
            |heard| if is(&heard, BULK_WRITE) { after_first(&heard) } else { heard },
        ),
    ),
];

/// Whether these bytes begin with an instruction.
fn is(asked: &[u8], code: u8) -> bool {
    instruction(asked) == Some(code)
}

/// Answers an instruction with an error.
fn failed(asked: &[u8], answer: Vec<u8>, code: u8, number: u8) -> Vec<u8> {
    if is(asked, code) { each(answer, |_, error, _| *error = number) } else { answer }
}

/// Answers a Write of these bytes with an error.
fn refuses(asked: &[u8], answer: Vec<u8>, address: u16, data: &[u8], number: u8) -> Vec<u8> {
    if asked.ends_with_write(address, data) {
        each(answer, |_, error, _| *error = number)
    } else {
        answer
    }
}

/// Changes the bytes of the answer to an instruction, and makes the CRC fit.
fn repaired(asked: &[u8], mut answer: Vec<u8>, code: u8, change: fn(&mut Vec<u8>)) -> Vec<u8> {
    if is(asked, code) && !answer.is_empty() {
        change(&mut answer);
        repair(&mut answer);
    }
    answer
}

/// Takes another Status Return Level than the one that is written.
fn level(heard: Vec<u8>, from: u8, to: u8) -> Vec<u8> {
    changed(heard, 68, |data| {
        if *data == [from] {
            data[0] = to;
        }
    })
}
