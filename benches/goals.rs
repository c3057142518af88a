//! Goals: how much faster the codec must be than the best peer.

/// The goal of one case of one benchmark, where long messages are computed in registers of so many
/// bits.
#[must_use]
#[expect(clippy::match_same_arms, reason = "each goal is one of its own")]
pub fn goal(group: &str, case: &str, bits: u32) -> Option<f64> {
    let size: usize = case.parse().unwrap_or(0);
    match (group, case) {
        // Peers use registers of 512 bits too, where there are some, but none of 256.
        ("umts" | "modbus", "65536" | "1048576") => match bits {
            256 => Some(5.0),
            512 => Some(1.3),
            _ => None,
        },
        ("umts", _) => match size {
            ..=10 => Some(1.0),
            14..=512 => Some(1.3),
            1024 => Some(1.8),
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

/// From this fraction on, a goal is met whatever the peers do: there is no more to gain.
pub const AS_FAST_AS_READING: f64 = 0.9;

/// The most ns that a Read answered in process may take.
pub const READ_ANSWERED: f64 = 1000.0;

/// The ns that a line of 4 Mbit/s takes for the answers to a Sync Read of 4 bytes from 253 devices: 253
/// packets of 15 bytes, each byte with a start and a stop bit.
pub const SYNC_READ_CARRIED: f64 = 253.0 * 15.0 * 10.0 / 4e6 * 1e9;

/// The trap: how much longer an input of twice the size may take.
pub const GROWTH: f64 = 2.3;
