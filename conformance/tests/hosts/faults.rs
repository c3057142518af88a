//! What the host may do wrong, one fault a row. Most are bugs of published libraries.

/// What a run of the suite should come to with a fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Judged {
    /// It fails.
    Fails,
    /// It passes with a warning: the documents recommend another way.
    Warns,
    /// The documents leave it unspecified: it is recorded.
    Recorded,
    /// It is right.
    Passes,
}

pub(crate) struct Row {
    pub(crate) fault: Fault,
    pub(crate) name: &'static str,
    /// What the host does.
    pub(crate) does: &'static str,
    pub(crate) judged: Judged,
}

/// The fault that a host has, if any.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Switch(pub(crate) Option<Fault>);

impl Switch {
    /// The one with this name; `none` is none.
    pub(crate) fn named(name: &str) -> Option<Self> {
        let row = FAULTS.iter().find(|row| row.name == name);
        row.map(|row| Self(Some(row.fault))).or_else(|| (name == "none").then_some(Self(None)))
    }

    pub(crate) fn is(self, fault: Fault) -> bool {
        self.0 == Some(fault)
    }
}

macro_rules! faults {
    ($($fault:ident: $name:literal, $judged:ident, $does:literal;)*) => {
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(crate) enum Fault { $($fault,)* }

        pub(crate) const FAULTS: &[Row] = &[$(
            Row { fault: Fault::$fault, name: $name, does: $does, judged: Judged::$judged },
        )*];
    };
}

