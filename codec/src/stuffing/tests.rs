//! The fast ways against the plain ones.

use proptest::collection::vec;
use proptest::prelude::*;

use super::{insert, remove, stuff};

/// Bytes among which the pattern is common.
fn tricky(most: usize) -> impl Strategy<Value = Vec<u8>> {
    let byte = prop_oneof![5 => Just(0xFF_u8), 3 => Just(0xFD), 1 => Just(0x00), 1 => any::<u8>()];
    // A pattern, or other bytes in number, so that bodies with few patterns are common too.
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
        let inserted = insert(&mut buffer, start, start + body.len());
        prop_assert_eq!(inserted, Some(end).filter(|end| *end <= buffer.len()));
        if inserted.is_some() {
            prop_assert_eq!(&buffer[start..end], stuffed.as_slice());
            prop_assert_eq!(&buffer[..start], before);
        }

        // Out of bytes with others behind, which look like more of the same.
        let bytes = [stuffed.as_slice(), &behind].concat();
        let len = body.len() - 1;
        for room in [0, behind.len(), 200] {
            let mut target = vec![0; len + room];
            remove(&bytes, stuffed.len(), &mut target, len);
            prop_assert_eq!(&target[..len], &body[1..]);
        }
    }
}
