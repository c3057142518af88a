//! The shape against the oracle, with emulated instructions: on any processor, and for blocks of
//! every size.

use super::super::order::{Lsb, Msb};
use super::super::tests::{modbus_oracle, noise, umts_oracle};
use super::*;

/// Registers of `N` bytes, bit by bit.
#[derive(Clone, Copy)]
struct Emulated;

impl<const N: usize> Adds<N> for Emulated {
    type Block = [u8; N];

    fn zero(self) -> [u8; N] {
        [0; N]
    }

    fn load(self, bytes: &[u8; N]) -> [u8; N] {
        *bytes
    }

    fn add(self, a: [u8; N], b: [u8; N]) -> [u8; N] {
        std::array::from_fn(|i| a[i] ^ b[i])
    }

    fn odd(self, block: [u8; N]) -> bool {
        block.iter().map(|byte| byte.count_ones()).sum::<u32>() % 2 == 1
    }
}

impl<const N: usize> Multiplies<N> for Emulated {
    fn head<O: Order>(self, state: u16, bytes: &[u8], used: usize) -> [u8; N] {
        assert!(bytes.len() >= N, "a register is loaded");
        assert!((2..=N).contains(&used), "{used} bytes");
        let state = if O::REFLECTED { state.to_le_bytes() } else { state.to_be_bytes() };
        let mut head = [0; N];
        head[N - used..].copy_from_slice(&bytes[..used]);
        head[N - used] ^= state[0];
        head[N - used + 1] ^= state[1];
        head
    }

    fn multiply<O: Order>(self, block: [u8; N], factors: &[u8; N]) -> [u8; N] {
        let mut sums = [0; N];
        let lanes = block.as_chunks::<16>().0.iter().zip(factors.as_chunks::<16>().0);
        for ((lane, factors), sum) in lanes.zip(sums.as_chunks_mut::<16>().0) {
            let lane =
                if O::REFLECTED { u128::from_le_bytes(*lane) } else { u128::from_be_bytes(*lane) };
            let factors = u128::from_le_bytes(*factors);
            let (low, high) = (u128::from(u64::MAX), 64);
            let product =
                multiply(lane & low, factors & low) ^ multiply(lane >> high, factors >> high);
            *sum = product.to_le_bytes();
        }
        sums
    }

    fn finish<O: Order>(self, sums: [u8; N]) -> u16 {
        let lanes = sums.as_chunks::<16>().0.iter();
        let sum = lanes.fold(0, |sum, lane| sum ^ u128::from_le_bytes(*lane));
        let mut rest = if O::REFLECTED { sum.reverse_bits() } else { sum } >> 48;
        for bit in (16..80).rev() {
            if rest >> bit & 1 == 1 {
                rest ^= 0x1_8005 << (bit - 16);
            }
        }
        let state = u16::try_from(rest).unwrap();
        if O::REFLECTED { state.reverse_bits() } else { state }
    }
}

/// The product of two words without carry.
fn multiply(a: u128, b: u128) -> u128 {
    (0..64).filter(|bit| b >> bit & 1 == 1).fold(0, |product, bit| product ^ a << bit)
}

/// Every length from one block to more than a long message needs, by each way that may be taken.
fn every_length<O: Order, const N: usize>(oracle: fn(u16, &[u8]) -> u16) {
    let bytes = noise(4, (LEFT + 3 * GROUP) * N);
    for n in N + 1..=bytes.len() {
        let state = if n % 2 == 0 { 0xBEEF } else { 0x8001 };
        let bytes = &bytes[..n];
        let expected = oracle(state, bytes);
        if n <= factors::<O, N>().len() * N {
            assert_eq!(medium::<O, _, N>(Emulated, state, bytes), expected, "{n} of {N}");
        }
        if n > 16 * N + 1 {
            let (crc, tail) = long::<O, _, N>(Emulated, state, bytes);
            assert_eq!((crc, tail), (expected, &[][..]), "{n} of {N}");
        }
    }
    // Aligned in memory.
    let bytes = noise(5, ALIGNED + 3 * N);
    for offset in 0..=N {
        let bytes = &bytes[offset..ALIGNED + 2 * offset];
        let (before, tail) = long::<O, _, N>(Emulated, 0xBEEF, bytes);
        assert!(tail.len() < N && tail.as_ptr().addr().is_multiple_of(N), "{offset} of {N}");
        assert_eq!(oracle(before, tail), oracle(0xBEEF, bytes), "{offset} of {N}, aligned");
    }
}

#[test]
fn blocks_of_16_bytes() {
    every_length::<Msb, 16>(umts_oracle);
    every_length::<Lsb, 16>(modbus_oracle);
}

#[test]
fn blocks_of_32_bytes() {
    every_length::<Msb, 32>(umts_oracle);
    every_length::<Lsb, 32>(modbus_oracle);
}

#[test]
fn blocks_of_64_bytes() {
    every_length::<Msb, 64>(umts_oracle);
    every_length::<Lsb, 64>(modbus_oracle);
}
