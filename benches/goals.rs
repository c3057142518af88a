//! Goals: how much faster the codec must be than the best peer.

/// The goal of one case of one benchmark.
#[must_use]
#[expect(clippy::match_same_arms, reason = "each goal is one of its own")]
pub fn goal(group: &str, case: &str) -> Option<f64> {
    let size: usize = case.parse().unwrap_or(0);
    match (group, case) {
        ("umts", _) => match size {
            ..=10 => Some(1.0),
            14..=512 => Some(1.3),
            1024 => Some(1.8),
            65_536 => Some(5.0),
            _ => None,
        },
        ("modbus", _) => match size {
            ..=64 => Some(1.0),
            256.. => Some(2.0),
            _ => None,
        },
        ("encode", "4") => Some(2.5),
        ("encode", "20") => Some(5.0),
        ("encode", "64") => Some(8.0),
        ("encode", "64 stuffed") => Some(4.0),
        ("stream", "clean") => Some(8.0),
        ("stream", "stuffed") => Some(6.0),
        ("stream", "half noise") => Some(5.0),
        // At most half as long again.
        ("bus behind a pseudo-terminal", _) => Some(1.0 / 1.5),
        _ => None,
    }
}

/// At 64 KiB: the speed as a fraction of the speed of only reading the bytes.
pub const OF_READING: f64 = 0.7;

/// The most ns that a Read answered in process may take.
pub const READ_ANSWERED: f64 = 1000.0;

/// The ns that a line of 4 Mbit/s takes for the answers to a Sync Read of 4 bytes from 253 devices: 253
/// packets of 15 bytes, each byte with a start and a stop bit.
pub const SYNC_READ_CARRIED: f64 = 253.0 * 15.0 * 10.0 / 4e6 * 1e9;

/// The trap: how much longer an input of twice the size may take.
pub const GROWTH: f64 = 2.3;
