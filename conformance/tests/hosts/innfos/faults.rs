//! What the host may do wrong, one fault a row.

use crate::faults::Judged::{Fails, Passes, Recorded, Warns};
use crate::faults::faults;

/// The fault that a host has, if any.
pub(crate) type Switch = crate::faults::Switch<Fault>;

faults! {
    // The frame that it sends.
    SendsLengthLowByteFirst: "sends-length-low-byte-first", Fails("basic.2a/sent"), "sends the low byte of the length first";
    CrcHighByteFirst: "crc-high-byte-first", Fails("basic.61/sent"), "sends the high byte of CRC-16/MODBUS first";
    NoCrcForOneByte: "no-crc-for-one-byte", Fails("basic.2a/sent"), "sends no CRC with one byte of data";
    CrcWithoutData: "crc-without-data", Fails("basic.06/sent"), "sends a CRC without data too";
    CrcOfFrame: "crc-of-frame", Fails("basic.0a/sent"), "computes the CRC that it sends of all that comes before it";
    LowByteFirst: "low-byte-first", Fails("value.high-byte-first/sent"), "sends the low byte of a value first";
    ModeFromZero: "mode-from-zero", Fails("value.mode-1/sent"), "counts the modes that it sends from 0";
    ClampsPosition: "clamps-position", Fails("value.first-position/sent"), "sends no position below 0";
    SevenBitsOfAddress: "seven-bits-of-address", Fails("frame.address-ff/sent"), "sends seven bits of the address";
    TwoDatagrams: "two-datagrams", Fails("basic.06/sent"), "sends a byte more in a datagram of its own";
    GreetsOnlyInWords: "greets-only-in-words", Fails("basic.44/sent"), "tells that the board is there and does not ask it";
    Floods: "floods", Fails("basic.06/sent"), "sends each request a hundred times";
    AsksTwice: "asks-twice", Passes, "sends each request twice";
    ShowsLife: "shows-life", Passes, "asks for a sign of life before each request";
    // The port.
    NoDrain: "no-drain", Fails("read.doubled/next"), "does not take away old datagrams before a request";
    LateAnswerForNext: "late-answer-for-next", Fails("read.late/next"), "takes what came after the limit for the next call's answer";
    WaitsForever: "waits-forever", Fails("read.silence-after-right/result"), "waits for an answer without a limit";
    WaitsAfterSetpoint: "waits-after-setpoint", Fails("basic.0a/result"), "waits to its limit for an answer to a setpoint, and tells that none came";
    StuckAfterCorrupt: "stuck-after-corrupt", Fails("read.flip-00/next"), "fails in each call after what was no answer";
    GivesUpAtForeign: "gives-up-at-foreign", Passes, "gives up at the first frame that is not its answer";
    // Frames in what it receives.
    AnyHeader: "any-header", Fails("read.flip-00/result"), "takes any first byte";
    AnyEnd: "any-end", Fails("read.flip-11/result"), "takes any last byte";
    ReadsLengthLowByteFirst: "reads-length-low-byte-first", Fails("basic.06/result"), "takes the first byte of a length for the low one";
    FixedSize: "fixed-size", Fails("read.length-more/result"), "reads as many bytes as it expects, whatever the length says";
    EndsAtEndByte: "ends-at-end-byte", Fails("frame.end-in-answer/result"), "takes the first ED for the end";
    IgnoresCrc: "ignores-crc", Warns("read.flip-09/result"), "does not compare CRCs";
    TakesZeroCrc: "takes-zero-crc", Warns("read.zero-crc/result"), "takes zeros for any CRC";
    NeedsNoCrc: "needs-no-crc", Fails("read.without-crc/result"), "takes a frame without a CRC";
    CrcOfOneByte: "crc-of-one-byte", Fails("basic.2a/result"), "expects a CRC in an answer of one byte";
    DropsZeroCrc: "drops-zero-crc", Recorded, "drops an answer to the handshake with zeros for the CRC";
    FirstFrameOnly: "first-frame-only", Recorded, "reads the first frame of a datagram only";
    DiesOfMoreData: "dies-of-more-data", Fails("read.more-bytes/result"), "writes behind its buffer when there are more data than it expects, and dies";
    // Whether a frame is the answer.
    AnyAddress: "any-address", Fails("read.other-device/result"), "takes a frame of any actuator";
    AnyCommand: "any-command", Fails("read.other-command/result"), "takes a frame with any command";
    AnyWriteAddress: "any-write-address", Fails("no-success.2a/other-device"), "takes any actuator's answer to a write";
    // What an answer says.
    RefusalIsSuccess: "refusal-is-success", Fails("no-success.0e/refused"), "tells that a refused write succeeded";
    RefusalIsSilence: "refusal-is-silence", Warns("no-success.0e/refused"), "tells that a refused write was not answered";
    SilenceIsSuccess: "silence-is-success", Fails("write.wrong-end/result"), "tells that a write succeeded if no answer comes";
    PadsWithZero: "pads-with-zero", Fails("read.fewer-bytes/result"), "adds zeros to fewer data than it expects";
    CutsToSize: "cuts-to-size", Fails("read.more-bytes/result"), "cuts off what is more than it expects";
    HandsOnLowByteFirst: "hands-on-low-byte-first", Fails("value.is-high-byte-first/result"), "takes the first byte of a value for the low one";
    ZeroIsNoValue: "zero-is-no-value", Fails("frame.zeros/result"), "takes a value of zero for a missing one";
    NamedAlarmsOnly: "named-alarms-only", Fails("value.other-alarm/result"), "drops alarms without a name of their own";
    LastGoodOnTimeout: "last-good-on-timeout", Fails("read.silence-after-right/result"), "returns the last good value if no answer comes";
    StaleValues: "stale-values", Fails("read.other-command-before/next"), "returns what the call before has read";
    // The answers of several actuators.
    FirstFound: "first-found", Fails("query.two/result"), "ends the query at the first actuator";
    FindsAnything: "finds-anything", Fails("query.other-command/result"), "takes the data of any frame for an actuator's MAC address";
}
