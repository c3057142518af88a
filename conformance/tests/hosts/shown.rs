//! The conversation that shows each fault.

use actucheck_spec::wire::dynamixel2::reference::repair;

use super::cases::Wrong::{self, Returns, Sends};
use super::cases::{Case, Step, fast, status, step};

const A: &[u8] = b"\xA6\x00\x00\x00";
const B: &[u8] = b"\xD0\x07\x00\x00";
/// What is stuffed.
const HEADER: &[u8] = b"\xFF\xFF\xFD\x00";
const BROADCAST: u8 = 254;
/// Data Range Error, and the alert bit.
const ERROR: u8 = 4;
const ALERT: u8 = 0x80;

/// Four bytes from 132 on.
fn read(id: u8) -> Step {
    step(id, 0x02, b"\x84\x00\x04\x00")
}

/// A Read of device 1 that hears A.
fn right() -> Step {
    read(1).hears(status(1, 0, A)).returns("1:a6000000")
}

fn write(id: u8, data: &[u8]) -> Step {
    step(id, 0x03, &[b"\x74\x00", data].concat())
}

fn write_right(data: &[u8]) -> Step {
    write(1, data).hears(status(1, 0, b"")).returns("1:")
}

fn write_to_all() -> Step {
    write(BROADCAST, A).returns("")
}

/// Four bytes from 132 on.
fn sync_read(ids: &[u8]) -> Step {
    step(BROADCAST, 0x82, &[b"\x84\x00\x04\x00", ids].concat())
}

fn sync_right() -> Step {
    let answers = [status(1, 0, A), status(2, 0, B)].concat();
    sync_read(&[1, 2]).hears(answers).returns("1:a6000000 2:d0070000")
}

fn one_missing() -> Step {
    sync_read(&[1, 2]).hears(status(2, 0, B)).returns("2:d0070000")
}

/// Of device 1 and 2.
fn bulk_read() -> Step {
    step(BROADCAST, 0x92, b"\x01\x84\x00\x04\x00\x02\x90\x00\x04\x00")
}

fn fast_read() -> Step {
    step(BROADCAST, 0x8A, b"\x84\x00\x04\x00\x01\x02")
}

/// An answer in two pieces, with a pause of a quarter of the limit.
fn split() -> Step {
    let answer = status(1, 0, A);
    read(1).hears(&answer[..9]).hears_after(50, &answer[9..]).returns("1:a6000000")
}

/// An answer after these bytes.
fn behind(noise: &[u8]) -> Step {
    read(1).hears([noise, &status(1, 0, A)].concat()).returns("1:a6000000")
}

/// An answer that has stuffing.
fn stuffed() -> Step {
    read(1).hears(status(1, 0, HEADER)).returns("1:fffffd00")
}

/// An answer whose last byte is another.
fn corrupt() -> Step {
    let mut answer = status(1, 0, A);
    *answer.last_mut().unwrap() ^= 1;
    read(1).hears(answer).returns("corrupt")
}

fn half() -> Step {
    read(1).hears(&status(1, 0, A)[..9]).returns("corrupt")
}

fn of(data: &[u8]) -> Step {
    read(1).hears(status(1, 0, data)).returns("corrupt")
}

const fn case(fault: &'static str, wrong: Wrong, steps: fn() -> Vec<Step>) -> Case {
    Case { fault, steps, wrong }
}

