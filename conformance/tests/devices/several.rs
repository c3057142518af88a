//! Faults of firmware in instructions for several devices.

use actucheck_spec::wire::dynamixel2::reference::frame;

use super::change::{is, repaired, silent, with_params};
use super::code::{BULK_READ, BULK_WRITE, FAST_SYNC_READ, FAST_SYNC_WRITE, SYNC_READ, SYNC_WRITE};
use super::fault::{Fault, answering, hearing, on};
use super::rewrite::after_first;

const XM430: &str = "xm430-w210@1";
const TWO: &str = "ja40@1 ja40@2";
const TWO_XM430: &str = "xm430-w210@1 xm430-w210@2";

/// The faults. `found_by` is a check's id after `dynamixel2.device.`.
pub(crate) const FAULTS: &[Fault] = &[
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
            |asked, answer| silent(asked, answer, SYNC_READ),
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
        |asked, answer| repaired(asked, answer, FAST_SYNC_READ, |answer| answer[4] = 1),
    ),
    answering(
        "fast-read-length",
        "leaves the CRC out of the length of a fast status packet",
        "sentence.fast-sync-read-length/shown",
        |asked, answer| repaired(asked, answer, FAST_SYNC_READ, |answer| answer[5] -= 2),
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
                if is(asked, BULK_WRITE) { frame(1, &[0x55, 0]) } else { answer }
            },
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

fn no_bulk_read(asked: &[u8], answer: Vec<u8>) -> Vec<u8> {
    silent(asked, answer, BULK_READ)
}
