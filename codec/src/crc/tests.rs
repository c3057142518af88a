//! Every back end against a bit-at-a-time oracle.

use proptest::prelude::*;
use std::vec::Vec;

use super::order::{Lsb, Msb};
use super::*;

/// CRC-16/UMTS by shifting one bit at a time, straight from the definition.
pub(crate) fn umts_oracle(mut state: u16, bytes: &[u8]) -> u16 {
    for byte in bytes {
        for bit in (0..8).rev() {
            let out = state >> 15 ^ u16::from(byte >> bit & 1);
            state <<= 1;
            if out == 1 {
                state ^= 0x8005;
            }
        }
    }
    state
}

/// CRC-16/MODBUS by shifting one bit at a time, straight from the definition.
pub(super) fn modbus_oracle(mut state: u16, bytes: &[u8]) -> u16 {
    for byte in bytes {
        for bit in 0..8 {
            let out = state & 1 ^ u16::from(byte >> bit & 1);
            state >>= 1;
            if out == 1 {
                state ^= 0xA001;
            }
        }
    }
    state
}

/// Bytes without a pattern (`SplitMix64`).
pub(super) fn noise(seed: u64, length: usize) -> Vec<u8> {
    let mut state = seed;
    let mut next = || {
        state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (state ^ state >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ z >> 27).wrapping_mul(0x94D0_49BB_1331_11EB);
        (z ^ z >> 31).to_le_bytes()[0]
    };
    (0..length).map(|_| next()).collect()
}

#[track_caller]
fn check(state: u16, bytes: &[u8]) {
    compare(state, bytes, umts_oracle(state, bytes), modbus_oracle(state, bytes));
}

/// Every back end against these CRCs.
#[track_caller]
fn compare(state: u16, bytes: &[u8], umts: u16, modbus: u16) {
    for engine in Engine::all() {
        let n = bytes.len();
        assert_eq!(
            engine.umts_update(state, bytes),
            umts,
            "{engine:?}, umts, {n} bytes, from {state:#06x}"
        );
        assert_eq!(
            engine.modbus_update(state, bytes),
            modbus,
            "{engine:?}, modbus, {n} bytes, from {state:#06x}"
        );
    }
    // The back end of a processor without 64-bit registers.
    assert_eq!(compact::update::<Msb>(state, bytes), umts);
    assert_eq!(compact::update::<Lsb>(state, bytes), modbus);
    assert_eq!(umts_update(state, bytes), umts);
    assert_eq!(modbus_update(state, bytes), modbus);
}

/// The machine must support the back ends that the tests claim to test.
#[test]
fn engines_are_all_here() {
    #[cfg_attr(not(any(target_arch = "aarch64", target_arch = "x86_64")), expect(unused_mut))]
    let mut expected = 1;
    #[cfg(all(target_arch = "x86_64", feature = "std"))]
    {
        expected += usize::from(std::is_x86_feature_detected!("pclmulqdq"));
        expected += usize::from(std::is_x86_feature_detected!("vpclmulqdq"));
        expected += usize::from(std::is_x86_feature_detected!("avx512vbmi"));
    }
    #[cfg(all(target_arch = "aarch64", feature = "std"))]
    {
        expected += usize::from(std::arch::is_aarch64_feature_detected!("aes"));
    }
    #[cfg(all(target_arch = "aarch64", not(feature = "std")))]
    {
        expected += usize::from(cfg!(target_feature = "aes"));
    }
    #[cfg(all(target_arch = "x86_64", not(feature = "std")))]
    {
        expected += usize::from(cfg!(target_feature = "pclmulqdq"));
        expected += usize::from(cfg!(target_feature = "vpclmulqdq"));
        expected += usize::from(cfg!(target_feature = "avx512vbmi"));
    }
    assert_eq!(Engine::all().count(), expected);
}

#[test]
fn check_values() {
    assert_eq!(umts_oracle(UMTS_INIT, b"123456789"), 0xFEE8);
    assert_eq!(modbus_oracle(MODBUS_INIT, b"123456789"), 0x4B37);
    assert_eq!(umts(b"123456789"), 0xFEE8);
    assert_eq!(modbus(b"123456789"), 0x4B37);
    assert_eq!((umts(b""), modbus(b"")), (UMTS_INIT, MODBUS_INIT));
}

/// JA40 document, §1.4.7, "CRC Calculation Example" (the manual leaves the result out);
/// INNFOS Ethernet protocol, the frames of its examples.
#[test]
fn printed_examples() {
    let read = [0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x07, 0x00, 0x02, 0x00, 0x00, 0x02, 0x00];
    assert_eq!(umts(&read), 0x5121);
    // The document's function returns the bytes in the order of sending, so swapped.
    assert_eq!(modbus(&[0x01]).swap_bytes(), 0x7E80);
    assert_eq!(modbus(&[0x01]).to_le_bytes(), [0x7E, 0x80]);
    assert_eq!(modbus(&[0x06]).to_le_bytes(), [0x3F, 0x42]);
    assert_eq!(modbus(&[0x01, 0x00, 0x00, 0x00]).to_le_bytes(), [0x01, 0xD8]);
}

