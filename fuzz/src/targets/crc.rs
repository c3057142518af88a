//! Both CRCs: the fast implementations against the bitwise ones, for any alignment and division of
//! the bytes.

use actucheck_codec::crc::{self, Engine, MODBUS_INIT, UMTS_INIT};
use actucheck_spec::wire::{dynamixel2, innfos};

use crate::draw::Draw;

/// The longest message, used for some inputs: long enough for every path of the engines.
const LONG: usize = 1200;

/// The input is a message, or the repeated part of a long one.
///
/// # Panics
/// If the codec is wrong.
pub fn check(input: &[u8]) {
    let mut draw = Draw::of(input);
    let times = if draw.below(128) == 0 { LONG / input.len().max(1) } else { 1 };
    let message = input.repeat(times);
    let place = draw.below(64);
    let cut = draw.below(message.len() + 1);
    check_at(&message, place, cut);
    a_flipped_bit_is_found(message, draw.below(8 * LONG));
}

/// Compares the CRCs of a message with the reference, whole and in two parts. The message begins
/// `place` bytes after a multiple of 64.
///
/// # Panics
/// If the codec is wrong.
pub fn check_at(message: &[u8], place: usize, cut: usize) {
    let mut room = vec![0; 64 + place + message.len()];
    let start = room.as_ptr().align_offset(64) + place;
    let bytes = &mut room[start..start + message.len()];
    bytes.copy_from_slice(message);

    let (umts, modbus) = (dynamixel2::reference::crc(bytes), innfos::reference::crc(bytes));
    assert_eq!((crc::umts(bytes), crc::modbus(bytes)), (umts, modbus));
    let (head, tail) = bytes.split_at(cut);
    for engine in Engine::all() {
        assert_eq!(engine.umts(bytes), umts, "{engine:?}");
        assert_eq!(engine.modbus(bytes), modbus, "{engine:?}");
        assert_eq!(engine.umts_update(engine.umts(head), tail), umts, "{engine:?}, cut at {cut}");
        let behind_head = engine.modbus_update(engine.modbus(head), tail);
        assert_eq!(behind_head, modbus, "{engine:?}, cut at {cut}");
    }
    // From the parts' own CRCs.
    let count = tail.len() as u64;
    let joined = crc::umts_shift(crc::umts(head) ^ UMTS_INIT, count) ^ crc::umts(tail);
    assert_eq!(joined, umts, "shifted by {count}");
    let joined = crc::modbus_shift(crc::modbus(head) ^ MODBUS_INIT, count) ^ crc::modbus(tail);
    assert_eq!(joined, modbus, "shifted by {count}");
}

fn a_flipped_bit_is_found(mut message: Vec<u8>, bit: usize) {
    if message.is_empty() {
        return;
    }
    let before = (crc::umts(&message), crc::modbus(&message));
    let bit = bit % (8 * message.len());
    message[bit / 8] ^= 1 << (bit % 8);
    assert_ne!(crc::umts(&message), before.0, "bit {bit}");
    assert_ne!(crc::modbus(&message), before.1, "bit {bit}");
}