pub(crate) const CASES: &[Case] = &[
    case("no-stuffing", Sends, || vec![write_right(HEADER)]),
    case("stuffs-first-only", Sends, || vec![write_right(&HEADER.repeat(2))]),
    case("misses-third-ff", Sends, || vec![write_right(b"\xFF\xFF\xFF\xFD")]),
    case("length-before-stuffing", Sends, || vec![write_right(HEADER)]),
    case("crc-before-stuffing", Sends, || vec![write_right(HEADER)]),
    case("sends-length-high-byte-first", Sends, || vec![right()]),
    case("crc-of-body", Sends, || vec![right()]),
    case("bytes-before-request", Sends, || vec![right()]),
    case("write-address-high-byte-first", Sends, || vec![write_right(A)]),
    case("sync-write-first-data", Sends, || {
        vec![step(BROADCAST, 0x83, b"\x74\x00\x02\x00\x01\xAA\xBB\x02\xCC\xDD").returns("")]
    }),
    case("bulk-write-one-length", Sends, || {
        let params = b"\x01\x74\x00\x02\x00\xAA\xBB\x02\x80\x00\x01\x00\xCC";
        vec![step(BROADCAST, 0x93, params).returns("")]
    }),
    case("bulk-read-first-address", Sends, || vec![bulk_read()]),
    case("bulk-read-repeats", Sends, || {
        vec![step(BROADCAST, 0x92, b"\x01\x84\x00\x04\x00\x01\x90\x00\x04\x00").refused()]
    }),
    case("sync-to-first", Sends, || vec![sync_right()]),
    case("reg-write-as-write", Sends, || vec![step(1, 0x04, b"\x74\x00\xAA")]),
    case("action-to-all", Sends, || vec![step(1, 0x05, b"")]),
    case("factory-reset-all", Sends, || vec![step(1, 0x06, b"\x01")]),
    case("fast-write-as-write", Sends, || {
        let write = step(BROADCAST, 0x8B, b"\x74\x00\x01\x00\x01\xAA");
        vec![write.hears(fast(&[(1, b"")])).returns("1:")]
    }),
    case("reboot-not-sent", Sends, || vec![step(1, 0x08, b"")]),
    case("refuses-id-zero", Returns("refused"), || {
        vec![read(0).hears(status(0, 0, A)).returns("0:a6000000")]
    }),
    case("read-from-all", Sends, || vec![read(BROADCAST).refused()]),
    case("wrong-port", Sends, || vec![right()]),
    case("keeps-first-port", Returns("timeout"), || vec![right(), right().at_another_port()]),
    case("no-drain", Returns("1:a6000000"), || {
        let twice = status(1, 0, A).repeat(2);
        let next = read(1).hears(status(1, 0, B)).returns("1:d0070000");
        vec![read(1).hears(twice).returns("1:a6000000"), next]
    }),
    case("keeps-half", Returns("1:a6000000"), || {
        let rest = status(1, 0, A).split_off(9);
        vec![half(), read(1).hears([rest, status(1, 0, B)].concat()).returns("1:d0070000")]
    }),
    case("late-answer-for-next", Returns("1:a6000000"), || {
        let late = read(1).hears_after(300, status(1, 0, A)).returns("timeout");
        vec![late, read(1).hears(status(1, 0, B)).returns("1:d0070000").after(200)]
    }),
    case("drains-after-sending", Returns("timeout"), || vec![right()]),
    case("floods", Sends, || vec![right()]),
    case("chunks-not-joined", Returns("corrupt"), || vec![split()]),
    case("drops-rest-of-read", Returns("1:a6000000"), || vec![sync_right()]),
    case("gives-up-at-split", Returns("corrupt"), || vec![split()]),
    case("loses-packet-after-noise", Returns("timeout"), || vec![behind(b"\x00\x11")]),
    case("naive-header-search", Returns("corrupt"), || vec![behind(b"\xFF")]),
    case("any-reserved", Returns("1:a6000000"), || {
        let mut answer = status(1, 0, A);
        answer[3] = 1;
        repair(&mut answer);
        vec![read(1).hears(answer).returns("corrupt")]
    }),
    case("no-resync", Returns("corrupt"), || vec![behind(b"\xFF\xFF\xFD\x00\x01\x20\x00")]),
    case("fixed-size", Returns("corrupt"), || vec![stuffed()]),
    case("reads-length-high-byte-first", Returns("corrupt"), || vec![right()]),
    case("ignores-crc", Returns("1:a6000000"), || vec![corrupt()]),
    case("ignores-crc-without-data", Returns("1:"), || {
        let mut answer = status(1, 0, b"");
        *answer.last_mut().unwrap() ^= 1;
        vec![write(1, A).hears(answer).returns("corrupt")]
    }),
    case("unstuffs-before-crc", Returns("corrupt"), || vec![stuffed()]),
    case("no-unstuffing", Returns("corrupt"), || vec![stuffed()]),
    case("unstuffs-too-much", Returns("corrupt"), || {
        vec![read(1).hears(status(1, 0, b"\x01\xFD\xFD\x02")).returns("1:01fdfd02")]
    }),
    case("dies-of-long-length", Returns("dies"), || vec![behind(b"\xFF\xFF\xFD\x00\x01\x00\x03")]),
    case("spins-on-length-zero", Returns("hangs"), || {
        vec![behind(b"\xFF\xFF\xFD\x00\x01\x00\x00")]
    }),
    case("any-id", Returns("1:a6000000"), || vec![read(1).hears(status(2, 0, A))]),
    case("instruction-as-status", Returns("1:02aabbcc"), || {
        let other = step(1, 0x03, b"\x00\x02\xAA\xBB\xCC");
        vec![read(1).hears(other.bytes())]
    }),
    case("echo-as-answer", Returns("1:84000400"), || vec![read(1).hears(read(1).bytes())]),
    case("expects-echo", Returns("corrupt"), || vec![right()]),
    case("action-answer-unread", Returns("1:"), || {
        let action = step(1, 0x05, b"").hears(status(1, 0, b"")).returns("1:");
        vec![action, write(1, A).hears(status(1, ERROR, b"")).returns("status").after(20)]
    }),
    case("waits-forever", Returns("hangs"), || vec![read(1)]),
    case("waits-forever-for-rest", Returns("hangs"), || vec![half()]),
    case("limit-restarts", Returns("hangs"), || {
        // A line that is silent is given up.
        vec![
            read(1),
            (0..500).fold(read(1).returns("corrupt"), |step, _| step.hears_after(10, b"\x00")),
        ]
    }),
    case("limit-too-short", Returns("corrupt"), || vec![split()]),
    case("waits-after-broadcast", Returns("timeout"), || vec![write_to_all()]),
    case("waits-forever-after-broadcast", Returns("hangs"), || vec![write_to_all()]),
    case("retries-once", Returns("1:a6000000"), || vec![read(1).hears_again(status(1, 0, A))]),
    case("retries-forever", Returns("hangs"), || vec![read(1)]),
    case("asks-while-listening", Sends, || vec![right()]),
    case("ignores-error", Returns("1:"), || {
        vec![write(1, A).hears(status(1, ERROR, b"")).returns("status")]
    }),
    case("alert-as-error", Returns("status"), || {
        vec![read(1).hears(status(1, ALERT, A)).returns("1:a6000000 alert")]
    }),
    case("drops-alert", Returns("1:a6000000"), || {
        vec![read(1).hears(status(1, ALERT, A)).returns("1:a6000000 alert")]
    }),
    case("error-byte-as-data", Returns("1:00a60000"), || vec![right()]),
    case("pads-with-zero", Returns("1:a6000000"), || vec![of(&A[..2])]),
    case("cuts-to-length", Returns("1:a6000000"), || vec![of(&[A, A].concat())]),
    case("panics-on-short", Returns("dies"), || vec![of(&A[..2])]),
    case("signed-bytes", Returns("1:a6ffffff"), || vec![right()]),
    case("high-byte-first", Returns("1:000000a6"), || vec![right()]),
    case("zero-is-no-value", Returns("timeout"), || {
        vec![read(1).hears(status(1, 0, &[0; 4])).returns("1:00000000")]
    }),
    case("model-high-byte-first", Returns("1:model 1540 version 38"), || {
        let answer = status(1, 0, b"\x06\x04\x26");
        vec![step(1, 0x01, b"").hears(answer).returns("1:model 1030 version 38")]
    }),
    case("last-good-on-timeout", Returns("1:a6000000"), || vec![right(), read(1)]),
    case("zero-on-timeout", Returns("1:00000000"), || vec![read(1)]),
    case("silence-is-success", Returns("1:"), || vec![write(1, A)]),
    case("stale-values", Returns("1:a6000000"), || {
        vec![right(), read(1).hears(status(1, 0, B)).returns("1:d0070000")]
    }),
    case("unhandled-corrupt", Returns("internal"), || vec![corrupt()]),
    case("stuck-after-corrupt", Returns("port"), || vec![corrupt(), right()]),
    case("busy-after-timeout", Returns("port"), || vec![read(1), right()]),
    case("ping-first-only", Returns("1:model 1030 version 38"), || {
        let answers = [1, 2].map(|id| status(id, 0, b"\x06\x04\x26")).concat();
        let both = "1:model 1030 version 38 2:model 1030 version 38";
        vec![step(BROADCAST, 0x01, b"").hears(answers).returns(both)]
    }),
    case("sync-by-position", Returns("1:d0070000 2:a6000000"), || {
        let answers = [status(2, 0, B), status(1, 0, A)].concat();
        vec![sync_read(&[1, 2]).hears(answers).returns("1:a6000000 2:d0070000")]
    }),
    case("bulk-by-position", Returns("1:d0070000 2:a6000000"), || {
        let answers = [status(2, 0, B), status(1, 0, A)].concat();
        vec![bulk_read().hears(answers).returns("1:a6000000 2:d0070000")]
    }),
    case("bulk-read-one-length", Returns("1:a6000000"), || {
        let answers = [status(1, 0, A), status(2, 0, b"\x07")].concat();
        let read = step(BROADCAST, 0x92, b"\x01\x84\x00\x04\x00\x02\x90\x00\x01\x00");
        vec![read.hears(answers).returns("1:a6000000 2:07")]
    }),
    case("missing-is-zero", Returns("2:d0070000 1:00000000"), || vec![one_missing()]),
    case("missing-is-stale", Returns("2:d0070000 1:a6000000"), || {
        vec![sync_right(), one_missing()]
    }),
    case("stops-at-missing", Returns("1:a6000000"), || {
        let answers = [status(1, 0, A), status(3, 0, B)].concat();
        vec![sync_read(&[1, 2, 3]).hears(answers).returns("1:a6000000 3:d0070000")]
    }),
    case("sync-any-id", Returns("1:a6000000 2:d0070000 3:a6000000"), || {
        let answers = [status(1, 0, A), status(3, 0, A), status(2, 0, B)].concat();
        vec![sync_read(&[1, 2]).hears(answers).returns("1:a6000000 2:d0070000")]
    }),
    case("sync-aliases-last", Returns("1:d0070000 2:d0070000"), || vec![sync_right()]),
    case("sync-drops-error", Returns("1:a6000000"), || {
        let answers = [status(1, 0, A), status(2, ERROR, b"")].concat();
        vec![sync_read(&[1, 2]).hears(answers).returns("1:a6000000 2:error 4")]
    }),
    case("fast-drops-error", Returns("1:a6000000 2:d0070000"), || {
        // The error of the second block.
        let mut answer = fast(&[(1, A), (2, B)]);
        answer[16] = ERROR;
        repair(&mut answer);
        vec![fast_read().hears(answer).returns("1:a6000000 2:error 4")]
    }),
    case("sync-error-fails-all", Returns("status"), || {
        let answers = [status(1, 0, A), status(2, ERROR, b"")].concat();
        vec![sync_read(&[1, 2]).hears(answers).returns("1:a6000000 2:error 4")]
    }),
    case("fast-by-position", Returns("1:d0070000 2:a6000000"), || {
        vec![fast_read().hears(fast(&[(2, B), (1, A)])).returns("corrupt")]
    }),
    case("fast-last-crc-only", Returns("1:a7000000 2:d0070000"), || {
        let mut answer = fast(&[(1, A), (2, B)]);
        answer[10] ^= 1;
        repair(&mut answer);
        vec![fast_read().hears(answer).returns("corrupt")]
    }),
    case("fast-unstuffs", Returns("corrupt"), || {
        let answer = fast(&[(1, b"\xFF\xFF\xFD\xFD"), (2, B)]);
        vec![fast_read().hears(answer).returns("1:fffffdfd 2:d0070000")]
    }),
];
