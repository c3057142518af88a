//! Faults of firmware in packets that write to two devices that are both there.

use super::change::with_params;
use super::code::{BULK_WRITE, FAST_SYNC_WRITE, SYNC_WRITE};
use super::fault::{Fault, hearing, on};

const TWO: &str = "ja40@1 ja40@2";
const TWO_XM430: &str = "xm430-w210@1 xm430-w210@2";

/// The faults. `found_by` is a check's id after `dynamixel2.device.`.
pub(crate) const FAULTS: &[Fault] = &[
    on(
        TWO,
        hearing(
            "sync-write-last-of-two",
            "carries out only the last block of a Sync Write that names its neighbour",
            "written.sync-write.first-of-two/data",
            |heard| {
                of_two(heard, SYNC_WRITE, |params| {
                    params.drain(4..7);
                })
            },
        ),
    ),
    on(
        TWO_XM430,
        hearing(
            "sync-write-of-its-neighbour",
            "writes to itself what a Sync Write has for its neighbour",
            "written.sync-write.first-of-two/data",
            |heard| {
                of_two(heard, SYNC_WRITE, |params| {
                    if params[4] == 1 {
                        params.copy_within(8..10, 5);
                    }
                })
            },
        ),
    ),
    on(
        TWO,
        hearing(
            "sync-write-by-id",
            "takes the data of a Sync Write by rising ID",
            "written.sync-write.second-of-two/data",
            |heard| {
                of_two(heard, SYNC_WRITE, |params| {
                    if params[4] > params[7] {
                        params.swap(4, 7);
                    }
                })
            },
        ),
    ),
    on(
        TWO,
        hearing(
            "fast-sync-write-of-the-last",
            "takes the last data of a Fast Sync Write that names its neighbour",
            "written.fast-sync-write.first-of-two/data",
            |heard| of_two(heard, FAST_SYNC_WRITE, |params| params.copy_within(8..10, 5)),
        ),
    ),
    on(
        TWO,
        hearing(
            "fast-sync-write-of-the-first",
            "takes the first data of a Fast Sync Write that names its neighbour",
            "written.fast-sync-write.second-of-two/data",
            |heard| of_two(heard, FAST_SYNC_WRITE, |params| params.copy_within(5..7, 8)),
        ),
    ),
    on(
        TWO_XM430,
        hearing(
            "bulk-write-of-one-length",
            "ends a Bulk Write at a block of another length",
            "written.bulk-write.first-of-two/data",
            |heard| {
                with_params(heard, BULK_WRITE, |params| {
                    let size = usize::from(params[3]);
                    if params.get(5 + size + 3).is_some_and(|next| usize::from(*next) != size) {
                        params.truncate(5 + size);
                    }
                })
            },
        ),
    ),
    on(
        TWO_XM430,
        hearing(
            "bulk-write-after-its-neighbour",
            "ignores what a Bulk Write has after its neighbour's block",
            "written.bulk-write.second-of-two/data",
            |heard| {
                with_params(heard, BULK_WRITE, |params| {
                    if params[0] == 2 {
                        params.truncate(5 + usize::from(params[3]));
                    }
                })
            },
        ),
    ),
];

/// Changes an instruction that has two bytes for each of the devices that are there.
fn of_two(heard: Vec<u8>, code: u8, change: fn(&mut Vec<u8>)) -> Vec<u8> {
    with_params(heard, code, |params| {
        if params.len() == 10 && params[4] + params[7] == 3 && params[4] * params[7] == 2 {
            change(params);
        }
    })
}