#[test]
fn every_length() {
    let bytes = noise(1, 4096);
    for state in [0, 0xFFFF, 0x8001, 0x1234] {
        let (mut umts, mut modbus) = (state, state);
        compare(state, &[], umts, modbus);
        for n in 1..=bytes.len() {
            umts = umts_oracle(umts, &bytes[n - 1..n]);
            modbus = modbus_oracle(modbus, &bytes[n - 1..n]);
            compare(state, &bytes[..n], umts, modbus);
        }
    }
}

#[test]
fn every_alignment() {
    let bytes = noise(2, 4096 + 64);
    for n in [
        0, 1, 2, 3, 7, 8, 9, 15, 16, 17, 31, 32, 33, 63, 64, 65, 255, 256, 257, 511, 512, 513,
        1023, 1024, 1025, 1535, 1601, 2047, 4096,
    ] {
        for offset in 0..64 {
            check(0x5A5A, &bytes[offset..offset + n]);
        }
    }
}

/// A single bit at every place, so that no two wrong constants can cancel out.
#[test]
fn every_bit() {
    for n in (1..=70).chain([127, 128, 129, 255, 256, 257, 511, 512, 513, 600, 1025]) {
        let mut bytes = std::vec![0; n];
        // The oracle is slow: of long messages, two or three bits in ten bytes.
        for bit in (0..8 * n).step_by(if n <= 70 { 1 } else { 29 }) {
            bytes[bit / 8] = 1 << (bit % 8);
            check(0, &bytes);
            bytes[bit / 8] = 0;
        }
        for bit in 0..16 {
            check(1 << bit, &bytes);
        }
    }
}

#[test]
fn long() {
    let bytes = noise(3, 100_000);
    for n in [5_000, 8_191, 8_192, 65_535, 65_536, 99_999] {
        check(0xBEEF, &bytes[..n]);
    }
}

/// From this length on, blocks are aligned in memory.
#[test]
fn long_at_every_alignment() {
    let bytes = noise(5, product::ALIGNED + 256);
    for offset in 0..=64 {
        let n = product::ALIGNED - 1 + offset * 37 % 128;
        check(0xBEEF, &bytes[offset..offset + n]);
    }
}

#[test]
fn shift_is_zero_bytes() {
    let zeros = [0; 1100];
    for n in 0..=zeros.len() {
        for state in [1, 0x8000, 0xFFFF, 0x1234] {
            assert_eq!(umts_shift(state, n as u64), umts_oracle(state, &zeros[..n]), "{n}");
            assert_eq!(modbus_shift(state, n as u64), modbus_oracle(state, &zeros[..n]), "{n}");
        }
    }
}

#[test]
fn shift_has_its_period() {
    for count in [0, 1, 31, 32, 1023, 1024, 32_766, 32_767, 65_536, u64::from(u32::MAX), u64::MAX] {
        let short = count % 32_767;
        let zeros = std::vec![0; usize::try_from(short).unwrap()];
        assert_eq!(umts_shift(0xACE1, count), umts_oracle(0xACE1, &zeros), "{count}");
        assert_eq!(modbus_shift(0xACE1, count), modbus_oracle(0xACE1, &zeros), "{count}");
    }
}

proptest! {
    #[test]
    fn any_bytes(state: u16, bytes in proptest::collection::vec(any::<u8>(), 0..3000)) {
        check(state, &bytes);
    }

    #[test]
    fn any_split(state: u16, bytes in proptest::collection::vec(any::<u8>(), 0..1500), cuts: [prop::sample::Index; 3]) {
        let mut cuts = cuts.map(|cut| cut.index(bytes.len() + 1));
        cuts.sort_unstable();
        let [a, b, c] = cuts;
        for engine in Engine::all() {
            let parts = [&bytes[..a], &bytes[a..b], &bytes[b..c], &bytes[c..]];
            let umts = parts.iter().fold(state, |state, part| engine.umts_update(state, part));
            prop_assert_eq!(umts, umts_oracle(state, &bytes));
            let modbus = parts.iter().fold(state, |state, part| engine.modbus_update(state, part));
            prop_assert_eq!(modbus, modbus_oracle(state, &bytes));
        }
    }

    /// The CRC of any range of a stream from the states at its ends, and of any two joined
    /// messages.
    #[test]
    fn any_range(bytes in proptest::collection::vec(any::<u8>(), 0..1500), ends: [prop::sample::Index; 2]) {
        let mut ends = ends.map(|end| end.index(bytes.len() + 1));
        ends.sort_unstable();
        let [a, b] = ends;
        let (range, count) = (&bytes[a..b], (b - a) as u64);

        let gap = umts_shift(umts(&bytes[..a]), count);
        prop_assert_eq!(umts(&bytes[..b]) ^ gap, umts(range));

        let gap = modbus_shift(modbus(&bytes[..a]) ^ MODBUS_INIT, count);
        prop_assert_eq!(modbus(&bytes[..b]) ^ gap, modbus(range));
    }

    #[test]
    fn shifts_add_up(state: u16, a in 0..u64::MAX / 2, b in 0..u64::MAX / 2) {
        prop_assert_eq!(umts_shift(umts_shift(state, a), b), umts_shift(state, a + b));
        prop_assert_eq!(modbus_shift(modbus_shift(state, a), b), modbus_shift(state, a + b));
    }
}
