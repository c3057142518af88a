//! CRCs by carry-less multiplication, in blocks of any size.
//!
//! Each 64-bit word W of the message, i words from its end, is multiplied by
//! x^(64 i + 16) mod P; the sum V of the products, less than 80 bits, has the same remainder as
//! the message times x^16. A long message is folded first.
//!
//! The shape is the same for registers of 128, 256 and 512 bits; only [`Multiplies`] differs.
#![expect(clippy::inline_always, reason = "compiled with the features of the caller")]

#[cfg(test)]
mod tests;

use super::compact;
use super::factors::factors;
use super::fold::{Adds, GROUP, LEFT, fold};
use super::order::Order;

/// A unit that multiplies the words of a block of `N` bytes without carry.
pub(crate) trait Multiplies<const N: usize>: Adds<N> {
    /// The first `used` bytes of a message, 2 to `N` of them, with zeros before them and `state`
    /// added to the first two. The message has at least `N` bytes, or more than 16 if `N` is 32.
    fn head<O: Order>(self, state: u16, bytes: &[u8], used: usize) -> Self::Block;

    /// The sums of the products of the block's words and their factors, one for each 16 bytes.
    fn multiply<O: Order>(self, block: Self::Block, factors: &[u8; N]) -> Self::Block;

    /// The remainder by P of a block's sums of products, added, which carry a factor x^48.
    fn finish<O: Order>(self, sums: Self::Block) -> u16;
}

/// From this many bytes on, loads that cross no cache line are worth the tail: the message is larger
/// than the innermost cache of most processors.
pub(crate) const ALIGNED: usize = 32 << 10;

/// A message as its head, the blocks behind it, which begin at `start` or some blocks before or
/// after, and the tail behind them, less than a block.
#[inline(always)]
fn split_at<O: Order, U: Multiplies<N>, const N: usize>(
    unit: U,
    state: u16,
    bytes: &[u8],
    start: usize,
) -> (U::Block, &[[u8; N]], &[u8]) {
    let (state, bytes, start) = match bytes {
        // The head would be one byte and hold but one byte of the state: deal with it apart.
        [first, rest @ ..] if start % N == 1 => {
            (compact::step::<O>(state, *first), rest, start - 1)
        }
        _ => (state, bytes, start),
    };
    let used = start.wrapping_sub(1) % N + 1;
    let (_, body) = bytes.split_at_checked(used).unwrap_or_default();
    let (blocks, tail) = body.as_chunks();
    (unit.head::<O>(state, bytes, used), blocks, tail)
}

/// The state after a message of no more blocks than there are factors for: up to 2 KiB.
#[inline(always)]
pub(crate) fn medium<O: Order, U: Multiplies<N>, const N: usize>(
    unit: U,
    state: u16,
    bytes: &[u8],
) -> u16 {
    let (head, blocks, _) = split_at::<O, U, N>(unit, state, bytes, bytes.len());
    let factors = factors::<O, N>();
    let behind = factors.len().wrapping_sub(1).wrapping_sub(blocks.len());
    let Some([factor, factors @ ..]) = factors.get(behind..) else {
        return 0; // never: the caller sees to the number
    };
    let mut sums = unit.multiply::<O>(head, factor);
    for (block, factor) in blocks.iter().zip(factors) {
        sums = unit.add(sums, unit.multiply::<O>(unit.load(block), factor));
    }
    unit.finish::<O>(sums)
}

/// The state after a message of more than 16 blocks, and what is left of it: less than a block, and
/// nothing of messages shorter than [`ALIGNED`]. All but 15 to 28 blocks are folded; these are
/// multiplied.
#[inline(always)]
pub(crate) fn long<O: Order, U: Multiplies<N>, const N: usize>(
    unit: U,
    state: u16,
    bytes: &[u8],
) -> (u16, &[u8]) {
    let aligned = bytes.len() >= ALIGNED;
    let start = if aligned { bytes.as_ptr().align_offset(N) } else { bytes.len() };
    let (head, blocks, tail) = split_at::<O, U, N>(unit, state, bytes, start);
    let folded = blocks.len().wrapping_sub(LEFT) / GROUP * GROUP;
    let (groups, blocks) = blocks.split_at_checked(folded).unwrap_or_default();
    let Some((last, rest)) = blocks.split_first_chunk() else {
        return (0, tail); // never: the caller sees to the number
    };
    let folded = fold(unit, head, groups.as_chunks().0, last);

    let factors = factors::<O, N>();
    let split = factors.split_at_checked(factors.len().wrapping_sub(rest.len()));
    let Some((Some(factors), behind)) = split.map(|(all, rest)| (all.last_chunk::<LEFT>(), rest))
    else {
        return (0, tail); // never: less than a group is left
    };
    let mut sums = unit.zero();
    for (block, factor) in folded.left.into_iter().zip(factors) {
        sums = unit.add(sums, unit.multiply::<O>(block, factor));
    }
    for (block, factor) in rest.iter().zip(behind) {
        sums = unit.add(sums, unit.multiply::<O>(unit.load(block), factor));
    }
    (unit.finish::<O>(sums) ^ folded.quotient::<O, U, N>(unit), tail)
}
