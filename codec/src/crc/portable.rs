//! The back end for every processor: no table, no `unsafe`, no multiplication.
//!
//! P = x^16 + x^15 + x^2 + 1 has four terms, and squaring over GF(2) keeps them four:
//! P^n = x^16n + x^15n + x^2n + 1 for every n that is a power of two. Both steps of a division
//! are then a handful of shifts:
//!
//! * *Multiplying a quotient by P^n* is three additions.
//! * *Finding the quotient.* With s = x^-n the divisor is p(s) = 1 + s + s^14 + s^16 times a power
//!   of x, and 1/p(s) = p(s) p(s^2) p(s^4) … p(s^m) / p(s^2m). The last divisor is 1 as soon as
//!   s^2m lies below the word, so that the quotient is the word times a few p's.
//!
//! A remainder modulo P^n can replace the message, since P divides P^n. So a long message is
//! halved, again and again, each time modulo a smaller power of P, until it fits a word. The larger
//! n, the fewer factors: at n = 64 the quotient is the word.
#![expect(clippy::indexing_slicing, reason = "arrays of a fixed size, indices below it")]

use core::hint::black_box;

use super::compact;
use super::fold::{Adds, BLOCK, GROUP, LEFT, Words, fold};
use super::order::Order;
use super::short;
use crate::simd::HAS_WORDS;

/// The state after `bytes`.
pub(crate) fn update<O: Order>(state: u16, bytes: &[u8]) -> u16 {
    if !HAS_WORDS {
        return compact::update::<O>(state, bytes);
    }
    match bytes.len() {
        0..=4 => compact::update::<O>(state, bytes),
        5..=8 => finish::<O>(short::word::<O>(state, bytes)),
        9..=16 => {
            let (high, low) = short::pair::<O>(state, bytes);
            finish::<O>(halve::<O, 1, 2>(&[high, low])[0])
        }
        17..=32 => finish4::<O>(&words::<O, 4>(state, bytes)),
        33..=64 => finish8::<O>(&words::<O, 8>(state, bytes)),
        65..=128 => finish16::<O>(&words::<O, 16>(state, bytes)),
        129..=256 => finish32::<O>(&words::<O, 32>(state, bytes)),
        _ => long::<O>(state, bytes),
    }
}

/// A message of more than 256 bytes: what is more than whole groups first, then the rest folded to
/// 240 bytes.
fn long<O: Order>(state: u16, bytes: &[u8]) -> u16 {
    const LEAST: usize = (1 + LEFT) * BLOCK;
    let Some(more) = bytes.len().checked_sub(LEAST) else {
        return state; // never: shorter messages go elsewhere
    };
    let (before, bytes) = bytes.split_at(more % (GROUP * BLOCK));
    let state = update::<O>(state, before);
    let (blocks, _) = bytes.as_chunks::<BLOCK>();
    let Some(([first], blocks)) = blocks.split_first_chunk() else {
        return state; // never
    };
    let Some((groups, last)) = blocks.split_last_chunk() else {
        return state; // never
    };
    let mut first = Words.load(first);
    first[0] ^= O::to_native(O::top(state));
    let folded = fold(Words, first, groups.as_chunks().0, last);
    // If the compiler knew that the words are swapped, it would fold in general registers.
    let left = black_box(folded.left);
    // Zeros in front.
    let mut words = [0; 2 * LEFT + 2];
    for (word, native) in words[2..].iter_mut().zip(left.as_flattened()) {
        *word = O::from_native(*native);
    }
    finish32::<O>(&words) ^ folded.quotient::<O, _, BLOCK>(Words)
}

fn finish32<O: Order>(words: &[u64; 32]) -> u16 {
    finish16::<O>(&halve::<O, 16, 32>(words))
}

#[inline]
fn finish16<O: Order>(words: &[u64; 16]) -> u16 {
    finish8::<O>(&halve::<O, 8, 16>(words))
}

#[inline]
fn finish8<O: Order>(words: &[u64; 8]) -> u16 {
    finish4::<O>(&halve::<O, 4, 8>(words))
}

#[inline]
fn finish4<O: Order>(words: &[u64; 4]) -> u16 {
    let words = halve::<O, 2, 4>(words);
    finish::<O>(halve::<O, 1, 2>(&words)[0])
}

/// A message of more than eight and at most `8 * N` bytes as words, right-aligned, highest word
/// first, with `state` added to the first two bytes.
#[inline]
fn words<O: Order, const N: usize>(state: u16, bytes: &[u8]) -> [u64; N] {
    let mut words = [0; N];
    let Some(&first) = bytes.first_chunk() else {
        return words; // never: shorter messages go elsewhere
    };
    let spare = short::spare_bits(bytes);
    let (_, chunks) = bytes.as_rchunks();
    // One word more than `chunks` if the highest word is not full.
    let used = bytes.len().div_ceil(8).min(N);
    for (word, chunk) in words.iter_mut().rev().zip(chunks.iter().rev()) {
        *word = O::load(*chunk);
    }
    let top = O::top(state);
    if let [high, next, ..] = &mut words[N - used..] {
        *high = O::lower(O::load(first) ^ top, spare);
        // If the highest word has one byte, the state's second byte belongs to the next word.
        *next ^= O::raise(O::raise(top, 56 - spare), 8);
    }
    words
}

/// `M = 2 * N` words modulo P^4N, which is N words: N steps of a long division.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "at most 16")]
fn halve<O: Order, const N: usize, const M: usize>(words: &[u64; M]) -> [u64; N] {
    const {
        assert!(M == 2 * N && N.is_power_of_two() && N <= 16);
    }
    let mut words = *words;
    // P^4N = x^64N + x^60N + x^8N + 1, and a word is x^64.
    let power = 4 * N as u32;
    for i in 0..N {
        let quotient = divide::<O>(words[i], power);
        words[i + 1] ^= O::raise(quotient, 64 - power);
        match N {
            16 => words[i + N - 2] ^= quotient,
            8 => words[i + N - 1] ^= quotient,
            _ => {
                // For N = 1 this also changes the word that the division has finished.
                words[i + N - 1] ^= O::lower(quotient, 64 - 2 * power);
                words[i + N] ^= O::raise(quotient, 2 * power);
            }
        }
        words[i + N] ^= quotient;
    }
    let mut half = [0; N];
    half.copy_from_slice(&words[N..]);
    half
}

/// The quotient of `word` x^(16 `power`) by P^`power`, `power` being a power of two up to 64.
#[inline]
fn divide<O: Order>(word: u64, power: u32) -> u64 {
    let mut quotient = word;
    let mut s = power;
    while s < 64 {
        let mut sum = quotient ^ O::lower(quotient, s);
        if 14 * s < 64 {
            sum ^= O::lower(quotient, 14 * s);
        }
        if 16 * s < 64 {
            sum ^= O::lower(quotient, 16 * s);
        }
        quotient = sum;
        s *= 2;
    }
    quotient
}

/// The CRC of the eight bytes in `word`: the remainder of `word` x^16 by P.
#[inline]
fn finish<O: Order>(word: u64) -> u16 {
    let quotient = divide::<O>(word, 1);
    // The remainder is the 16 lowest terms of the quotient times P: `word` x^16 has none there.
    O::bottom(quotient ^ O::raise(quotient, 2) ^ O::raise(quotient, 15))
}
