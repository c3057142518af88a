//! Long messages folded to 15 blocks by additions alone, in blocks of any size.
//!
//! P = (x + 1) Q with Q = x^15 + x + 1. With y = x^8N for blocks of N bytes, N being a power of
//! two, Q^8N = y^15 + y + 1. A message is a polynomial in y; to divide it by Q^8N, the highest
//! block, which is the quotient's next block h, is added to the blocks 14 and 15 places below:
//! `h[j] = m[j] + h[j - 14] + h[j - 15]`. No block waits for the one before it. Each addition takes N
//! whole bytes, so the order of the bits and bytes in a block does not matter and any vector unit
//! will do.
//!
//! The remainder by Q^8N has the message's remainder by Q, but not by P. For that, the quotient
//! times Q^8N is added, modulo P; that is Q if the quotient has an odd number of terms and nothing
//! otherwise, as (x + 1) Q is nothing.
#![expect(clippy::indexing_slicing, reason = "arrays of a fixed size, indices below it")]
#![expect(clippy::inline_always, reason = "compiled with the features of the caller")]

use super::order::Order;

/// How many blocks are left of a folded message.
pub(crate) const LEFT: usize = 15;

/// How many blocks are folded at once.
pub(crate) const GROUP: usize = 14;

/// A unit that adds blocks of `N` bytes, a power of two; a value proves that the processor has it.
pub(crate) trait Adds<const N: usize>: Copy {
    type Block: Copy;
    /// Nothing.
    fn zero(self) -> Self::Block;
    /// The bytes as a block, at any alignment.
    fn load(self, bytes: &[u8; N]) -> Self::Block;
    /// The sum of two blocks without carry.
    fn add(self, a: Self::Block, b: Self::Block) -> Self::Block;
    /// Whether the block has an odd number of ones.
    fn odd(self, block: Self::Block) -> bool;
}

/// A message that was folded.
pub(crate) struct Folded<B> {
    /// The remainder, the highest block first.
    pub(crate) left: [B; LEFT],
    /// The sum of the quotient's blocks.
    quotient: B,
}

impl<B: Copy> Folded<B> {
    /// What the quotient adds to the CRC of what is left, whatever follows.
    #[inline(always)]
    pub(crate) fn quotient<O: Order, U: Adds<N, Block = B>, const N: usize>(self, unit: U) -> u16 {
        const Q: u16 = 0x8003;
        let q = if O::REFLECTED { Q.reverse_bits() } else { Q };
        if unit.odd(self.quotient) { q } else { 0 }
    }
}

/// Folds a message: its first block, groups of blocks, and the last ones.
#[inline(always)]
pub(crate) fn fold<U: Adds<N>, const N: usize>(
    unit: U,
    first: U::Block,
    groups: &[[[u8; N]; GROUP]],
    last: &[[u8; N]; LEFT],
) -> Folded<U::Block> {
    // `pairs` has the sums of neighbours in the quotient, which is what is added 14 places below.
    // It takes fewer registers than the quotient's blocks, and half of its sums are all of the
    // quotient.
    let mut pairs = [unit.zero(); GROUP];
    pairs[GROUP - 1] = first;
    let (mut highest, mut quotient) = (first, first);
    for blocks in groups {
        macro_rules! step { ($($i:literal)*) => { $(
            let next = unit.add(unit.load(&blocks[$i]), pairs[$i]);
            pairs[$i] = unit.add(next, highest);
            if $i % 2 == 1 {
                quotient = unit.add(quotient, pairs[$i]);
            }
            highest = next;
        )* } }
        step!(0 1 2 3 4 5 6 7 8 9 10 11 12 13);
    }
    let mut left = [unit.add(unit.load(&last[LEFT - 1]), highest); LEFT];
    for i in 0..GROUP {
        left[i] = unit.add(unit.load(&last[i]), pairs[i]);
    }
    Folded { left, quotient }
}

/// The size of a block of [`Words`], in bytes.
pub(crate) const BLOCK: usize = 16;

/// Blocks of two words, on any processor.
#[derive(Clone, Copy)]
pub(crate) struct Words;

impl Adds<BLOCK> for Words {
    /// An array, so that the compiler keeps it in a vector register.
    type Block = [u64; 2];

    #[inline(always)]
    fn zero(self) -> [u64; 2] {
        [0; 2]
    }

    #[inline(always)]
    fn load(self, bytes: &[u8; BLOCK]) -> [u64; 2] {
        let (halves, _) = bytes.as_chunks();
        [u64::from_ne_bytes(halves[0]), u64::from_ne_bytes(halves[1])]
    }

    #[inline(always)]
    fn add(self, a: [u64; 2], b: [u64; 2]) -> [u64; 2] {
        [a[0] ^ b[0], a[1] ^ b[1]]
    }

    #[inline(always)]
    fn odd(self, block: [u64; 2]) -> bool {
        (block[0] ^ block[1]).count_ones() % 2 == 1
    }
}
