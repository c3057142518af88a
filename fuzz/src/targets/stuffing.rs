//! Byte stuffing: there and back, against the reference, within its bound, at every split.

use actucheck_codec::BufferTooSmall;
use actucheck_codec::dynamixel2::stuffing::{stuff, stuffed_len, unstuff};
use actucheck_codec::dynamixel2::{Instruction, frame};
use actucheck_spec::wire::dynamixel2::reference;

use crate::draw::Draw;
use crate::targets::shown;

/// So much more than it needs lets a packet be written a window at a time.
const ROOM: usize = 80;

/// The input is a body.
///
/// # Panics
/// If the codec is wrong.
pub fn check(body: &[u8]) {
    let expected = reference::stuff(body);
    assert!(!expected.windows(4).any(|window| window == reference::HEADER), "a header is left");
    assert!(expected.len() <= body.len() + body.len() / 3, "{} bytes", expected.len());
    assert_eq!(stuffed_len(body), expected.len());

    let mut buffer = vec![0; expected.len()];
    assert_eq!(stuff(body, &mut buffer), Ok(&expected[..]));
    if let Some(available) = expected.len().checked_sub(1) {
        let too_small = BufferTooSmall { needed: expected.len(), available };
        let stuffed = stuff(body, &mut buffer[..available]).inspect_err(shown);
        assert_eq!(stuffed, Err(too_small));
    }
    assert_eq!(unstuff(&expected, &mut buffer), Ok(body));

    // And as if it were stuffed already.
    let unstuffed = reference::unstuff(body).ok();
    let found = unstuff(body, &mut buffer[..body.len()]).inspect_err(shown);
    assert_eq!(found.ok().map(<[u8]>::to_vec), unstuffed);

    at_every_split(body, &expected);
}

/// A packet's parameters may come in parts, and a pattern across them; and the buffer may have room
/// for much more, or not, as is drawn from the body's bytes.
fn at_every_split(body: &[u8], stuffed: &[u8]) {
    let Some((code, params)) = body.split_first() else { return };
    let packet = reference::frame(1, stuffed);
    let instruction = Instruction::from_code(*code);
    let mut buffer = vec![0; packet.len() + ROOM];
    // Of a long body a few splits, drawn too.
    let mut draw = Draw::of(body);
    let every = params.len() < 12;
    for split in 0..if every { params.len() + 1 } else { 2 } {
        let split = if every { split } else { draw.below(params.len() + 1) };
        let (head, tail) = params.split_at(split);
        let (first, second) = head.split_at(head.len() / 2);
        for parts in [&[head, tail][..], &[first, second, tail]] {
            let room = packet.len() + ROOM * draw.below(2);
            let built = frame::encode(1, instruction, parts, &mut buffer[..room]);
            assert_eq!(built, Ok(&packet[..]), "split at {split}, {room} bytes of room");
        }
    }
}
