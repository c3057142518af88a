//! Streams read by the rules and by the parser. The plain reading, and what feeds the parser, are
//! those of the codec's own tests.

// They are written for a test.
#[path = "../../codec/tests/stream/drive.rs"]
pub(crate) mod drive;
#[path = "../../codec/tests/stream/reference.rs"]
pub(crate) mod reference;

use drive::{expected, parse};
use reference::Seen;

use crate::draw::Draw;

/// The longest packet of a scenario.
pub(crate) const MAX_PACKET: usize = 1024;

/// The events of a stream, which are those of the plain reading however it is cut: whole, byte by
/// byte, and in pieces drawn from the bytes themselves. Between each two of `busy` is a quiet
/// time.
///
/// # Panics
/// If they are not.
pub(crate) fn events(busy: &[Vec<u8>]) -> Vec<Seen> {
    let mut draw = Draw::of(&busy.concat());
    let events = expected(busy, MAX_PACKET);
    let sizes = [1 + draw.below(12), 1 + draw.below(80), 1 + draw.below(400)];
    for (sizes, patience) in [(&[usize::MAX][..], usize::MAX), (&[1], 1), (&sizes, 3)] {
        assert_eq!(parse::<16>(busy, MAX_PACKET, sizes, patience), events, "pieces of {sizes:?}");
    }
    // The smallest buffer, in which bytes are moved all the time, and a limit below its size.
    let limit = 12 + draw.below(60);
    let small = expected(busy, limit.min(64));
    assert_eq!(parse::<1>(busy, limit, &sizes, 1), small, "at most {limit} bytes");
    events
}
