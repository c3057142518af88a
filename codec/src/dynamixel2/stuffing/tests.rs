//! Compares the fast implementations with the simple ones.

use proptest::collection::vec;
use proptest::prelude::*;

use crate::simd::patterns;

use super::{UnstuffError, compact, insert, remove, stuff, stuffed_len, unstuff};

/// Bytes in which the pattern is common.
fn tricky(most: usize) -> impl Strategy<Value = Vec<u8>> {
    let byte = prop_oneof![5 => Just(0xFF_u8), 3 => Just(0xFD), 1 => Just(0x00), 1 => any::<u8>()];
    // A pattern, or several other bytes, so that bodies with few patterns are common too.
    let piece = prop_oneof![vec(byte, 0..8), vec(any::<u8>(), 0..30)];
    vec(piece, 0..most / 8).prop_map(|pieces| pieces.concat())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn stuffing_comes_and_goes_anywhere(
        body in tricky(120),
        code in prop_oneof![Just(0xFF_u8), any::<u8>()],
        before in tricky(30),
        behind in tricky(200),
    ) {
        let body = [&[code], body.as_slice()].concat();
        let mut stuffed = vec![0; 2 * body.len()];
        let stuffed = stuff(&body, &mut stuffed).unwrap_or_default().to_vec();

        // Into a buffer that ends anywhere.
        let mut buffer = [before.as_slice(), &body, &behind].concat();
        let (start, end) = (before.len(), before.len() + stuffed.len());
        let mut by_byte = buffer.clone();
        prop_assert_eq!(
            compact::insert(&mut by_byte, start, start + body.len()),
            Some(end).filter(|end| *end <= buffer.len())
        );
        let inserted = insert(&mut buffer, start, start + body.len());
        prop_assert_eq!(inserted, Some(end).filter(|end| *end <= buffer.len()));
        if inserted.is_some() {
            prop_assert_eq!(&buffer[start..end], stuffed.as_slice());
            prop_assert_eq!(&by_byte[..end], &buffer[..end]);
            prop_assert_eq!(&buffer[..start], before);
        }

        // From bytes with more bytes after them, which look similar.
        let bytes = [stuffed.as_slice(), &behind].concat();
        let len = body.len() - 1;
        for room in [0, behind.len(), 200] {
            let mut target = vec![0; len + room];
            remove(&bytes, stuffed.len(), &mut target, len);
            prop_assert_eq!(&target[..len], &body[1..]);
        }
    }

    /// Of packets that may be cut off, and end one byte into their CRC at most.
    #[test]
    fn patterns_are_counted_as_byte_by_byte(
        body in tricky(200),
        front in tricky(16),
        after in proptest::option::of(prop_oneof![Just(0xFD_u8), any::<u8>()]),
        from in 0..30_usize,
        stuffed in any::<bool>(),
    ) {
        let body = if stuffed { stuff_bytewise(&body) } else { body };
        let mut bytes = [&[0xFF, 0xFF, 0xFD, 0, 1, 0, 0], front.as_slice(), &body].concat();
        let from = (7 + from).min(bytes.len());
        let body_end = if after.is_some() { bytes.len() } else { bytes.len() + 1 };
        bytes.extend(after);
        prop_assert_eq!(
            compact::patterns(&bytes, from, body_end),
            patterns(&bytes, from, body_end)
        );
    }

    #[test]
    fn whole_bodies_are_as_byte_by_byte(body in tricky(400), room in 0..500_usize) {
        let mut buffer = vec![0; room];
        let expected = stuff_bytewise(&body);
        prop_assert_eq!(stuffed_len(&body), expected.len());
        prop_assert_eq!(body.len() + compact::missing(&body), expected.len());
        match stuff(&body, &mut buffer) {
            Ok(stuffed) => prop_assert_eq!(stuffed, expected.as_slice()),
            Err(error) => prop_assert_eq!((error.needed, room < error.needed), (expected.len(), true)),
        }
        // Few random bytes are valid stuffed bodies.
        for stuffed in [&expected, &body] {
            let mut target = vec![0; room];
            let unstuffed = unstuff_bytewise(stuffed);
            prop_assert_eq!(
                compact::checked(stuffed, &mut target),
                unstuffed.as_ref().map(Vec::len).map_err(|at| *at)
            );
            if let Ok(body) = unstuffed {
                let kept = body.len().min(room);
                prop_assert_eq!(&target[..kept], &body[..kept]);
            }
            match (unstuff(stuffed, &mut buffer), unstuff_bytewise(stuffed)) {
                (Ok(found), expected) => prop_assert_eq!(Ok(found.to_vec()), expected),
                (Err(UnstuffError::Bare { at }), expected) => prop_assert_eq!(Err(at), expected),
                (Err(UnstuffError::Buffer(error)), expected) => {
                    prop_assert_eq!(Ok(error.needed), expected.map(|body| body.len()));
                    prop_assert!(room < error.needed);
                }
            }
        }
    }
}

fn stuff_bytewise(body: &[u8]) -> Vec<u8> {
    let mut stuffed = Vec::new();
    let mut since = 0;
    for byte in body {
        stuffed.push(*byte);
        if stuffed[since..].ends_with(&[0xFF, 0xFF, 0xFD]) {
            stuffed.push(0xFD);
            since = stuffed.len();
        }
    }
    stuffed
}

/// The offset of a byte that should be stuffing as the error.
fn unstuff_bytewise(stuffed: &[u8]) -> Result<Vec<u8>, usize> {
    let (mut body, mut at) = (Vec::new(), 0);
    while let Some(byte) = stuffed.get(at) {
        body.push(*byte);
        at += 1;
        if stuffed[..at].ends_with(&[0xFF, 0xFF, 0xFD]) {
            if stuffed.get(at) != Some(&0xFD) {
                return Err(at);
            }
            at += 1;
        }
    }
    Ok(body)
}
