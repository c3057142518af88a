//! Compares the stream parser with the reference.

use actucheck_codec::dynamixel2::stream::Parser;
use actucheck_spec::wire::dynamixel2::reference::{self, Event};

use super::model::event;
use crate::draw::Draw;

/// The longest packet of a scenario.
pub(crate) const MAX_PACKET: usize = 1024;

/// The events of a stream. Asserts that the parser yields the events of the reference for the whole
/// stream, byte by byte, and in pieces whose sizes are drawn from the bytes. There is a quiet time
/// between each two of `busy`.
///
/// # Panics
/// If they differ.
pub(crate) fn events(busy: &[Vec<u8>]) -> Vec<Event> {
    let mut draw = Draw::of(&busy.concat());
    let events = expected(busy, MAX_PACKET);
    let sizes = [1 + draw.below(12), 1 + draw.below(80), 1 + draw.below(400)];
    let all = usize::MAX;
    for (sizes, patience) in [(&[all][..], all), (&[1], 1), (&sizes, 3), (&sizes, all)] {
        assert_eq!(parsed::<16>(busy, MAX_PACKET, sizes, patience), events, "pieces of {sizes:?}");
    }
    // The smallest buffer, in which bytes are moved all the time, with a limit below its size.
    let limit = 12 + draw.below(60);
    let small = expected(busy, limit.min(64));
    for (sizes, patience) in [(&sizes[..], 1), (&[all], all)] {
        assert_eq!(parsed::<1>(busy, limit, sizes, patience), small, "at most {limit} bytes");
    }
    events
}

fn expected(busy: &[Vec<u8>], max_packet: usize) -> Vec<Event> {
    let quiet = |index| index + 1 < busy.len();
    let busy = busy.iter().enumerate();
    busy.flat_map(|(index, bytes)| reference::events(bytes, quiet(index), max_packet)).collect()
}

/// The events of a parser for a stream in pieces with the repeating `sizes`, if at most `patience`
/// events are taken after each piece.
fn parsed<const BLOCKS: usize>(
    busy: &[Vec<u8>],
    max_packet: usize,
    sizes: &[usize],
    patience: usize,
) -> Vec<Event> {
    let mut parser = Parser::<BLOCKS>::with_max_packet(max_packet);
    let mut sizes = sizes.iter().copied().cycle();
    let mut events = Vec::new();
    for (index, bytes) in busy.iter().enumerate() {
        if index > 0 {
            parser.idle();
            take(&mut parser, usize::MAX, &mut events);
            assert_eq!(parser.pending(), 0, "something outlasts a quiet time");
        }
        let mut rest = bytes.as_slice();
        while !rest.is_empty() {
            let piece = &rest[..sizes.next().unwrap().min(rest.len())];
            if patience == usize::MAX {
                parser.feed(piece, |seen| events.push(event(seen)));
                rest = &rest[piece.len()..];
                continue;
            }
            let left = parser.push(piece).len();
            rest = &rest[piece.len() - left..];
            take(&mut parser, patience, &mut events);
        }
    }
    take(&mut parser, usize::MAX, &mut events);
    let told: usize = events.iter().map(Event::size).sum();
    assert_eq!(told + usize::try_from(parser.pending()).unwrap(), busy.concat().len());
    events
}

fn take<const BLOCKS: usize>(parser: &mut Parser<BLOCKS>, most: usize, events: &mut Vec<Event>) {
    for _ in 0..most {
        let Some(seen) = parser.next_event() else { break };
        events.push(event(seen));
    }
}
