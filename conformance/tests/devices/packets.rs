//! Faults of firmware in packets as such, and in single rows of tables: for each sentence that a check shows, one
//! that the check finds.

use std::sync::atomic::{AtomicBool, Ordering};

use actucheck_spec::wire::dynamixel2::reference::{frame, repair};

use super::change::{each, instruction, read_of, with_params};
use super::fault::{Answers, Fault, answering, hearing, on};
use super::rewrite::{Written as _, changed, packet};

const XM430: &str = "xm430-w210@1";
const VARIANT: &str = "ja-variant@1";
const TWO: &str = "ja40@1 ja40@2";
const TWO_XM430: &str = "xm430-w210@1 xm430-w210@2";

const PING: u8 = 0x01;
const READ: u8 = 0x02;
const ACTION: u8 = 0x05;
const FACTORY_RESET: u8 = 0x06;
const SYNC_READ: u8 = 0x82;
const FAST_SYNC_READ: u8 = 0x8A;
const BULK_READ: u8 = 0x92;
const BULK_WRITE: u8 = 0x93;

/// The faults. `found_by` is a check's id after `dynamixel2.device.`.
pub(crate) const FAULTS: &[Fault] = &[
    // The packet that answers Ping.
    ping("header-short", "leaves out the first FF", "sentence.packet-layout/shown", SHORT),
    on(
        XM430,
        ping("header-short-x", "leaves out the first FF", "sentence.packet-layout/shown", SHORT),
    ),
    ping("reserved-1", "sends 01 after the header", "sentence.packet-reserved/shown", RESERVED),
    on(
        XM430,
        ping(
            "reserved-1-x",
            "sends 01 after the header",
            "sentence.packet-reserved/shown",
            RESERVED,
        ),
    ),
    ping("length-long", "sends a length that is too large", "sentence.length-value/shown", LONG),
    on(
        XM430,
        ping(
            "length-long-x",
            "sends a length that is too large",
            "sentence.packet-length/shown",
            LONG,
        ),
    ),
    ping(
        "length-high-first",
        "sends the high byte of a length first",
        "sentence.length-byte-order/shown",
        SWAPPED,
    ),
    on(
        XM430,
        ping(
            "length-high-first-x",
            "sends the high byte of a length first",
            "sentence.packet-length-byte-order/shown",
            SWAPPED,
        ),
    ),
    ping(
        "length-of-data",
        "counts only data and CRC in a length",
        "sentence.packet-length-status/shown",
        OF_DATA,
    ),
    ping(
        "error-last",
        "sends the error behind the data",
        "sentence.status-packet-layout/shown",
        ERROR_LAST,
    ),
    on(
        XM430,
        ping(
            "error-last-x",
            "sends the error behind the data",
            "sentence.status-packet-layout/shown",
            ERROR_LAST,
        ),
    ),
    ping("answers-as-all", "answers with ID 254", "sentence.status-packet-id/shown", AS_ALL),
    on(
        XM430,
        ping("answers-as-all-x", "answers with ID 254", "sentence.status-packet-id/shown", AS_ALL),
    ),
    ping(
        "answers-as-asked",
        "answers with the instruction that it heard",
        "sentence.status-packet-instruction/shown",
        AS_ASKED,
    ),
    ping("error-bit-6", "sets bit 6 of the error", "sentence.status-packet-error/shown", BIT_6),
    on(
        XM430,
        ping(
            "error-bit-6-x",
            "sets bit 6 of the error",
            "sentence.status-packet-error-fields/shown",
            BIT_6,
        ),
    ),
    ping(
        "done-is-1",
        "has error 1 when all is well",
        "sentence.status-packet-error-none/shown",
        DONE_IS_1,
    ),
    ping(
        "ping-wants-data",
        "refuses a Ping without parameters",
        "sentence.ping-parameters/shown",
        WANTS_DATA,
    ),
    on(
        XM430,
        ping(
            "ping-wants-data-x",
            "refuses a Ping without parameters",
            "sentence.ping-parameters/shown",
            WANTS_DATA,
        ),
    ),
    ping("crc-other-seed", "has another CRC", "sentence.crc-value/shown", |asked, answer| {
        bare(asked, answer, |answer| answer[12] ^= 0x55)
    }),
    ping(
        "crc-high-first-of-ping",
        "sends the high byte of a CRC first",
        "sentence.crc-byte-order/shown",
        |asked, answer| bare(asked, answer, |answer| answer.swap(12, 13)),
    ),
    ping(
        "printed-ping-silent",
        "does not answer the printed Ping",
        "sentence.packets/shown",
        |asked, answer| bare(asked, answer, Vec::clear),
    ),
    // Ping to all.
    answering(
        "deaf-to-all",
        "is silent to the broadcast ID",
        "sentence.id-broadcast/shown",
        silent_to_all,
    ),
    on(
        XM430,
        answering(
            "deaf-to-all-x",
            "is silent to the broadcast ID",
            "sentence.packet-id-broadcast/shown",
            silent_to_all,
        ),
    ),
    on(
        XM430,
        answering(
            "refuses-all",
            "answers a Ping to all with an error",
            "sentence.response-broadcast/shown",
            |asked, answer| {
                if to_all(asked) { each(answer, |_, error, _| *error = 2) } else { answer }
            },
        ),
    ),
    on(
        TWO,
        answering(
            "falling-ids",
            "answers a Ping to all by falling ID",
            "sentence.ping-broadcast-order/shown",
            |asked, mut answer| {
                let half = answer.len() / 2;
                if to_all(asked) {
                    answer.rotate_left(half);
                }
                answer
            },
        ),
    ),
    // Read.
    answering(
        "read-length-less",
        "finds a Read too short",
        "sentence.packet-length-instruction/shown",
        |asked, answer| failed(asked, answer, READ, 5),
    ),
    hearing(
        "read-sections-swapped",
        "takes the length of a Read for its address",
        "sentence.sync-sections/shown",
        swapped_read,
    ),
    on(
        XM430,
        hearing(
            "read-parameters-swapped",
            "takes the length of a Read for its address",
            "sentence.packet-parameters/shown",
            swapped_read,
        ),
    ),
    answering(
        "data-backwards",
        "sends data by falling address",
        "sentence.status-packet-parameters/shown",
        |asked, answer| {
            if of(asked, READ) { each(answer, |_, _, data| data.reverse()) } else { answer }
        },
    ),
    answering("reads-twice", "answers a Read twice", "sentence.status-packet-answer/shown", twice),
    on(
        XM430,
        answering("reads-twice-x", "answers a Read twice", "sentence.response-own-id/shown", twice),
    ),
    answering(
        "read-unknown",
        "does not know the code of Read",
        "sentence.instruction-codes/shown",
        unknown,
    ),
    on(
        VARIANT,
        answering(
            "read-unknown-v",
            "does not know the code of Read",
            "sentence.instruction-codes/shown",
            unknown,
        ),
    ),
    on(
        XM430,
        answering(
            "read-unknown-x",
            "does not know the code of Read",
            "sentence.packet-instruction-codes/shown",
            unknown,
        ),
    ),
    on(
        XM430,
        answering(
            "no-position",
            "has no register of the printed Read",
            "sentence.packets-device/shown",
            |asked, answer| register_missing(asked, answer, 132, 4),
        ),
    ),
    answering(
        "stuffed-length-bare",
        "takes the length without what stuffs",
        "sentence.stuffing-length/shown",
        silent_to_stuffed,
    ),
    answering(
        "stuffed-crc-bare",
        "makes the CRC without what stuffs",
        "sentence.stuffing-crc/shown",
        |asked, answer| {
            if is_stuffed(asked) { each(answer, |_, error, _| *error = 3) } else { answer }
        },
    ),
    on(
        XM430,
        answering(
            "stuffed-data-only",
            "expects stuffing in data only",
            "sentence.stuffing-covers/shown",
            silent_to_stuffed,
        ),
    ),
    answering(
        "alarm-without-alert",
        "has an alarm and no alert",
        "sentence.status-packet-alert-cause/shown",
        |asked, answer| {
            if read_of(asked) == Some((518, 1)) {
                each(answer, |_, _, data| data[0] = 4)
            } else {
                answer
            }
        },
    ),
    // Tables.
    answering("no-rate", "has no register for its rate", "table.baud-rate/read", no_rate),
    on(
        VARIANT,
        answering("no-rate-v", "has no register for its rate", "table.baud-rate/read", no_rate),
    ),
    answering(
        "profile-2",
        "tells a profile of an unknown kind",
        "table.moving-status/bits",
        profile_2,
    ),
    on(
        VARIANT,
        answering(
            "profile-2-v",
            "tells a profile of an unknown kind",
            "table.moving-status/bits",
            profile_2,
        ),
    ),
    answering("pwm-half", "refuses the largest PWM Limit", "written.pwm-limit/kept", pwm),
    on(
        VARIANT,
        answering("pwm-half-v", "refuses the largest PWM Limit", "written.pwm-limit/kept", pwm),
    ),
    answering(
        "current-half",
        "refuses the largest Current Limit",
        "written.current-limit/kept",
        |asked, answer| refuses(asked, answer, 38, &15_000_u16.to_le_bytes()),
    ),
    answering(
        "acceleration-half",
        "refuses the largest Acceleration Limit",
        "written.acceleration-limit/kept",
        |asked, answer| refuses(asked, answer, 40, &3_992_644_u32.to_le_bytes()),
    ),
    answering(
        "turns-bounded",
        "refuses the largest Max Position Limit",
        "written.max-position-limit/kept",
        position,
    ),
    on(
        VARIANT,
        answering(
            "turns-bounded-v",
            "refuses the largest Max Position Limit",
            "written.max-position-limit/kept",
            position,
        ),
    ),
    answering(
        "time-half",
        "refuses the largest Profile Time",
        "written.profile-time/kept",
        |asked, answer| refuses(asked, answer, 522, &[0xFF, 0xFF]),
    ),
    answering(
        "gain-half",
        "refuses the largest Position D Gain",
        "written.position-d-gain/kept",
        gain,
    ),
    on(
        VARIANT,
        answering(
            "gain-half-v",
            "refuses the largest Position D Gain",
            "written.position-d-gain/kept",
            gain,
        ),
    ),
    on(
        VARIANT,
        answering(
            "duration-half",
            "refuses the largest Movement Duration",
            "written.movement-duration/kept",
            |asked, answer| {
                if asked.ends_with_write(MOVEMENT, &[0xFF, 0x7F])
                    || asked.ends_with_write(MOVEMENT, &[0xFF, 0xFF])
                {
                    each(answer, |_, error, _| *error = 4)
                } else {
                    answer
                }
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
        reset_data,
    ),
    on(
        XM430,
        answering(
            "reset-with-data-x",
            "answers a Factory Reset with a byte",
            "reset.keep-id-and-baud-rate/answer",
            reset_data,
        ),
    ),
    answering(
        "reset-tells-another-rate",
        "tells another rate after a Factory Reset",
        "reset.keep-id-and-baud-rate/rate",
        |asked, answer| {
            static WAS_RESET: AtomicBool = AtomicBool::new(false);
            if of(asked, FACTORY_RESET) {
                WAS_RESET.store(true, Ordering::Relaxed);
            }
            if read_of(asked) == Some((8, 1)) && WAS_RESET.swap(false, Ordering::Relaxed) {
                each(answer, |_, _, data| data[0] ^= 1)
            } else {
                answer
            }
        },
    ),
    // Instructions for several devices.
    on(
        XM430,
        hearing(
            "sync-read-high-first",
            "reads the address of a Sync Read high byte first",
            "sentence.sync-read-parameters/shown",
            |heard| with_params(heard, SYNC_READ, |params| params[1] = 9),
        ),
    ),
    on(
        XM430,
        answering(
            "sync-read-own-id-only",
            "ignores a Sync Read to the broadcast ID",
            "sentence.sync-read-broadcast-id/shown",
            |asked, answer| {
                if of(asked, SYNC_READ) { Vec::new() } else { answer }
            },
        ),
    ),
    on(
        TWO,
        hearing(
            "sync-read-by-id",
            "answers a Sync Read by falling ID",
            "several.sync-read.first-of-two/order",
            |heard| with_params(heard, SYNC_READ, |params| params[4..].reverse()),
        ),
    ),
    hearing(
        "fast-read-high-first",
        "takes another length in a Fast Sync Read",
        "sentence.fast-sync-read-parameters/shown",
        |heard| with_params(heard, FAST_SYNC_READ, |params| params[2] += 1),
    ),
    answering(
        "fast-read-own-id",
        "answers a Fast Sync Read with its own ID",
        "sentence.fast-sync-read-broadcast-id/shown",
        |asked, answer| fast(asked, answer, |answer| answer[4] = 1),
    ),
    answering(
        "fast-read-length",
        "leaves the CRC out of the length of a fast status packet",
        "sentence.fast-sync-read-length/shown",
        |asked, answer| fast(asked, answer, |answer| answer[5] -= 2),
    ),
    hearing(
        "fast-read-next-register",
        "reads the next register in a Fast Sync Read",
        "several.fast-sync-read.as-read/data",
        |heard| with_params(heard, FAST_SYNC_READ, |params| params[0] += 2),
    ),
    on(
        TWO,
        hearing(
            "fast-read-by-id",
            "answers a Fast Sync Read by falling ID",
            "several.fast-sync-read.first-of-two/order",
            |heard| with_params(heard, FAST_SYNC_READ, |params| params[4..].reverse()),
        ),
    ),
    on(
        XM430,
        answering(
            "bulk-read-silent",
            "does not answer Bulk Read",
            "basic.bulk-read/answer",
            no_bulk_read,
        ),
    ),
    on(
        XM430,
        answering(
            "bulk-read-own-id-only",
            "ignores a Bulk Read to the broadcast ID",
            "sentence.bulk-read-broadcast-id/shown",
            no_bulk_read,
        ),
    ),
    on(
        XM430,
        hearing(
            "bulk-read-of-others",
            "answers a Bulk Read that does not name it",
            "several.bulk-read.not-named/silence",
            |heard| with_params(heard, BULK_READ, |params| params[0] = 1),
        ),
    ),
    on(
        XM430,
        hearing(
            "bulk-read-length-other",
            "takes another length in a Bulk Read",
            "sentence.bulk-read-parameters/shown",
            |heard| with_params(heard, BULK_READ, |params| params[3] += 1),
        ),
    ),
    on(
        TWO_XM430,
        hearing(
            "bulk-read-by-id",
            "answers a Bulk Read by falling ID",
            "several.bulk-read.first-of-two/order",
            |heard| with_params(heard, BULK_READ, |params| params.rotate_left(5)),
        ),
    ),
    on(
        XM430,
        answering(
            "bulk-write-answered",
            "answers a Bulk Write",
            "written.bulk-write.answer/silence",
            |asked, answer| {
                if of(asked, BULK_WRITE) { frame(1, &[0x55, 0]) } else { answer }
            },
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
                if of(&heard, ACTION) { packet(0x03, &[65, 0, 0]) } else { heard }
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

/// The address of Movement Duration in the JA variant.
const MOVEMENT: u16 = 522;

const SHORT: Answers = |asked, answer| {
    raw(asked, answer, |answer| {
        answer.remove(0);
    })
};
const RESERVED: Answers = |asked, answer| raw(asked, answer, |answer| answer[3] = 1);
const LONG: Answers = |asked, answer| raw(asked, answer, |answer| answer[5] += 1);
const SWAPPED: Answers = |asked, answer| raw(asked, answer, |answer| answer.swap(5, 6));
const OF_DATA: Answers = |asked, answer| raw(asked, answer, |answer| answer[5] -= 2);
const ERROR_LAST: Answers =
    |asked, answer| raw(asked, answer, |answer| answer[8..12].rotate_left(1));
const AS_ALL: Answers = |asked, answer| raw(asked, answer, |answer| answer[4] = 254);
const AS_ASKED: Answers = |asked, answer| raw(asked, answer, |answer| answer[7] = PING);
const BIT_6: Answers = |asked, answer| raw(asked, answer, |answer| answer[8] |= 0x40);
const DONE_IS_1: Answers = |asked, answer| raw(asked, answer, |answer| answer[8] = 1);
const WANTS_DATA: Answers = |asked, answer| failed(asked, answer, PING, 5);

/// A fault in what answers a Ping.
const fn ping(
    name: &'static str,
    does: &'static str,
    found_by: &'static str,
    answers: Answers,
) -> Fault {
    answering(name, does, found_by, answers)
}

fn of(asked: &[u8], code: u8) -> bool {
    instruction(asked) == Some(code)
}

/// Changes the bytes of the answer to a Ping, and makes the CRC fit. The first one is right: without it no check is
/// asked.
fn raw(asked: &[u8], mut answer: Vec<u8>, change: fn(&mut Vec<u8>)) -> Vec<u8> {
    let right = answer.clone();
    answer = bare(asked, answer, change);
    if answer != right {
        repair(&mut answer);
    }
    answer
}

/// The same without another CRC.
fn bare(asked: &[u8], mut answer: Vec<u8>, change: fn(&mut Vec<u8>)) -> Vec<u8> {
    static WAS_FOUND: AtomicBool = AtomicBool::new(false);
    let is_it = of(asked, PING) && answer.len() == 14 && asked[4] == 1;
    if is_it && WAS_FOUND.swap(true, Ordering::Relaxed) {
        change(&mut answer);
    }
    answer
}

/// The same for the answer to a Fast Sync Read.
fn fast(asked: &[u8], mut answer: Vec<u8>, change: fn(&mut Vec<u8>)) -> Vec<u8> {
    if of(asked, FAST_SYNC_READ) && !answer.is_empty() {
        change(&mut answer);
        repair(&mut answer);
    }
    answer
}

/// Answers an instruction with an error and no data.
fn failed(asked: &[u8], answer: Vec<u8>, code: u8, number: u8) -> Vec<u8> {
    if !of(asked, code) {
        return answer;
    }
    each(answer, |_, error, data| {
        *error = number;
        data.clear();
    })
}

fn unknown(asked: &[u8], answer: Vec<u8>) -> Vec<u8> {
    failed(asked, answer, READ, 2)
}

fn twice(asked: &[u8], answer: Vec<u8>) -> Vec<u8> {
    if of(asked, READ) { [&answer[..], &answer].concat() } else { answer }
}

fn swapped_read(heard: Vec<u8>) -> Vec<u8> {
    with_params(heard, READ, |params| params.rotate_left(2))
}

fn to_all(asked: &[u8]) -> bool {
    of(asked, PING) && asked[4] == 254
}

fn silent_to_all(asked: &[u8], answer: Vec<u8>) -> Vec<u8> {
    if to_all(asked) { Vec::new() } else { answer }
}

fn is_stuffed(asked: &[u8]) -> bool {
    asked.windows(4).any(|bytes| bytes == [0xFF, 0xFF, 0xFD, 0xFD])
}

fn silent_to_stuffed(asked: &[u8], answer: Vec<u8>) -> Vec<u8> {
    if is_stuffed(asked) { Vec::new() } else { answer }
}

fn register_missing(asked: &[u8], answer: Vec<u8>, address: u16, size: u16) -> Vec<u8> {
    if read_of(asked) == Some((address, size)) { failed(asked, answer, READ, 7) } else { answer }
}

fn no_rate(asked: &[u8], answer: Vec<u8>) -> Vec<u8> {
    register_missing(asked, answer, 8, 1)
}

fn profile_2(asked: &[u8], answer: Vec<u8>) -> Vec<u8> {
    if read_of(asked) == Some((571, 1)) {
        each(answer, |_, _, data| data[0] = 0x20)
    } else {
        answer
    }
}

/// Answers a Write of these bytes with Data Range Error.
fn refuses(asked: &[u8], answer: Vec<u8>, address: u16, data: &[u8]) -> Vec<u8> {
    if asked.ends_with_write(address, data) {
        each(answer, |_, error, _| *error = 4)
    } else {
        answer
    }
}

fn pwm(asked: &[u8], answer: Vec<u8>) -> Vec<u8> {
    refuses(asked, answer, 36, &37_500_u16.to_le_bytes())
}

fn position(asked: &[u8], answer: Vec<u8>) -> Vec<u8> {
    refuses(asked, answer, 48, &i32::MAX.to_le_bytes())
}

fn gain(asked: &[u8], answer: Vec<u8>) -> Vec<u8> {
    refuses(asked, answer, 528, &[0xFF, 0x7F])
}

fn reset_data(asked: &[u8], answer: Vec<u8>) -> Vec<u8> {
    if of(asked, FACTORY_RESET) { each(answer, |_, _, data| data.push(0)) } else { answer }
}

fn no_bulk_read(asked: &[u8], answer: Vec<u8>) -> Vec<u8> {
    if of(asked, BULK_READ) { Vec::new() } else { answer }
}
