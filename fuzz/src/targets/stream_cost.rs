//! The limit of the stream parser's cost, in bytes examined and bytes kept.

use actucheck_codec::dynamixel2::stream::{DEFAULT_MAX_PACKET, Parser, meter};

use crate::draw::Draw;
pub use crate::targets::stream_raw::repair;

/// A byte of the stream is looked at so often at most: twice a checkpoint's block for each false
/// header of a fast status packet, which has 8 bytes, and the search for headers.
const LOOKS: usize = 24;
/// Every call looks at a window of bytes, however few are new.
const WINDOW: usize = 64;
/// Long enough for a cost that grows faster than the stream to show.
const LONG: usize = 4 * DEFAULT_MAX_PACKET;

/// The input is a stream, or what a long one repeats.
///
/// # Panics
/// If the parser is dearer.
pub fn check(input: &[u8]) {
    if input.is_empty() {
        return;
    }
    let stream = input.repeat(LONG.div_ceil(input.len()));
    let size = [1, 50, stream.len()][Draw::of(input).below(3)];
    let mut parser = Parser::new();
    let (before, mut pushes, mut calls) = (meter::total(), 0, 0);
    let mut drain = |parser: &mut Parser| {
        calls += 1;
        while parser.next_event().is_some() {
            calls += 1;
        }
    };
    for piece in stream.chunks(size) {
        let mut rest = piece;
        while !rest.is_empty() {
            let left = parser.push(rest).len();
            assert!(left < rest.len(), "no byte of {} was taken", rest.len());
            rest = &rest[rest.len() - left..];
            pushes += 1;
            drain(&mut parser);
        }
    }
    parser.idle();
    drain(&mut parser);
    assert_eq!(parser.pending(), 0);

    // A piece may come in parts, but only where the buffer, of two packets, is full.
    let most = stream.len().div_ceil(size) + 2 * stream.len() / DEFAULT_MAX_PACKET;
    assert!(pushes <= most, "{pushes} pushes, at most {most}");
    let (looked_at, limit) = (meter::total() - before, LOOKS * stream.len() + WINDOW * calls);
    assert!(looked_at <= limit, "{looked_at} looked at of {} in {calls} calls", stream.len());
}
