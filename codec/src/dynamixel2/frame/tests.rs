//! Compares the fast implementations with the simple one.

use proptest::collection::vec;
use proptest::prelude::*;

use super::{encode, encode_with};
use crate::dynamixel2::Instruction;

/// Bytes in which the pattern is common, or does not occur.
fn part(most: usize) -> impl Strategy<Value = Vec<u8>> {
    let tricky = prop_oneof![5 => Just(0xFF_u8), 3 => Just(0xFD), 2 => any::<u8>()];
    prop_oneof![vec(tricky, 0..=most), vec(0..0xFF_u8, 0..=most)]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    /// For any division of the parameters, and any size of the buffer.
    #[test]
    fn parts_make_the_same_packet_as_bytes(
        code in prop_oneof![Just(0xFF_u8), any::<u8>()],
        parts in prop_oneof![
            // Packets that are written without reading back: a few bytes, then more.
            (vec(part(3), 0..3), part(70)).prop_map(|(mut parts, tail)| {
                parts.push(tail);
                parts
            }),
            vec(part(20), 0..5),
        ],
        room in prop_oneof![Just(300_usize), 0..120_usize],
    ) {
        let instruction = Instruction::from_code(code);
        let bytes = parts.concat();
        let (mut buffer, mut plain_buffer) = (vec![0; room], vec![0; room]);
        let bytewise =
            |put: &mut dyn FnMut(&[u8])| bytes.iter().for_each(|byte| put(&[*byte]));
        let plain = encode_with(1, instruction, bytewise, &mut plain_buffer);
        let parts: Vec<&[u8]> = parts.iter().map(Vec::as_slice).collect();
        prop_assert_eq!(encode(1, instruction, &parts, &mut buffer), plain);
    }
}
