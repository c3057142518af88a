//! Laws that hold for all bytes, against the spec's reference model.

#![allow(clippy::unwrap_used, clippy::indexing_slicing)] // tests may stop at a surprise

use actucheck_codec::dynamixel2::fast_status::{self, Block};
use actucheck_codec::dynamixel2::status::{self, StatusError};
use actucheck_codec::dynamixel2::stuffing::{stuff, stuffed_len, unstuff};
use actucheck_codec::dynamixel2::{CRC_CHECK, FastStatus, Frame, Instruction, frame};
use actucheck_codec::layout;
use actucheck_codec::{EncodeError, crc};
use actucheck_spec::wire::dynamixel2::reference;
use proptest::collection::vec;
use proptest::prelude::*;

/// Bytes in which the pattern is common.
fn tricky() -> impl Strategy<Value = Vec<u8>> {
    let byte = prop_oneof![
        4 => Just(0xFF_u8),
        3 => Just(0xFD),
        1 => Just(0x00),
        1 => any::<u8>(),
    ];
    vec(byte, 0..60)
}

fn id() -> impl Strategy<Value = u8> {
    prop_oneof![0..=252_u8, Just(254)]
}

#[test]
fn the_check_values_hold() {
    assert_eq!(crc::umts(b"123456789"), CRC_CHECK);
    assert_eq!(reference::crc(b"123456789"), CRC_CHECK);
}

#[test]
fn stuffing_is_right_for_every_short_body_of_the_pattern() {
    let alphabet = [0xFF, 0xFD, 0x00, 0x01];
    for length in 0..=7 {
        for number in 0..4_usize.pow(length) {
            let body: Vec<u8> =
                (0..length).map(|place| alphabet[number / 4_usize.pow(place) % 4]).collect();
            let mut buffer = [0; 16];
            let stuffed = stuff(&body, &mut buffer).unwrap().to_vec();
            assert_eq!(stuffed, reference::stuff(&body), "{body:02x?}");
            assert_eq!(unstuff(&stuffed, &mut buffer).unwrap(), body, "{stuffed:02x?}");
        }
    }
}

#[test]
fn a_layout_holds_for_any_number_of_devices() {
    let mut params = vec![0x34, 0x02, 0x02, 0x00];
    for device in 0..100 {
        params.extend([device, 0xAA, 0xBB]);
    }
    let layout = Instruction::SyncWrite.parameters().unwrap();
    let items: Vec<_> = layout::fields(layout, &params).map(Result::unwrap).collect();
    assert_eq!(items.len(), 2 + 2 * 100);
    for pair in items[2..].chunks(2) {
        assert_eq!(pair[0].number(), pair[0].group.map(|group| group as u64));
        assert_eq!((pair[1].field.name, pair[1].bytes), ("data", &[0xAA, 0xBB][..]));
    }
}

