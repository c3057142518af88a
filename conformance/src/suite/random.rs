//! Random values that a seed yields.

use std::ops::Range;

use proptest::collection::vec;
use proptest::prelude::{Just, Strategy, any};
use proptest::prop_oneof;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

/// The generator of values; the same seed yields the same values.
pub(crate) fn runner(seed: u64) -> TestRunner {
    let mut bytes = [0; 32];
    for (slot, byte) in bytes.iter_mut().zip(seed.to_le_bytes()) {
        *slot = byte;
    }
    let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &bytes);
    TestRunner::new_with_rng(Config::default(), rng)
}

/// Bytes among which those are common of which headers and byte stuffing are made.
pub(crate) fn data(size: Range<usize>) -> impl Strategy<Value = Vec<u8>> {
    // Shrinking prefers the first alternative.
    let byte = prop_oneof![1 => Just(0), 2 => Just(0xFD), 3 => Just(0xFF_u8), 2 => any::<u8>()];
    vec(byte, size)
}
