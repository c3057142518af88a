//! Feeds a parser and collects its events.

use actucheck_codec::dynamixel2::stream::{self, Parser, Reason};
use actucheck_codec::dynamixel2::{Frame, frame};
use actucheck_spec::model::Fault;
use actucheck_spec::wire::dynamixel2::Packet;
use actucheck_spec::wire::dynamixel2::reference::{Event, events};

/// The event in the reference's form; a frame's bytes are those of encoding it.
pub(crate) fn owned(event: stream::Event<'_>) -> Event {
    match event {
        stream::Event::Frame(frame) => {
            let params: Vec<u8> = frame.params().collect();
            assert_eq!(params.len(), frame.params_len());
            let mut buffer = [0; 2048];
            // With space after them, and without.
            assert_eq!(frame.copy_params(&mut buffer), Ok(&params[..]));
            assert_eq!(frame.copy_params(&mut buffer[..params.len()]), Ok(&params[..]));
            if let (Ok(status), [_, data @ ..]) = (frame.status(), &params[..]) {
                assert_eq!(status.copy_data(&mut buffer), Ok(data));
            }
            let bytes = frame::encode(frame.id(), frame.instruction(), &[&params], &mut buffer);
            Event::Packet(bytes.unwrap().to_vec(), packet(&frame, &params))
        }
        stream::Event::FastStatus(status) => Event::FastStatus(status.bytes().to_vec()),
        stream::Event::Skipped { bytes, reason } => {
            assert!(!reason.to_string().is_empty());
            Event::Skipped(usize::try_from(bytes).unwrap(), fault(reason))
        }
    }
}

fn packet(frame: &Frame<'_>, params: &[u8]) -> Packet {
    let (id, instruction) = (frame.id(), frame.instruction().code());
    match (frame.error(), params) {
        (Some(error), [_, params @ ..]) => {
            Packet::Status { id, error: error.0, params: params.to_vec().into() }
        }
        _ => Packet::Instruction { id, instruction, params: params.to_vec().into() },
    }
}

/// The reference's form of a reason.
fn fault(reason: Reason) -> Fault {
    match reason {
        Reason::Garbage => Fault::Header,
        Reason::Id => Fault::Id,
        Reason::Length => Fault::Length,
        Reason::Oversize => Fault::Oversize,
        Reason::Stuffing => Fault::Stuffing,
        Reason::Crc => Fault::Crc,
        Reason::Truncated => Fault::Truncated,
    }
}

/// Feeds `bytes` in pieces of the sizes that `sizes` goes through again and again, and takes at
/// most `patience` events after each; all of them if that is the largest number.
fn feed<const BLOCKS: usize>(
    parser: &mut Parser<BLOCKS>,
    mut bytes: &[u8],
    sizes: &mut impl Iterator<Item = usize>,
    patience: usize,
    events: &mut Vec<Event>,
) {
    while !bytes.is_empty() {
        let (piece, rest) = bytes.split_at(sizes.next().unwrap().min(bytes.len()));
        if patience == usize::MAX {
            parser.feed(piece, |event| events.push(owned(event)));
            bytes = rest;
            continue;
        }
        let left = parser.push(piece).len();
        bytes = &bytes[piece.len() - left..];
        assert_eq!(bytes.len(), rest.len() + left);
        for _ in 0..patience {
            let Some(event) = parser.next_event() else {
                break;
            };
            events.push(owned(event));
        }
    }
}

/// Takes all available events.
pub(crate) fn drain<const BLOCKS: usize>(parser: &mut Parser<BLOCKS>, events: &mut Vec<Event>) {
    while let Some(event) = parser.next_event() {
        events.push(owned(event));
    }
}

/// All events of a parser, with a quiet time between each two of `busy`.
pub(crate) fn parse<const BLOCKS: usize>(
    busy: &[Vec<u8>],
    max_packet: usize,
    sizes: &[usize],
    patience: usize,
) -> Vec<Event> {
    let mut parser = Parser::<BLOCKS>::with_max_packet(max_packet);
    let mut sizes = sizes.iter().copied().cycle();
    let mut events = Vec::new();
    let mut pushed = 0;
    for (index, bytes) in busy.iter().enumerate() {
        if index > 0 {
            parser.idle();
            drain(&mut parser, &mut events);
            assert_eq!(parser.pending(), 0, "nothing outlasts a quiet time");
        }
        feed(&mut parser, bytes, &mut sizes, patience, &mut events);
        pushed += bytes.len();
    }
    drain(&mut parser, &mut events);
    let accounted: usize = events.iter().map(Event::size).sum();
    assert_eq!(accounted + usize::try_from(parser.pending()).unwrap(), pushed);
    events
}

/// The events by the rules.
pub(crate) fn expected(busy: &[Vec<u8>], max_packet: usize) -> Vec<Event> {
    let last = busy.len() - 1;
    let busy = busy.iter().enumerate();
    busy.flat_map(|(index, bytes)| events(bytes, index < last, max_packet)).collect()
}