proptest! {
    #[test]
    fn crc_equals_long_division(bytes in vec(any::<u8>(), 0..300), cut in 0..300_usize) {
        let (head, tail) = bytes.split_at(cut.min(bytes.len()));
        prop_assert_eq!(crc::umts(&bytes), reference::crc(&bytes));
        prop_assert_eq!(crc::umts_update(crc::umts(head), tail), reference::crc(&bytes));
    }

    #[test]
    fn a_stuffed_body_holds_no_header_and_comes_back(body in tricky()) {
        let mut buffer = [0; 100];
        let stuffed = stuff(&body, &mut buffer).unwrap().to_vec();
        prop_assert_eq!(&stuffed, &reference::stuff(&body));
        prop_assert_eq!(stuffed.len(), stuffed_len(&body));
        prop_assert!(!stuffed.windows(4).any(|window| window == [0xFF, 0xFF, 0xFD, 0x00]));
        prop_assert!(stuffed.len() <= body.len() + body.len() / 3);
        prop_assert_eq!(unstuff(&stuffed, &mut buffer).unwrap(), body);
    }

    #[test]
    fn a_buffer_too_small_tells_the_size_needed(body in tricky(), size in 0..100_usize) {
        let expected = reference::frame(1, &reference::stuff(&[&[3], body.as_slice()].concat()));
        let mut buffer = vec![0; size];
        match frame::encode(1, Instruction::Write, &[&body], &mut buffer) {
            Ok(packet) => prop_assert_eq!(packet, expected),
            Err(EncodeError::Buffer(error)) => {
                prop_assert_eq!((error.needed, error.available), (expected.len(), size));
                prop_assert!(size < expected.len());
            }
            Err(error) => prop_assert!(false, "{}", error),
        }
    }

    #[test]
    fn a_packet_in_parts_is_the_packet_in_one(
        id in id(), code in any::<u8>(), params in tricky(), cut in 0..60_usize,
    ) {
        let (head, tail) = params.split_at(cut.min(params.len()));
        let mut buffer = [0; 128];
        let instruction = Instruction::from_code(code);
        let packet = frame::encode(id, instruction, &[head, tail], &mut buffer).unwrap();
        prop_assert_eq!(frame::encoded_len(instruction, &[head, tail]), Ok(packet.len()));
        prop_assert!(packet.len() <= frame::max_encoded_len(params.len()));
        prop_assert_eq!(packet, reference::frame(id, &reference::stuff(&[&[code], params.as_slice()].concat())));
        prop_assume!(code != 0x55 || !params.is_empty());
        let frame = Frame::parse(packet).unwrap();
        prop_assert_eq!((frame.id(), frame.instruction()), (id, instruction));
        prop_assert_eq!(frame.params().collect::<Vec<_>>(), params.clone());
        prop_assert_eq!(frame.params_len(), params.len());
        let mut copy = [0; 64];
        prop_assert_eq!(frame.copy_params(&mut copy).unwrap(), params);
    }

    #[test]
    fn one_flipped_bit_is_always_found(id in id(), error in any::<u8>(), data in tricky(), bit in any::<prop::sample::Index>()) {
        let mut buffer = [0; 128];
        let mut packet = status::encode(id, StatusError(error), &data, &mut buffer).unwrap().to_vec();
        let bit = bit.index(packet.len() * 8);
        packet[bit / 8] ^= 1 << (bit % 8);
        prop_assert!(Frame::parse(&packet).is_err());
    }

    #[test]
    fn fast_status_blocks_come_back(
        data_len in 0..6_usize,
        devices in vec((any::<u8>(), 0..=252_u8, any::<[u8; 6]>()), 1..6),
    ) {
        let blocks: Vec<_> = devices
            .iter()
            .map(|(error, id, data)| Block { error: StatusError(*error), id: *id, data: &data[..data_len] })
            .collect();
        let ids: Vec<_> = blocks.iter().map(|block| block.id).collect();
        let mut buffer = [0; 128];
        let packet = fast_status::encode(&blocks, &mut buffer).unwrap().to_vec();
        let length = u16::try_from(data_len).unwrap();
        let parsed = FastStatus::parse(&packet, length, &ids).unwrap();
        prop_assert_eq!(parsed.blocks().collect::<Vec<_>>(), blocks);
        // Each block's CRC runs over everything before it.
        for block in 1..=ids.len() {
            let end = 8 + block * (4 + data_len);
            let crc = u16::from_le_bytes([packet[end - 2], packet[end - 1]]);
            prop_assert_eq!(crc, reference::crc(&packet[..end - 2]));
        }
        for at in 0..packet.len() {
            let mut damaged = packet.clone();
            damaged[at] ^= 0x01;
            prop_assert!(FastStatus::parse(&damaged, length, &ids).is_err(), "byte {}", at);
        }
    }

    #[test]
    fn no_bytes_make_anything_panic(bytes in tricky(), length in any::<u16>(), ids in vec(any::<u8>(), 0..4)) {
        let mut buffer = [0; 8];
        let mut framed = vec![0xFF, 0xFF, 0xFD, 0x00];
        framed.extend(&bytes);
        for bytes in [&bytes, &framed] {
            if let Err(error) = Frame::parse(bytes) {
                prop_assert!(error.offset() <= bytes.len().max(7), "{}", error);
            }
            let _ = FastStatus::parse(bytes, length, &ids);
            let _ = stuff(bytes, &mut buffer);
            let _ = unstuff(bytes, &mut buffer);
            for instruction in Instruction::ALL {
                let layout = instruction.parameters().unwrap_or_default();
                let mut walked = 0;
                for item in layout::fields(layout, bytes).map_while(Result::ok) {
                    prop_assert_eq!(item.offset, walked);
                    walked += item.bytes.len();
                }
                prop_assert!(walked <= bytes.len());
            }
        }
    }
}
