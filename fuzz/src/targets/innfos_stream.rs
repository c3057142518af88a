//! INNFOS datagrams of several frames.

use actucheck_codec::innfos::{self, Frame};
use actucheck_spec::wire::innfos::reference;

use crate::targets::innfos_frame::{WAYS, packet};

/// The input is a datagram.
///
/// # Panics
/// If the codec is wrong.
pub fn check(datagram: &[u8]) {
    for (direction, said) in WAYS {
        let expected = reference::packets(said, datagram);
        let found: Vec<_> = innfos::frames(direction, datagram).map_while(Result::ok).collect();
        assert_eq!(found.iter().map(packet).collect::<Vec<_>>(), expected);

        // Frame by frame, and nothing after the first error.
        let mut rest = datagram;
        for frame in &found {
            let (first, behind) = Frame::first(direction, rest).unwrap();
            assert_eq!(first, *frame);
            assert_eq!(Frame::parse(direction, &rest[..rest.len() - behind.len()]), Ok(first));
            rest = behind;
        }
        let mut frames = innfos::frames(direction, datagram).skip(found.len());
        let error = frames.next();
        assert_eq!(
            error,
            Frame::first(direction, rest).err().map(Err).filter(|_| !rest.is_empty())
        );
        assert_eq!(frames.next(), None);
    }
}

/// Mends a frame after a header: the CRC if its length requires one, and the end byte after it.
pub fn repair(input: &mut [u8]) {
    let mut start = 0;
    while let Some([0xEE, _, _, high, low, ..]) = input.get(start..) {
        let data = start + 5;
        let end = data + usize::from(u16::from_be_bytes([*high, *low]));
        let crc = input.get(data..end).map(reference::crc);
        let (Some(crc), Some(behind)) = (crc, input.get_mut(end..)) else { return };
        start = match behind {
            [first, second, tail, ..] if end > data + 1 => {
                [*first, *second] = crc.to_le_bytes();
                *tail = 0xED;
                end + 3
            }
            [tail, ..] => {
                *tail = 0xED;
                end + 1
            }
            [] => return,
        };
    }
}
