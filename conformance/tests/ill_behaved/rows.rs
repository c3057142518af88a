//! The ways to misbehave, and what each may cost.

use std::ops::RangeInclusive;

/// A way to misbehave, and the run that it leads to.
pub(crate) struct Row {
    pub(crate) name: &'static str,
    /// The adapter's mode, and when it misbehaves.
    pub(crate) adapter: &'static str,
    /// Which checks are asked; all of them if it is empty.
    pub(crate) select: &'static [&'static str],
    pub(crate) exit: i32,
    /// What comes out besides what a well-behaved adapter gets: each verdict after its count, or after
    /// the least and the greatest count.
    pub(crate) verdicts: &'static str,
    /// The time limit of a request, in seconds.
    pub(crate) timeout: &'static str,
    /// At most so long, in seconds.
    pub(crate) seconds: f64,
    /// At most so much memory.
    pub(crate) megabytes: u64,
}

impl Row {
    /// How often the row has a verdict; `None` if it does not name it.
    pub(crate) fn counts(&self, verdict: &str) -> Option<RangeInclusive<u64>> {
        let named = self.verdicts.split(", ").find_map(|named| {
            let (counts, named) = named.split_once(' ')?;
            (named == verdict).then_some(counts)
        });
        let (least, most) = named?.split_once('-').unwrap_or((named?, named?));
        Some(least.parse().unwrap()..=most.parse().unwrap())
    }

    /// The same for an adapter of which the suite awaits that nothing comes.
    const fn silent(self) -> Self {
        Self { timeout: "1", ..self }
    }
}

/// Checks of every op on both wires. Three ask for a CRC.
const FEW: &[&str] = &["ja40.ping.*", "innfos.handshake.request/*", "innfos.handshake.reply/*"];
/// Four of the longest packets, and a hundred others.
const LONG: &[&str] = &["dynamixel2.limit.length-field.*", "dynamixel2.length.*"];
/// 160 checks of short packets.
const SHORT: &[&str] = &["dynamixel2.id.[1234]?.*"];
/// Three packets to build.
const THREE: &[&str] = &["dynamixel2.id.1[012].ping/encode"];
/// About a thousand checks.
const IDS: &[&str] = &["dynamixel2.id.*"];
/// Ten thousand checks.
const GENERATED: &[&str] = &["dynamixel2.seed-1.*"];
const ALL: &[&str] = &[];

/// What most runs take. The program itself takes a fifth of this, mostly for the checks.
const MEMORY: u64 = 100;

/// A run with so much time for a request that a busy machine changes nothing.
const fn row(
    name: &'static str,
    adapter: &'static str,
    select: &'static [&'static str],
    exit: i32,
    verdicts: &'static str,
) -> Row {
    Row { name, adapter, select, exit, verdicts, timeout: "20", seconds: 60.0, megabytes: MEMORY }
}

pub(crate) const ROWS: &[Row] = &[
    row("well behaved", "well never", FEW, 0, ""),
    row("hangs", "hangs crc", FEW, 1, "3 timeout").silent(),
    row("spins", "spins crc", FEW, 1, "3 timeout").silent(),
    row("stops reading", "stops-reading long", LONG, 1, "4 timeout").silent(),
    row("half a line", "half-a-line crc", FEW, 1, "3 timeout").silent(),
    row("100 MB without a line end", "no-line-end crc", FEW, 3, "3 adapter-fault"),
    row("no UTF-8", "no-utf-8 crc", FEW, 3, "3 adapter-fault"),
    row("blank lines before replies", "blank-lines crc", FEW, 3, "3 adapter-fault"),
    row("answers twice", "twice crc", FEW, 1, "3 flaky"),
    row("out of order, as it may", "out-of-order always", IDS, 0, ""),
    row("another request's id", "wrong-id crc", FEW, 3, "3 adapter-fault"),
    row("closes its output and lives", "closes-its-output crc", FEW, 1, "3 crash"),
    row("ends after each request", "ends-after always", FEW, 1, "1-20 flaky"),
    row("aborts", "aborts crc", FEW, 1, "3 crash"),
    // Those of every ID, and four that are generated.
    row("aborts on Pings to eleven", "aborts eleven", ALL, 1, "15 crash"),
    row("hangs every thousandth time", "hangs thousandth", IDS, 1, "1 flaky").silent(),
    row("wrong every thousandth time", "wrong thousandth", GENERATED, 1, "8-10 flaky"),
    row("leaves a child", "leaves-a-child crc", FEW, 0, ""),
    row("leaves a child with setsid", "leaves-a-session crc", FEW, 0, ""),
    row("dies, its child lives", "dies-with-a-child crc", FEW, 1, "3 crash"),
    row("as before, with setsid", "dies-with-a-session crc", FEW, 1, "3 crash"),
    row("floods its log", "floods-its-log crc", FEW, 0, ""),
    row("details of 1 MB", "long-detail always", SHORT, 1, "160 fail"),
    // To read one of them takes 70 MB for a moment; two more that are kept would be too much.
    Row { megabytes: 80, ..row("answers 7 MB too long", "long-answer encode", THREE, 1, "3 fail") },
    row("uppercase hex", "uppercase encode", FEW, 3, "4 adapter-fault"),
    row("controls in every string", "controls always", FEW, 1, "3 adapter-fault, 4 fail, 15 skip"),
    row("dies on bye", "dies-on-bye never", FEW, 0, ""),
    row("late hello", "late never", FEW, 4, ""),
    row("version 99", r#"hello {"protocol": 99}"#, FEW, 4, ""),
    row("a version in words", r#"hello {"protocol": "two"}"#, FEW, 4, ""),
    row("limit 0", r#"hello {"limits": {"max_packet": 0}}"#, FEW, 0, ""),
    row("limit -1", r#"hello {"limits": {"max_packet": -1}}"#, FEW, 4, ""),
    row("limit 1e300", r#"hello {"limits": {"max_send": 1e300}}"#, FEW, 4, ""),
    row("limit in words", r#"hello {"limits": {"max_receive": "ten"}}"#, FEW, 4, ""),
    row("limit 2^64", r#"hello {"limits": {"max_packet": 18446744073709551616}}"#, FEW, 4, ""),
    row("limit 2^64 - 1", r#"hello {"limits": {"max_packet": 18446744073709551615}}"#, FEW, 0, ""),
    row("2^64 - 1 at once", r#"hello {"max_in_flight": 18446744073709551615}"#, FEW, 0, ""),
];
