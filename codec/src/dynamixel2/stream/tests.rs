//! The cost of parsing, in bytes examined.

use proptest::prelude::*;

use super::checkpoints::Checkpoints;
use super::{BLOCK, Event, Parser};
use crate::crc;
use crate::dynamixel2::{Instruction, frame};
use crate::simd::meter;

/// The bytes examined and the packets found in a stream that arrives in pieces of `size`.
fn cost<const BLOCKS: usize>(stream: &[u8], size: usize) -> (usize, usize) {
    let mut parser = Parser::<BLOCKS>::default();
    let (before, mut packets) = (meter::total(), 0);
    let mut count =
        |event: Event<'_>| packets += usize::from(!matches!(event, Event::Skipped { .. }));
    for piece in stream.chunks(size) {
        parser.feed(piece, &mut count);
    }
    parser.idle();
    parser.feed(&[], &mut count);
    (meter::total() - before, packets)
}

/// Asserts that a stream of `unit` costs at most `factor` times its bytes, and twice as long a
/// stream at most 2.3 times as much.
fn assert_linear<const BLOCKS: usize>(unit: &[u8], factor: usize) {
    for size in [1, 50, usize::MAX] {
        // Several times as long as the longest packet.
        let stream = unit.repeat(4 * BLOCKS * BLOCK / unit.len() + 1_000);
        let (once, _) = cost::<BLOCKS>(&stream, size);
        let (twice, _) = cost::<BLOCKS>(&stream.repeat(2), size);
        // Every call examines a window of bytes, even if few are new.
        let calls = stream.len() / size.min(stream.len());
        let limit = factor * stream.len() + 40 * calls;
        assert!(once <= limit, "{once} bytes looked at in {}, pieces of {size}", stream.len());
        assert!(10 * twice <= 23 * once, "{once}, then {twice} bytes, pieces of {size}");
    }
}

fn false_header(id: u8, max_packet: usize, instruction: Instruction) -> [u8; 8] {
    let [low, high, ..] = (max_packet - 7).to_le_bytes();
    [0xFF, 0xFF, 0xFD, 0x00, id, low, high, instruction.code()]
}

#[test]
fn false_headers_that_claim_the_most_cost_a_constant_each() {
    assert_linear::<16>(&false_header(1, 1024, Instruction::Write), 6);
    assert_linear::<64>(&false_header(1, 4096, Instruction::Write), 6);
    // Not stuffed, so each waits for as many bytes as its length states: two partial blocks for
    // eight bytes.
    assert_linear::<16>(&false_header(0xFE, 1024, Instruction::Status), 24);
    assert_linear::<64>(&false_header(0xFE, 4096, Instruction::Status), 24);
}

/// A packet without a header after it: bytes already examined must not be examined again.
#[test]
fn an_incomplete_packet_costs_no_more_for_coming_in_pieces() {
    let mut claim = false_header(1, 1024, Instruction::Write).to_vec();
    claim.resize(1024, 0x5A);
    assert_linear::<16>(&claim, 6);
}

/// Bytes are moved within the buffer only when at least as many have been processed.
#[test]
fn events_may_be_left_for_later() {
    let stream = b"\xFF\xFF\xFD\x00\x01\x03\x00\x01\x19\x4E".repeat(1000);
    let mut parser = Parser::new();
    let before = meter::total();
    let mut rest = &stream[..];
    while !rest.is_empty() {
        rest = parser.push(rest);
        assert!(parser.next_event().is_some());
    }
    assert!(meter::total() - before <= 8 * stream.len());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn checkpoints_give_the_crc_of_any_range(
        bytes in proptest::collection::vec(any::<u8>(), 8 * BLOCK),
        steps in proptest::collection::vec((0..3 * BLOCK, 0..4 * BLOCK, any::<bool>()), 1..20),
    ) {
        let mut checkpoints = Checkpoints::<4>::new();
        let mut buffer = bytes;
        let mut start = 0;
        for (step, len, moved) in steps {
            start += step;
            if start > buffer.len() {
                checkpoints.clear();
                start = 0;
            }
            if moved {
                // The new bytes differ from the old ones.
                let gone = start / BLOCK * BLOCK;
                buffer.rotate_left(gone);
                buffer.iter_mut().rev().take(gone).for_each(|byte| *byte ^= 0x5A);
                checkpoints.shift(start / BLOCK);
                start -= gone;
            }
            let end = (start + len).min(buffer.len());
            let expected = crc::umts(&buffer[start..end]);
            prop_assert_eq!(checkpoints.range(&buffer, start, end), expected);
        }
    }
}

#[test]
fn other_streams_are_looked_at_a_few_times() {
    assert_linear::<16>(b"\xFF\xFF\xFD\x00\x01\x03\x00\x01\x19\x4E", 8);
    assert_linear::<16>(b"\xFF\xFF\xFD\x00\x01\x03\x00\x01\x19\x4F", 12);
    assert_linear::<16>(b"\xFF", 4);
    assert_linear::<16>(b"\xFF\xFF\xFD", 4);
    assert_linear::<16>(b"\xFF\xFF\xFD\x00", 8);
    assert_linear::<16>(b"\x00", 4);
    assert_linear::<64>(b"\xFF\xFF\xFD\x00\x01\xFF\xFF\xFD\x00\x01", 8);
}

/// Every packet among false headers with the largest length is found.
#[test]
fn no_packet_is_lost_among_false_headers() {
    let mut buffer = [0; 32];
    let params: &[&[u8]] = &[&[0x34, 0x02, 0xFF, 0xFF, 0xFD, 0x00]];
    let packet = frame::encode(1, Instruction::Write, params, &mut buffer).unwrap_or_default();
    for (id, instruction) in [(1, Instruction::Write), (0xFE, Instruction::Status)] {
        let mut stream = Vec::new();
        for index in 0..2000 {
            stream.extend(false_header(id, 1024, instruction));
            stream.extend(std::iter::repeat_n(0x5A, index % 11));
            stream.extend(packet);
        }
        for size in [1, 100, usize::MAX] {
            assert_eq!(cost::<16>(&stream, size).1, 2000, "pieces of {size}");
        }
    }
}
