//! Faults of firmware, each with the check that finds it.

use actucheck_spec::wire::dynamixel2::reference::{HEADER, frame, packets, repair};

use super::change::{each, is, names_it, read_of, renamed, silent, with_params};
use super::code::{FAST_SYNC_READ, PING, READ, SYNC_READ};
use super::fault::{Fault, answering, hearing};

/// The faults. `found_by` is a check's id after `dynamixel2.device.`.
pub(crate) const FAULTS: &[Fault] = &[
    answering(
        "ping-without-firmware",
        "leaves out the firmware version in the answer to Ping",
        "basic.ping/answer",
        |_, answer| {
            each(answer, |_, _, data| {
                if data.len() == 3 {
                    data.truncate(2);
                }
            })
        },
    ),
    answering(
        "read-short",
        "answers a Read with one byte too few",
        "basic.read/answer",
        |asked, answer| {
            if is(asked, READ) {
                each(answer, |_, _, data| data.truncate(data.len() - 1))
            } else {
                answer
            }
        },
    ),
    answering(
        "sync-read-silent",
        "does not answer Sync Read",
        "basic.sync-read/answer",
        |asked, answer| silent(asked, answer, SYNC_READ),
    ),
    answering(
        "fast-crc-of-all",
        "makes the CRC of a fast status packet wrong",
        "basic.fast-sync-read/answer",
        |asked, mut answer| {
            if is(asked, FAST_SYNC_READ)
                && let Some(last) = answer.last_mut()
            {
                *last ^= 1;
            }
            answer
        },
    ),
    answering(
        "model-high-byte-first",
        "tells the model number with the high byte first",
        "identity.model-number/ping",
        |asked, answer| {
            if is(asked, PING) { each(answer, |_, _, data| data[..2].reverse()) } else { answer }
        },
    ),
    answering(
        "firmware-differs",
        "tells another firmware version on Ping than on Read",
        "identity.firmware-version/read",
        |asked, answer| {
            if is(asked, PING) { each(answer, |_, _, data| data[2] ^= 1) } else { answer }
        },
    ),
    answering(
        "model-differs",
        "tells another model number on Read than on Ping",
        "identity.model-number/read",
        |asked, answer| {
            if read_of(asked) == Some((0, 2)) {
                each(answer, |_, _, data| data[0] ^= 1)
            } else {
                answer
            }
        },
    ),
    answering(
        "register-missing",
        "has no Velocity I Gain",
        "table.velocity-i-gain/read",
        |asked, answer| {
            if read_of(asked).is_some_and(|(address, length)| address == 524 && length == 2) {
                each(answer, |_, error, data| {
                    *error = 7;
                    data.clear();
                })
            } else {
                answer
            }
        },
    ),
    answering(
        "read-limited",
        "reads no more than 16 bytes at once",
        "table.longest-run/read",
        |asked, answer| {
            if read_of(asked).is_some_and(|(_, length)| length > 16) {
                each(answer, |_, error, data| {
                    *error = 5;
                    data.clear();
                })
            } else {
                answer
            }
        },
    ),
    answering(
        "drive-mode-bits",
        "has a bit of its own in Drive Mode",
        "table.drive-mode/bits",
        |asked, answer| {
            if read_of(asked) == Some((10, 1)) {
                each(answer, |_, _, data| data[0] |= 0x40)
            } else {
                answer
            }
        },
    ),
    answering(
        "alarm-bit-0",
        "has an alarm of its own",
        "table.hardware-error-status/bit-0",
        |asked, answer| {
            if read_of(asked) == Some((518, 1)) {
                each(answer, |_, _, data| data[0] |= 1)
            } else {
                answer
            }
        },
    ),
    answering(
        "tick-of-16-bits",
        "counts Realtime Tick to 65,535",
        "table.realtime-tick/bits",
        |asked, answer| {
            if read_of(asked) == Some((568, 2)) {
                each(answer, |_, _, data| data[1] |= 0x80)
            } else {
                answer
            }
        },
    ),
    answering(
        "undefined-without-error",
        "answers an undefined instruction without an error",
        "refused.instruction-09/answer",
        |_, answer| {
            each(answer, |_, error, _| {
                if *error == 2 {
                    *error = 0;
                }
            })
        },
    ),
    answering(
        "undefined-silent",
        "does not answer an undefined instruction",
        "refused.instruction-40/answer",
        |asked, answer| silent(asked, answer, 0x40),
    ),
    answering(
        "gaps-are-zero",
        "reads 0 where there is no register",
        "refused.address-9/answer",
        |asked, answer| {
            if read_of(asked) == Some((9, 1)) {
                each(answer, |_, error, data| {
                    *error = 0;
                    data.push(0);
                })
            } else {
                answer
            }
        },
    ),
    answering(
        "end-is-range-error",
        "answers a Read past the control table with Data Range Error",
        "refused.beyond-the-end/answer",
        |asked, answer| {
            if read_of(asked).is_some_and(|(address, _)| address > 800) {
                each(answer, |_, error, _| {
                    if *error == 7 {
                        *error = 4;
                    }
                })
            } else {
                answer
            }
        },
    ),
    answering(
        "over-the-end-cut",
        "reads what there is of a Read over the end",
        "refused.over-the-end/answer",
        |asked, answer| {
            if read_of(asked).is_some_and(|(address, length)| address > 800 && length == 2) {
                each(answer, |_, error, data| {
                    if *error == 7 {
                        *error = 0;
                        data.push(0);
                    }
                })
            } else {
                answer
            }
        },
    ),
    hearing(
        "answers-every-id",
        "answers instructions for other IDs",
        "addressee.other-id.ping/silence",
        |heard| renamed(heard, |id, _| id < 253),
    ),
    hearing(
        "answers-255",
        "takes 255 for the broadcast ID",
        "addressee.id-255.ping/silence",
        |heard| renamed(heard, |id, _| id == 255),
    ),
    hearing("answers-253", "has the ID 253 too", "addressee.id-253.ping/silence", |heard| {
        renamed(heard, |id, _| id == 253)
    }),
    hearing(
        "reads-for-all",
        "answers a Read to the broadcast ID",
        "addressee.broadcast.read/silence",
        |heard| renamed(heard, |id, code| id == 254 && code == 2),
    ),
    hearing(
        "refuses-for-all",
        "answers an undefined instruction to the broadcast ID",
        "addressee.broadcast.instruction-09/silence",
        |heard| renamed(heard, |id, code| id == 254 && code == 9),
    ),
    answering(
        "broadcast-ping-silent",
        "does not answer a Ping to the broadcast ID",
        "addressee.broadcast.ping/answers",
        |asked, answer| {
            if asked.get(4) == Some(&254) && is(asked, PING) { Vec::new() } else { answer }
        },
    ),
    hearing(
        "crc-not-checked",
        "does not check the CRC",
        "damaged.byte-9.bit-0/ignored",
        |mut heard| {
            if heard.len() == 10 {
                repair(&mut heard);
            }
            heard
        },
    ),
    hearing(
        "header-of-three",
        "does not look at the fourth byte of the header",
        "stream.after-packet-with-stuffed-header/heard",
        |mut heard| {
            if heard.starts_with(&[0xFF, 0xFF, 0xFD, 0xFD]) && heard.len() >= 10 {
                heard[3] = 0;
                repair(&mut heard[..10]);
            }
            heard
        },
    ),
    hearing(
        "header-low-bits",
        "takes FF FF FD 01 for a header",
        "damaged.byte-3.bit-0/ignored",
        |mut heard| {
            if heard.starts_with(&[0xFF, 0xFF, 0xFD, 0x01]) {
                heard[3] = 0;
            }
            heard
        },
    ),
    hearing(
        "length-not-checked",
        "takes a Ping whose length is too small",
        "damaged.length-too-short/ignored",
        |mut heard| {
            if heard.get(5) == Some(&2) {
                heard[5] = 3;
                repair(&mut heard);
            }
            heard
        },
    ),
    answering(
        "crc-answered-twice",
        "answers a packet with a wrong CRC without an error",
        "damaged.byte-8.bit-0/ignored",
        |asked, answer| {
            if asked.len() == 10
                && packets(asked).is_empty()
                && asked.starts_with(&HEADER)
                && asked[5] == 3
                && asked[4] == 1
            {
                frame(1, &[0x55, 0, 0x5A, 0x14, 0])
            } else {
                answer
            }
        },
    ),
    hearing("noise-confuses", "loses the packet after noise", "stream.after-zero/heard", |heard| {
        if heard.first() == Some(&0) { Vec::new() } else { heard }
    }),
    hearing(
        "pattern-restarts",
        "does not find a header after a single FF",
        "stream.after-ff/heard",
        |heard| {
            if heard.starts_with(&[0xFF; 3]) { Vec::new() } else { heard }
        },
    ),
    hearing(
        "whole-reads-only",
        "takes a packet only if it comes at once",
        "stream.parts-5/heard",
        |heard| {
            if heard.len() < 10 { Vec::new() } else { heard }
        },
    ),
    hearing(
        "one-packet-a-read",
        "loses what comes with a packet in one piece",
        "stream.in-a-row/heard",
        |mut heard| {
            heard.truncate(10);
            heard
        },
    ),
    hearing("reads-from-zero", "reads from address 0", "table.neighbours/order", |heard| {
        with_params(heard, READ, |params| params[..2].fill(0))
    }),
    hearing(
        "sync-read-other-register",
        "reads the next address in a Sync Read",
        "several.sync-read.as-read/data",
        |heard| with_params(heard, SYNC_READ, |params| params[0] += 2),
    ),
    hearing(
        "sync-read-of-others",
        "answers a Sync Read that does not name it",
        "several.sync-read.not-named/silence",
        |heard| names_it(heard, SYNC_READ),
    ),
    hearing(
        "fast-sync-read-of-others",
        "answers a Fast Sync Read that does not name it",
        "several.fast-sync-read.not-named/silence",
        |heard| names_it(heard, FAST_SYNC_READ),
    ),
    answering(
        "alert-always",
        "has the alert without an error",
        "sentence.status-packet-alert/shown",
        |_, answer| each(answer, |_, error, _| *error |= 0x80),
    ),
    answering(
        "stuffed-silent",
        "does not answer what is stuffed",
        "sentence.stuffing/shown",
        |asked, answer| {
            let is_stuffed = asked.windows(4).any(|bytes| bytes == [0xFF, 0xFF, 0xFD, 0xFD]);
            if is_stuffed { Vec::new() } else { answer }
        },
    ),
    answering(
        "printed-clear-done",
        "answers the printed Clear, which is a byte short",
        "damaged.printed-clear/ignored",
        |asked, answer| {
            if asked.len() == 14 && asked[5] == 8 { frame(1, &[0x55, 0]) } else { answer }
        },
    ),
    answering(
        "status-of-others",
        "has another ID in the answer to a Read of two registers",
        "sentence.read-parameters/shown",
        |asked, answer| {
            if read_of(asked).is_some_and(|(address, length)| address == 0 && length > 2) {
                each(answer, |id, _, _| *id = 2)
            } else {
                answer
            }
        },
    ),
];
