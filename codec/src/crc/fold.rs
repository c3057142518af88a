//! Long messages folded to 256 bytes by additions alone.
//!
//! With y = x^128 and P^128 = y^16 + y^15 + y^2 + 1, a message of 16-byte blocks is a polynomial
//! in y; to reduce it modulo P^128, the highest block is added to the blocks one, 14 and 16
//! places below. Each addition takes 16 whole bytes, so the order of the bits and bytes in a
//! block does not matter and any vector unit will do.
#![expect(clippy::indexing_slicing, reason = "arrays of a fixed size, indices below it")]

use super::order::Order;

/// The size of a folded message, in bytes.
pub(crate) const BYTES: usize = 256;

/// A 16-byte block; an array, so that the compiler keeps it in a vector register.
type Block = [u64; 2];

/// The message in `chunks`, with `state` added to the first two bytes, modulo P^128: 32 words,
/// the highest first.
#[inline]
pub(crate) fn fold<O: Order>(state: u16, chunks: &[[u8; BYTES]]) -> [u64; 32] {
    let mut sum = [[0; 2]; 16];
    let Some((first, rest)) = chunks.split_first() else {
        return [0; 32];
    };
    for (block, bytes) in sum.iter_mut().zip(first.as_chunks().0) {
        *block = load(bytes);
    }
    sum[0][0] ^= O::to_native(O::top(state));
    for chunk in rest {
        let (blocks, _) = chunk.as_chunks();
        // When it is processed, `sum[i]` is the highest block; the new block replaces it.
        macro_rules! step { ($($i:literal)*) => { $(
            let highest = sum[$i];
            sum[($i + 1) % 16] = add(sum[($i + 1) % 16], highest);
            sum[($i + 14) % 16] = add(sum[($i + 14) % 16], highest);
            sum[$i] = add(highest, load(&blocks[$i]));
        )* } }
        step!(0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15);
    }
    let mut words = [0; 32];
    for (word, &native) in words.iter_mut().zip(sum.as_flattened()) {
        *word = O::from_native(native);
    }
    words
}

#[inline]
fn load(bytes: &[u8; 16]) -> Block {
    let (halves, _) = bytes.as_chunks();
    [u64::from_ne_bytes(halves[0]), u64::from_ne_bytes(halves[1])]
}

#[inline]
fn add(a: Block, b: Block) -> Block {
    [a[0] ^ b[0], a[1] ^ b[1]]
}