faults! {
    // The packet that it sends.
    NoStuffing: "no-stuffing", Fails, "sends FF FF FD as it is";
    LengthBeforeStuffing: "length-before-stuffing", Fails, "counts the bytes without stuffing in the length that it sends";
    CrcBeforeStuffing: "crc-before-stuffing", Fails, "computes the CRC that it sends before it stuffs";
    SendsLengthHighByteFirst: "sends-length-high-byte-first", Fails, "sends the high byte of the length first";
    CrcOfBody: "crc-of-body", Fails, "computes CRCs of the bytes after the length only";
    BytesBeforeRequest: "bytes-before-request", Fails, "sends FF FF before each request, to wake the line";
    WriteAddressHighByteFirst: "write-address-high-byte-first", Fails, "sends the high byte of a Write's address first";
    SyncWriteFirstData: "sync-write-first-data", Fails, "sends the first device's data to all devices of a Sync Write";
    BulkWriteOneLength: "bulk-write-one-length", Fails, "sends the first device's number of bytes for all devices of a Bulk Write";
    BulkReadFirstAddress: "bulk-read-first-address", Fails, "reads the first device's address from all devices of a Bulk Read";
    BulkReadRepeats: "bulk-read-repeats", Fails, "sends a Bulk Read that names a device twice";
    SyncToFirst: "sync-to-first", Fails, "sends a Sync Read to its first device instead of the broadcast ID";
    RegWriteAsWrite: "reg-write-as-write", Fails, "sends a Write for a Reg Write";
    ActionToAll: "action-to-all", Fails, "sends each Action to the broadcast ID";
    FactoryResetAll: "factory-reset-all", Fails, "sends the option that resets the ID too, whatever is asked for";
    RebootNotSent: "reboot-not-sent", Fails, "tells that a Reboot succeeded and sends nothing";
    RefusesIdZero: "refuses-id-zero", Fails, "takes ID 0 for a missing ID";
    ReadFromAll: "read-from-all", Recorded, "sends a Read to the broadcast ID and waits for the answer";
    // The port.
    WrongPort: "wrong-port", Fails, "reads from its port and writes to another";
    KeepsFirstPort: "keeps-first-port", Fails, "goes on with the port that it has when it should open another";
    NoDrain: "no-drain", Fails, "does not take away old input before a request";
    KeepsHalf: "keeps-half", Fails, "keeps half a packet for the next call";
    LateAnswerForNext: "late-answer-for-next", Fails, "takes what came after the limit for the next call's answer";
    DrainsAfterSending: "drains-after-sending", Fails, "takes input away after it has sent a request, and with it a quick answer";
    Floods: "floods", Fails, "sends each request a thousand times";
    // Packets in what it receives.
    ChunksNotJoined: "chunks-not-joined", Fails, "looks for packets in each read alone";
    DropsRestOfRead: "drops-rest-of-read", Fails, "takes one packet of a read and drops the rest";
    GivesUpAtSplit: "gives-up-at-split", Fails, "gives up if the first read holds no whole packet";
    LosesPacketAfterNoise: "loses-packet-after-noise", Fails, "drops all that it has if noise comes first";
    NaiveHeaderSearch: "naive-header-search", Fails, "begins the search for a header anew behind a byte that does not fit, and misses FF FF FF FD 00";
    AnyReserved: "any-reserved", Fails, "takes FF FF FD and any byte for a header";
    NoResync: "no-resync", Warns, "skips as many bytes as a false header's length says";
    FixedSize: "fixed-size", Fails, "reads as many bytes as it expects, whatever the length says";
    ReadsLengthHighByteFirst: "reads-length-high-byte-first", Fails, "takes the first byte of a length for the high one";
    IgnoresCrc: "ignores-crc", Fails, "takes packets with a wrong CRC";
    UnstuffsBeforeCrc: "unstuffs-before-crc", Fails, "computes the CRC of what it has unstuffed";
    NoUnstuffing: "no-unstuffing", Fails, "leaves the stuffing in the data";
    UnstuffsTooMuch: "unstuffs-too-much", Fails, "takes an FD away behind every FD";
    DiesOfLongLength: "dies-of-long-length", Fails, "writes over its buffer when a length is more than 256, and dies";
    SpinsOnLengthZero: "spins-on-length-zero", Fails, "loops for ever when a length is less than 3";
    // Whether a packet is the answer.
    AnyId: "any-id", Fails, "takes a status packet of any device";
    InstructionAsStatus: "instruction-as-status", Fails, "takes an instruction packet for a status packet";
    EchoAsAnswer: "echo-as-answer", Fails, "takes the echo of its request for the answer";
    ExpectsEcho: "expects-echo", Fails, "drops as many bytes as it has sent, whether there is an echo or not";
    ActionAnswerUnread: "action-answer-unread", Fails, "leaves the answer to an Action for the next call to find";
    // Time.
    WaitsForever: "waits-forever", Fails, "waits for an answer without a limit";
    WaitsForeverForRest: "waits-forever-for-rest", Fails, "waits without a limit for the rest of what has begun";
    LimitRestarts: "limit-restarts", Fails, "begins its limit anew with each byte";
    LimitTooShort: "limit-too-short", Fails, "waits a tenth of its limit";
    WaitsAfterBroadcast: "waits-after-broadcast", Fails, "waits to its limit for an answer to a broadcast write, and tells that none came";
    WaitsForeverAfterBroadcast: "waits-forever-after-broadcast", Fails, "waits for an answer to a broadcast write without a limit";
    RetriesOnce: "retries-once", Passes, "asks again once";
    RetriesForever: "retries-forever", Fails, "asks again until it is answered";
    AsksWhileListening: "asks-while-listening", Fails, "sends its request again while it waits for the answer";
    // What an answer says.
    IgnoresError: "ignores-error", Fails, "tells success whatever the error number is";
    AlertAsError: "alert-as-error", Fails, "takes the alert bit for part of the error number";
    DropsAlert: "drops-alert", Recorded, "does not tell the alert";
    ErrorByteAsData: "error-byte-as-data", Fails, "takes the error byte for the first byte of the data";
    PadsWithZero: "pads-with-zero", Fails, "adds zeros to fewer data than it asked for";
    CutsToLength: "cuts-to-length", Fails, "cuts off what is more than it asked for";
    PanicsOnShort: "panics-on-short", Fails, "reads behind the end of fewer data than it asked for, and dies";
    SignedBytes: "signed-bytes", Fails, "puts a number together of signed bytes, so that one from 80 on sets those above it";
    HighByteFirst: "high-byte-first", Fails, "takes the first byte of a value for the high one";
    ZeroIsNoValue: "zero-is-no-value", Fails, "takes a value of zero for a missing one";
    ModelHighByteFirst: "model-high-byte-first", Fails, "takes the first byte of a model number for the high one";
    LastGoodOnTimeout: "last-good-on-timeout", Fails, "returns the last good value if no answer comes";
    ZeroOnTimeout: "zero-on-timeout", Fails, "returns zero if no answer comes";
    SilenceIsSuccess: "silence-is-success", Fails, "tells that a write succeeded if no answer comes";
    StaleValues: "stale-values", Fails, "returns what the call before has read";
    UnhandledCorrupt: "unhandled-corrupt", Fails, "lets an exception out when an answer is corrupt";
    StuckAfterCorrupt: "stuck-after-corrupt", Fails, "fails in each call after a corrupt answer";
    BusyAfterTimeout: "busy-after-timeout", Fails, "takes the port for busy in each call after one without an answer";
    // Answers of several devices.
    PingFirstOnly: "ping-first-only", Fails, "returns the first answer to a Ping of all devices";
    SyncByPosition: "sync-by-position", Fails, "takes the answers to a Sync Read for those of its devices in their order";
    BulkByPosition: "bulk-by-position", Fails, "takes the answers to a Bulk Read for those of its devices in their order";
    BulkReadOneLength: "bulk-read-one-length", Fails, "takes only answers of the first device's size to a Bulk Read";
    StopsAtMissing: "stops-at-missing", Fails, "drops all devices' values behind one that does not answer";
    MissingIsZero: "missing-is-zero", Fails, "returns zero for a device that does not answer a Sync Read or a Bulk Read";
    MissingIsStale: "missing-is-stale", Fails, "returns the last value of a device that does not answer a Sync Read or a Bulk Read";
    SyncAnyId: "sync-any-id", Fails, "returns values of devices that it did not ask";
    SyncAliasesLast: "sync-aliases-last", Fails, "returns the last device's data for each device";
    SyncErrorFailsAll: "sync-error-fails-all", Recorded, "drops all devices' values if one tells an error";
    FastByPosition: "fast-by-position", Fails, "takes the blocks of a fast status packet for those of its devices in their order";
    FastLastCrcOnly: "fast-last-crc-only", Fails, "checks the last CRC of a fast status packet only";
    FastUnstuffs: "fast-unstuffs", Fails, "takes stuffing away from a fast status packet, which has none";
}
