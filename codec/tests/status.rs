//! Status packets by their meaning.

#![allow(clippy::unwrap_used)] // tests may stop at a surprise

use actucheck_codec::dynamixel2::status::{self, PingStatus, StatusError};
use actucheck_codec::dynamixel2::{Frame, FrameError, Instruction};
use actucheck_codec::layout;
use actucheck_codec::register::RegisterError;
use actucheck_codec::{BufferTooSmall, ja40};
use proptest::prelude::*;

#[test]
fn an_instruction_is_no_status() {
    let frame = Frame::parse(b"\xFF\xFF\xFD\x00\x01\x03\x00\x01\x19\x4E").unwrap();
    assert_eq!(frame.status(), Err(FrameError::Instruction { found: 1 }));
}

#[test]
fn frames_are_equal_that_say_the_same() {
    let (mut one, mut two) = ([0; 32], [0; 64]);
    let mut same = |id, error, data| {
        let one = status::encode(1, StatusError(0x80), b"\xFF\xFF\xFD", &mut one).unwrap();
        let two = status::encode(id, StatusError(error), data, &mut two).unwrap();
        Frame::parse(one).unwrap() == Frame::parse(two).unwrap()
    };
    assert!(same(1, 0x80, b"\xFF\xFF\xFD"));
    assert!(!same(2, 0x80, b"\xFF\xFF\xFD"));
    assert!(!same(1, 0x00, b"\xFF\xFF\xFD"));
    assert!(!same(1, 0x80, b"\xFF\xFF\xFE"));
}

#[test]
fn a_wrong_size_is_told_with_its_place() {
    // Two bytes of model number, one of firmware version.
    let offset = |data| PingStatus::parse(data).map_err(|error| error.offset());
    assert_eq!(offset(&[0]), Err(0));
    assert_eq!(offset(&[0; 2]), Err(2));
    assert_eq!(offset(&[0; 4]), Err(3));
}

/// Data of a status packet, including patterns of byte stuffing.
fn data() -> impl Strategy<Value = Vec<u8>> {
    prop::collection::vec(prop_oneof![3 => Just(0xFF_u8), 2 => Just(0xFD), 1 => any::<u8>()], 0..12)
}

proptest! {
    #[test]
    fn the_highest_bit_is_the_alert(byte in any::<u8>()) {
        let error = StatusError(byte);
        prop_assert_eq!(error.alert(), byte >= 128);
        prop_assert_eq!(error.number().code(), byte % 128);
    }

    #[test]
    fn the_answer_to_a_ping_comes_back(
        model_number in any::<u16>(), firmware_version in any::<u8>(), error in any::<u8>(),
    ) {
        let ping = PingStatus { model_number, firmware_version };
        let mut buffer = [0; 32];
        let packet = ping.encode(1, StatusError(error), &mut buffer).unwrap();
        let status = Frame::parse(packet).unwrap().status().unwrap();
        prop_assert_eq!((status.id(), status.error()), (1, StatusError(error)));
        prop_assert_eq!(status.ping(), Ok(ping));
    }

    #[test]
    fn data_are_what_they_were(data in data(), error in any::<u8>()) {
        let (mut buffer, mut copy) = ([0; 32], [0; 12]);
        let packet = status::encode(7, StatusError(error), &data, &mut buffer).unwrap();
        let status = Frame::parse(packet).unwrap().status().unwrap();
        prop_assert_eq!(status.data().collect::<Vec<_>>(), data.clone());
        prop_assert_eq!(status.data_len(), data.len());
        prop_assert_eq!(status.copy_data(&mut copy).unwrap(), data.clone());
        if let Some(available) = data.len().checked_sub(1) {
            let too_small = BufferTooSmall { needed: data.len(), available };
            let mut small = vec![0; available];
            prop_assert_eq!(status.copy_data(&mut small), Err(too_small));
        }

        let register = ja40::PRESENT_POSITION;
        let expected = <[u8; 4]>::try_from(data.as_slice()).map(i32::from_le_bytes).map_err(|_| {
            RegisterError::Size { register: register.row.name, found: data.len(), expected: 4 }
        });
        prop_assert_eq!(status.value(register), expected);

        let layout = Instruction::Ping.status().unwrap();
        let expected = layout::fields(layout, &data).find_map(Result::err);
        prop_assert_eq!(status.ping().err(), expected);
        prop_assert_eq!(PingStatus::parse(&data).err(), expected);
    }
}
