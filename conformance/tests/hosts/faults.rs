//! What the host may do wrong, one fault a row. Most are bugs of published libraries.

/// What a run of the suite should come to with a fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Judged {
    /// This check fails, among others.
    Fails(&'static str),
    /// This check warns: the documents recommend another way.
    Warns(&'static str),
    /// The documents leave it unspecified: it is recorded.
    Recorded,
    /// It is right.
    Passes,
    /// The check of adapters finds it, at this point.
    Unfit(&'static str),
}

pub(crate) struct Row<F = Fault> {
    pub(crate) fault: F,
    pub(crate) name: &'static str,
    /// What the host does.
    pub(crate) does: &'static str,
    pub(crate) judged: Judged,
}

/// The fault that a host has, if any.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Switch<F = Fault>(pub(crate) Option<F>);

impl<F: Copy + PartialEq> Switch<F> {
    /// The one with this name in a table; `none` is none.
    pub(crate) fn named(table: &[Row<F>], name: &str) -> Option<Self> {
        let row = table.iter().find(|row| row.name == name);
        row.map(|row| Self(Some(row.fault))).or_else(|| (name == "none").then_some(Self(None)))
    }

    pub(crate) fn is(self, fault: F) -> bool {
        self.0 == Some(fault)
    }
}

use Judged::{Fails, Passes, Recorded, Unfit, Warns};

macro_rules! faults {
    ($($fault:ident: $name:literal, $judged:expr, $does:literal;)*) => {
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(crate) enum Fault { $($fault,)* }

        pub(crate) const FAULTS: &[$crate::faults::Row<Fault>] = &[$(
            $crate::faults::Row { fault: Fault::$fault, name: $name, does: $does, judged: $judged },
        )*];
    };
}

pub(crate) use faults;

faults! {
    // The packet that it sends.
    NoStuffing: "no-stuffing", Fails("call.write.stuffed/sent"), "sends FF FF FD as it is";
    StuffsFirstOnly: "stuffs-first-only", Fails("said.stuffing.length/sent"), "stuffs the first FF FF FD only";
    MissesThirdFf: "misses-third-ff", Fails("vector.dynamixel2.stuffing.three-ff/sent"), "does not stuff FF FF FD behind another FF";
    LengthBeforeStuffing: "length-before-stuffing", Fails("call.write.stuffed/sent"), "counts the bytes without stuffing in the length that it sends";
    CrcBeforeStuffing: "crc-before-stuffing", Fails("call.write.stuffed/sent"), "computes the CRC that it sends before it stuffs";
    SendsLengthHighByteFirst: "sends-length-high-byte-first", Fails("read.error-1/result"), "sends the high byte of the length first";
    CrcOfBody: "crc-of-body", Fails("read.error-1/result"), "computes CRCs of the bytes after the length only";
    BytesBeforeRequest: "bytes-before-request", Fails("basic.ping/sent"), "sends FF FF before each request, to wake the line";
    WriteAddressHighByteFirst: "write-address-high-byte-first", Fails("write.error-1/result"), "sends the high byte of a Write's address first";
    SyncWriteFirstData: "sync-write-first-data", Fails("basic.sync-write/result"), "sends the first device's data to all devices of a Sync Write";
    BulkWriteOneLength: "bulk-write-one-length", Fails("call.bulk-write.own-registers/sent"), "sends the first device's number of bytes for all devices of a Bulk Write";
    BulkReadFirstAddress: "bulk-read-first-address", Fails("call.bulk-read.own-registers/sent"), "reads the first device's address from all devices of a Bulk Read";
    BulkReadRepeats: "bulk-read-repeats", Fails("call.bulk-read.repeat/sent"), "sends a Bulk Read that names a device twice";
    SyncToFirst: "sync-to-first", Fails("basic.sync-read/sent"), "sends a Sync Read to its first device instead of the broadcast ID";
    RegWriteAsWrite: "reg-write-as-write", Fails("basic.reg-write/sent"), "sends a Write for a Reg Write";
    ActionToAll: "action-to-all", Fails("basic.action/sent"), "sends each Action to the broadcast ID";
    FactoryResetAll: "factory-reset-all", Fails("basic.factory-reset/sent"), "sends the option that resets the ID too, whatever is asked for";
    FastWriteAsWrite: "fast-write-as-write", Fails("basic.fast-sync-write/sent"), "sends a Sync Write for a Fast Sync Write";
    RebootNotSent: "reboot-not-sent", Fails("basic.reboot/sent"), "tells that a Reboot succeeded and sends nothing";
    RefusesIdZero: "refuses-id-zero", Fails("call.read.id-0/result"), "takes ID 0 for a missing ID";
    ReadFromAll: "read-from-all", Recorded, "sends a Read to the broadcast ID and waits for the answer";
    // The port.
    WrongPort: "wrong-port", Fails("read.error-1/result"), "reads from its port and writes to another";
    KeepsFirstPort: "keeps-first-port", Unfit("makes its calls through the port that it opened last"), "goes on with the port that it has when it should open another";
    NoDrain: "no-drain", Fails("read.doubled/next"), "does not take away old input before a request";
    KeepsHalf: "keeps-half", Fails("read.doubled/next"), "keeps half a packet for the next call";
    LateAnswerForNext: "late-answer-for-next", Fails("read.late/next"), "takes what came after the limit for the next call's answer";
    DrainsAfterSending: "drains-after-sending", Fails("basic.clear/result"), "takes input away after it has sent a request, and with it a quick answer";
    Floods: "floods", Fails("basic.ping/sent"), "sends each request a thousand times";
    // Packets in what it receives.
    ChunksNotJoined: "chunks-not-joined", Fails("read.split-01/result"), "looks for packets in each read alone";
    DropsRestOfRead: "drops-rest-of-read", Fails("bulk-read.first-missing/result"), "takes one packet of a read and drops the rest";
    GivesUpAtSplit: "gives-up-at-split", Fails("read.split-01/result"), "gives up if the first read holds no whole packet";
    LosesPacketAfterNoise: "loses-packet-after-noise", Fails("read.noise-before/result"), "drops all that it has if noise comes first";
    NaiveHeaderSearch: "naive-header-search", Fails("read.noise-like-header-before/result"), "begins the search for a header anew behind a byte that does not fit, and misses FF FF FF FD 00";
    AnyReserved: "any-reserved", Fails("read.other-reserved/result"), "takes FF FF FD and any byte for a header";
    NoResync: "no-resync", Warns("read.false-header-before/result"), "skips as many bytes as a false header's length says";
    FixedSize: "fixed-size", Fails("read.length-0/result"), "reads as many bytes as it expects, whatever the length says";
    ReadsLengthHighByteFirst: "reads-length-high-byte-first", Fails("basic.reg-write/result"), "takes the first byte of a length for the high one";
    IgnoresCrc: "ignores-crc", Fails("read.flip-09/result"), "takes packets with a wrong CRC";
    IgnoresCrcWithoutData: "ignores-crc-without-data", Fails("write.flip-10/result"), "takes answers without data whose CRC is wrong";
    UnstuffsBeforeCrc: "unstuffs-before-crc", Fails("call.read.stuffed/result"), "computes the CRC of what it has unstuffed";
    NoUnstuffing: "no-unstuffing", Fails("call.read.stuffed/result"), "leaves the stuffing in the data";
    UnstuffsTooMuch: "unstuffs-too-much", Fails("call.read.like-stuffing/result"), "takes an FD away behind every FD";
    DiesOfLongLength: "dies-of-long-length", Fails("read.false-header-before/result"), "writes over its buffer when a length is more than 256, and dies";
    SpinsOnLengthZero: "spins-on-length-zero", Fails("read.length-0/next"), "loops for ever when a length is less than 3";
    // Whether a packet is the answer.
    AnyId: "any-id", Fails("read.other-device/result"), "takes a status packet of any device";
    InstructionAsStatus: "instruction-as-status", Fails("read.instruction-packet/result"), "takes an instruction packet for a status packet";
    EchoAsAnswer: "echo-as-answer", Fails("read.echo/result"), "takes the echo of its request for the answer";
    ExpectsEcho: "expects-echo", Fails("basic.reg-write/result"), "drops as many bytes as it has sent, whether there is an echo or not";
    ActionAnswerUnread: "action-answer-unread", Fails("after.action/read"), "leaves the answer to an Action for the next call to find";
    // Time.
    WaitsForever: "waits-forever", Fails("read.flip-00/next"), "waits for an answer without a limit";
    WaitsForeverForRest: "waits-forever-for-rest", Fails("read.flip-00/next"), "waits without a limit for the rest of what has begun";
    LimitRestarts: "limit-restarts", Fails("read.drip/result"), "begins its limit anew with each byte";
    LimitTooShort: "limit-too-short", Fails("after.ping/read"), "waits a tenth of its limit";
    WaitsAfterBroadcast: "waits-after-broadcast", Fails("basic.bulk-write/result"), "waits to its limit for an answer to a broadcast write, and tells that none came";
    WaitsForeverAfterBroadcast: "waits-forever-after-broadcast", Fails("basic.bulk-write/result"), "waits for an answer to a broadcast write without a limit";
    RetriesOnce: "retries-once", Passes, "asks again once";
    RetriesForever: "retries-forever", Fails("write.silence/result"), "asks again until it is answered";
    AsksWhileListening: "asks-while-listening", Fails("after.reboot/read"), "sends its request again while it waits for the answer";
    // What an answer says.
    IgnoresError: "ignores-error", Fails("write.error-1/result"), "tells success whatever the error number is";
    AlertAsError: "alert-as-error", Recorded, "takes the alert bit for part of the error number";
    DropsAlert: "drops-alert", Recorded, "does not tell the alert";
    ErrorByteAsData: "error-byte-as-data", Fails("read.alert/result"), "takes the error byte for the first byte of the data";
    PadsWithZero: "pads-with-zero", Fails("read.fewer-bytes/result"), "adds zeros to fewer data than it asked for";
    CutsToLength: "cuts-to-length", Fails("read.more-bytes/result"), "cuts off what is more than it asked for";
    PanicsOnShort: "panics-on-short", Fails("read.fewer-bytes/result"), "reads behind the end of fewer data than it asked for, and dies";
    SignedBytes: "signed-bytes", Fails("read.alert/result"), "puts a number together of signed bytes, so that one from 80 on sets those above it";
    HighByteFirst: "high-byte-first", Fails("read.alert/result"), "takes the first byte of a value for the high one";
    ZeroIsNoValue: "zero-is-no-value", Fails("call.read.zeros/result"), "takes a value of zero for a missing one";
    ModelHighByteFirst: "model-high-byte-first", Fails("basic.ping/result"), "takes the first byte of a model number for the high one";
    LastGoodOnTimeout: "last-good-on-timeout", Fails("read.silence-after-right/result"), "returns the last good value if no answer comes";
    ZeroOnTimeout: "zero-on-timeout", Fails("read.late/result"), "returns zero if no answer comes";
    SilenceIsSuccess: "silence-is-success", Fails("write.other-device/result"), "tells that a write succeeded if no answer comes";
    StaleValues: "stale-values", Fails("read.split-01/next"), "returns what the call before has read";
    UnhandledCorrupt: "unhandled-corrupt", Fails("read.flip-05/next"), "lets an exception out when an answer is corrupt";
    StuckAfterCorrupt: "stuck-after-corrupt", Fails("read.more-bytes/next"), "fails in each call after a corrupt answer";
    BusyAfterTimeout: "busy-after-timeout", Fails("read.late/next"), "takes the port for busy in each call after one without an answer";
    // Answers of several devices.
    PingFirstOnly: "ping-first-only", Fails("call.ping.broadcast/result"), "returns the first answer to a Ping of all devices";
    SyncByPosition: "sync-by-position", Fails("sync-read.swapped/result"), "takes the answers to a Sync Read for those of its devices in their order";
    BulkByPosition: "bulk-by-position", Fails("bulk-read.swapped/result"), "takes the answers to a Bulk Read for those of its devices in their order";
    BulkReadOneLength: "bulk-read-one-length", Fails("call.bulk-read.own-registers/result"), "takes only answers of the first device's size to a Bulk Read";
    StopsAtMissing: "stops-at-missing", Fails("bulk-read.second-missing/result"), "drops all devices' values behind one that does not answer";
    MissingIsZero: "missing-is-zero", Fails("bulk-read.first-missing/result"), "returns zero for a device that does not answer a Sync Read or a Bulk Read";
    MissingIsStale: "missing-is-stale", Fails("bulk-read.missing-after-right/result"), "returns the last value of a device that does not answer a Sync Read or a Bulk Read";
    SyncAnyId: "sync-any-id", Fails("sync-read.uninvited/result"), "returns values of devices that it did not ask";
    SyncAliasesLast: "sync-aliases-last", Fails("bulk-read.swapped/result"), "returns the last device's data for each device";
    SyncDropsError: "sync-drops-error", Fails("bulk-read.error-of-second/result"), "leaves a device out that answers a Sync Read or a Bulk Read with an error, and tells no error";
    FastDropsError: "fast-drops-error", Fails("fast-sync-read.error-of-second/result"), "returns the data of a block of a fast status packet that tells an error";
    SyncErrorFailsAll: "sync-error-fails-all", Recorded, "drops all devices' values if one tells an error";
    FastByPosition: "fast-by-position", Fails("fast-sync-read.swapped/result"), "takes the blocks of a fast status packet for those of its devices in their order";
    FastLastCrcOnly: "fast-last-crc-only", Fails("fast-sync-read.first-crc/result"), "checks the last CRC of a fast status packet only";
    FastUnstuffs: "fast-unstuffs", Fails("fast-sync-read.pattern/result"), "takes stuffing away from a fast status packet, which has none";
}
