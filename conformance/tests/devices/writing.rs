//! Faults of firmware that only show when it is written to, each with the check that finds it.

use super::change::{each, is, silent, with_params};
use super::code::{
    ACTION, BULK_WRITE, FACTORY_RESET, FAST_SYNC_WRITE, PING, REBOOT, REG_WRITE, SYNC_WRITE, WRITE,
};
use super::fault::{Fault, answering, hearing, on};
use super::rewrite::{
    Written as _, after_first, changed, elsewhere, never_refuses, other_error, packet, unstuffed,
    with_code,
};

/// The faults. `found_by` is a check's id after `dynamixel2.device.`.
pub(crate) const FAULTS: &[Fault] = &[
    answering("write-silent", "does not answer Write", "basic.write/answer", |asked, answer| {
        silent(asked, answer, WRITE)
    }),
    answering(
        "write-echoes-data",
        "answers Write with the data",
        "basic.write/answer",
        |asked, answer| {
            if !is(asked, WRITE) {
                return answer;
            }
            each(answer, |_, error, data| {
                if *error == 0 {
                    data.push(1);
                }
            })
        },
    ),
    hearing(
        "gain-high-byte-lost",
        "keeps only the low byte of Velocity I Gain",
        "written.velocity-i-gain/kept",
        |heard| {
            changed(heard, 524, |data| {
                if let [_, high] = data {
                    *high = 0;
                }
            })
        },
    ),
    hearing(
        "gains-swapped",
        "keeps Velocity P Gain in Velocity I Gain",
        "written.velocity-p-gain/kept",
        |heard| elsewhere(heard, 526, 524),
    ),
    answering(
        "temperature-limit-narrow",
        "refuses a Temperature Limit of 100",
        "written.temperature-limit/kept",
        |asked, answer| {
            let is_it = asked.ends_with_write(31, &[100]);
            if is_it { each(answer, |_, error, _| *error = 4) } else { answer }
        },
    ),
    hearing(
        "limit-clamped",
        "takes 5,999 for a Velocity Limit of 6,000",
        "written.velocity-limit/kept",
        |heard| {
            changed(heard, 44, |data| {
                if *data == 6000_u32.to_le_bytes() {
                    data.copy_from_slice(&5999_u32.to_le_bytes());
                }
            })
        },
    ),
    hearing(
        "stuffing-not-added",
        "writes the byte FD that stuffs the data",
        "stuffed.neighbours/kept",
        |heard| {
            changed(heard, 522, |data| {
                if data.starts_with(&[0xFF, 0xFF, 0xFD]) && data.len() == 4 {
                    data[3] = 0x7D;
                }
            })
        },
    ),
    answering(
        "range-not-told",
        "answers a value outside its range without an error",
        "range.velocity-i-gain/above",
        |asked, answer| never_refuses(asked, answer, 4),
    ),
    answering(
        "range-is-length-error",
        "answers a value outside its range with Data Length Error",
        "range.pwm-limit/above",
        |asked, answer| other_error(asked, answer, 4, 5),
    ),
    hearing(
        "range-clamped",
        "takes the largest value for one above it",
        "range.position-p-gain/above",
        |heard| {
            changed(heard, 532, |data| {
                if *data == 0x8000_u16.to_le_bytes() {
                    data.copy_from_slice(&0x7FFF_u16.to_le_bytes());
                }
            })
        },
    ),
    answering(
        "limit-is-range-error",
        "answers a goal beyond a limit with Data Range Error",
        "limit.goal-velocity/above",
        |asked, answer| other_error(asked, answer, 6, 4),
    ),
    answering(
        "limit-one-way",
        "looks at Current Limit in one direction only",
        "limit.goal-current/below",
        |asked, answer| {
            let is_negative = asked.len() == 14 && asked[8] == 0x26 && asked[11] & 0x80 != 0;
            if is_negative { never_refuses(asked, answer, 6) } else { answer }
        },
    ),
    hearing(
        "limit-of-positive-goal",
        "takes 0 for a goal at its negative limit",
        "limit.goal-current/at",
        |heard| {
            changed(heard, 550, |data| {
                if data[1] & 0x80 != 0 {
                    data.fill(0);
                }
            })
        },
    ),
    answering(
        "read-only-without-error",
        "answers a Write to a register for reading without an error",
        "access.present-position/refused",
        |asked, answer| never_refuses(asked, answer, 7),
    ),
    answering(
        "read-only-is-instruction-error",
        "answers a Write of the model number with Instruction Error",
        "access.model-number/refused",
        |asked, answer| other_error(asked, answer, 7, 2),
    ),
    answering(
        "no-register-is-range-error",
        "answers a Write past the table with Data Range Error",
        "access.no-register/refused",
        |asked, answer| other_error(asked, answer, 7, 4),
    ),
    answering(
        "short-without-error",
        "answers a Write of half a register without an error",
        "length.short/refused",
        |asked, answer| never_refuses(asked, answer, 5),
    ),
    hearing(
        "short-is-filled",
        "fills a Write of half a register with 0",
        "length.short/refused",
        |heard| {
            with_params(heard, WRITE, |params| {
                if params.len() == 3 && params[..2] == 538_u16.to_le_bytes() {
                    params.push(0);
                }
            })
        },
    ),
    hearing(
        "sync-write-first-only",
        "carries out only the first block of a Sync Write",
        "written.sync-write.after-other/data",
        |heard| with_params(heard, SYNC_WRITE, |params| params.truncate(7)),
    ),
    hearing(
        "sync-write-last-only",
        "carries out only the last block of a Sync Write",
        "written.sync-write.before-other/data",
        |heard| {
            with_params(heard, SYNC_WRITE, |params| {
                if params.len() == 10 {
                    params.drain(4..7);
                }
            })
        },
    ),
    hearing(
        "sync-write-ignored",
        "ignores a Sync Write",
        "written.sync-write.alone/data",
        |heard| {
            if is(&heard, SYNC_WRITE) { after_first(&heard) } else { heard }
        },
    ),
    hearing(
        "sync-write-for-all",
        "carries out a Sync Write for another device",
        "written.sync-write.not-named/nothing",
        |heard| with_params(heard, SYNC_WRITE, |params| params[4] = 1),
    ),
    answering(
        "sync-write-answered",
        "answers a Sync Write",
        "written.sync-write.answer/silence",
        |asked, answer| {
            let answers = [0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x04, 0x00, 0x55, 0x00, 0xA1, 0x0C];
            if is(asked, SYNC_WRITE) { answers.to_vec() } else { answer }
        },
    ),
    answering(
        "fast-sync-write-crc",
        "makes the CRC of the answer to Fast Sync Write wrong",
        "written.fast-sync-write.answer/status",
        |asked, mut answer| {
            if is(asked, FAST_SYNC_WRITE)
                && let Some(last) = answer.last_mut()
            {
                *last ^= 1;
            }
            answer
        },
    ),
    hearing(
        "fast-sync-write-low-byte",
        "writes only the low byte of a Fast Sync Write",
        "written.fast-sync-write.alone/data",
        |heard| {
            with_params(heard, FAST_SYNC_WRITE, |params| {
                if let Some(last) = params.last_mut() {
                    *last = 0;
                }
            })
        },
    ),
    hearing(
        "fast-sync-write-for-all",
        "carries out a Fast Sync Write for another device",
        "written.fast-sync-write.not-named/nothing",
        |heard| with_params(heard, FAST_SYNC_WRITE, |params| params[4] = 1),
    ),
    hearing(
        "writes-for-others",
        "carries out a Write for another device",
        "written.other-id.write/nothing",
        |heard| super::change::renamed(heard, |id, code| id < 253 && code == WRITE),
    ),
    answering(
        "broadcast-write-answered",
        "answers a Write to the broadcast ID",
        "written.broadcast.write/silence",
        |asked, answer| {
            let answers = [0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x04, 0x00, 0x55, 0x00, 0xA1, 0x0C];
            if asked.get(4) == Some(&254) && is(asked, WRITE) { answers.to_vec() } else { answer }
        },
    ),
    hearing(
        "broadcast-write-ignored",
        "ignores a Write to the broadcast ID",
        "written.broadcast.write/data",
        |heard| {
            if heard.get(4) == Some(&254) && is(&heard, WRITE) {
                after_first(&heard)
            } else {
                heard
            }
        },
    ),
    on(
        "xm430-w210@1",
        hearing(
            "reg-write-at-once",
            "carries out a Reg Write at once",
            "registered.deferred/effect",
            |heard| {
                if is(&heard, REG_WRITE) { with_code(&heard, WRITE) } else { heard }
            },
        ),
    ),
    on(
        "xm430-w210@1",
        answering(
            "action-silent",
            "does not answer Action",
            "basic.action/answer",
            |asked, answer| silent(asked, answer, ACTION),
        ),
    ),
    on(
        "xm430-w210@1",
        answering(
            "reg-write-silent",
            "does not answer Reg Write",
            "basic.reg-write/answer",
            |asked, answer| silent(asked, answer, REG_WRITE),
        ),
    ),
    on(
        "xm430-w210@1",
        answering(
            "action-of-nothing",
            "answers an Action without a Reg Write without an error",
            "registered.nothing/effect",
            |asked, answer| {
                if is(asked, ACTION) { each(answer, |_, error, _| *error = 0) } else { answer }
            },
        ),
    ),
    on(
        "xm430-w210@1",
        answering(
            "no-flag",
            "does not show that a write is registered",
            "registered.flag/effect",
            |asked, answer| {
                if super::change::read_of(asked) == Some((69, 1)) {
                    each(answer, |_, _, data| data.fill(0))
                } else {
                    answer
                }
            },
        ),
    ),
    on(
        "xm430-w210@1",
        answering(
            "stuffing-not-sent",
            "does not stuff what it answers",
            "stuffed.place-2/kept",
            |asked, answer| {
                let is_data = super::change::read_of(asked) == Some((224, 8));
                if is_data { unstuffed(&answer) } else { answer }
            },
        ),
    ),
    on(
        "xm430-w210@1",
        hearing(
            "bulk-write-ignored",
            "ignores a Bulk Write",
            "written.bulk-write.alone/data",
            |heard| {
                if is(&heard, BULK_WRITE) { after_first(&heard) } else { heard }
            },
        ),
    ),
    answering(
        "reboot-silent",
        "does not answer Reboot",
        "restart.reboot/answer",
        |asked, answer| silent(asked, answer, REBOOT),
    ),
    hearing(
        "reboot-ignored",
        "answers Reboot, and does nothing",
        "restart.ram/initial-values",
        |heard| {
            if is(&heard, REBOOT) { with_code(&heard, PING) } else { heard }
        },
    ),
    hearing(
        "reboot-resets",
        "sets the EEPROM area back when it restarts",
        "restart.eeprom/kept",
        |heard| {
            if is(&heard, REBOOT) { packet(FACTORY_RESET, &[0x02]) } else { heard }
        },
    ),
    hearing(
        "reset-restarts-only",
        "only restarts at a Factory Reset",
        "reset.keep-id-and-baud-rate/initial-values",
        |heard| {
            if is(&heard, FACTORY_RESET) { packet(REBOOT, &[]) } else { heard }
        },
    ),
    answering(
        "lock-without-error",
        "answers a Write to the locked EEPROM area without an error",
        "lock.eeprom/refused",
        |asked, answer| never_refuses(asked, answer, 7),
    ),
];
