//! Faults of firmware in packets as such: for each sentence that a check shows, one that the check finds.

use std::sync::atomic::{AtomicBool, Ordering};

use actucheck_spec::wire::dynamixel2::reference::repair;

use super::change::{each, failed, is, read_of, register_missing, with_params};
use super::code::{PING, READ};
use super::fault::{Answers, Fault, answering, hearing, on};

const XM430: &str = "xm430-w210@1";
const TWO: &str = "ja40@1 ja40@2";

/// The faults. `found_by` is a check's id after `dynamixel2.device.`.
pub(crate) const FAULTS: &[Fault] = &[
    // The packet that answers Ping.
    answering(
        "header-short",
        "leaves out the first FF",
        "sentence.packet-layout/shown",
        |asked, answer| {
            raw(asked, answer, |answer| {
                answer.remove(0);
            })
        },
    ),
    answering(
        "reserved-1",
        "sends 01 after the header",
        "sentence.packet-reserved/shown",
        |asked, answer| raw(asked, answer, |answer| answer[3] = 1),
    ),
    answering(
        "length-long",
        "sends a length that is too large",
        "sentence.length-value/shown",
        LONG,
    ),
    on(
        XM430,
        answering(
            "length-long-x",
            "sends a length that is too large",
            "sentence.packet-length/shown",
            LONG,
        ),
    ),
    answering(
        "length-high-first",
        "sends the high byte of a length first",
        "sentence.length-byte-order/shown",
        SWAPPED,
    ),
    on(
        XM430,
        answering(
            "length-high-first-x",
            "sends the high byte of a length first",
            "sentence.packet-length-byte-order/shown",
            SWAPPED,
        ),
    ),
    answering(
        "length-of-data",
        "counts only data and CRC in a length",
        "sentence.packet-length-status/shown",
        |asked, answer| raw(asked, answer, |answer| answer[5] -= 2),
    ),
    answering(
        "error-last",
        "sends the error behind the data",
        "sentence.status-packet-layout/shown",
        |asked, answer| raw(asked, answer, |answer| answer[8..12].rotate_left(1)),
    ),
    answering(
        "answers-as-all",
        "answers with ID 254",
        "sentence.status-packet-id/shown",
        |asked, answer| raw(asked, answer, |answer| answer[4] = 254),
    ),
    answering(
        "answers-as-asked",
        "answers with the instruction that it heard",
        "sentence.status-packet-instruction/shown",
        |asked, answer| raw(asked, answer, |answer| answer[7] = PING),
    ),
    answering(
        "error-bit-6",
        "sets bit 6 of the error",
        "sentence.status-packet-error/shown",
        BIT_6,
    ),
    on(
        XM430,
        answering(
            "error-bit-6-x",
            "sets bit 6 of the error",
            "sentence.status-packet-error-fields/shown",
            BIT_6,
        ),
    ),
    answering(
        "done-is-1",
        "has error 1 when all is well",
        "sentence.status-packet-error-none/shown",
        |asked, answer| raw(asked, answer, |answer| answer[8] = 1),
    ),
    answering(
        "ping-wants-data",
        "refuses a Ping without parameters",
        "sentence.ping-parameters/shown",
        |asked, answer| failed(asked, answer, PING, 5),
    ),
    answering("crc-other-seed", "has another CRC", "sentence.crc-value/shown", |asked, answer| {
        bare(asked, answer, |answer| answer[12] ^= 0x55)
    }),
    answering(
        "crc-high-first-of-ping",
        "sends the high byte of a CRC first",
        "sentence.crc-byte-order/shown",
        |asked, answer| bare(asked, answer, |answer| answer.swap(12, 13)),
    ),
    answering(
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
            if is(asked, READ) { each(answer, |_, _, data| data.reverse()) } else { answer }
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
            |asked, answer| register_missing(asked, answer, (132, 4)),
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
];

const LONG: Answers = |asked, answer| raw(asked, answer, |answer| answer[5] += 1);
const SWAPPED: Answers = |asked, answer| raw(asked, answer, |answer| answer.swap(5, 6));
const BIT_6: Answers = |asked, answer| raw(asked, answer, |answer| answer[8] |= 0x40);

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
    let is_it = is(asked, PING) && answer.len() == 14 && asked[4] == 1;
    if is_it && WAS_FOUND.swap(true, Ordering::Relaxed) {
        change(&mut answer);
    }
    answer
}

fn unknown(asked: &[u8], answer: Vec<u8>) -> Vec<u8> {
    failed(asked, answer, READ, 2)
}

fn twice(asked: &[u8], answer: Vec<u8>) -> Vec<u8> {
    if is(asked, READ) { [&answer[..], &answer].concat() } else { answer }
}

fn swapped_read(heard: Vec<u8>) -> Vec<u8> {
    with_params(heard, READ, |params| params.rotate_left(2))
}

fn to_all(asked: &[u8]) -> bool {
    is(asked, PING) && asked[4] == 254
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
