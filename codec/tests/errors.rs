//! Each rule of the receive procedure, broken alone, is reported with its place and the expected
//! value.

#![allow(clippy::indexing_slicing)] // tests may stop at a surprise

use actucheck_codec::dynamixel2::stuffing::{UnstuffError, unstuff};
use actucheck_codec::dynamixel2::{FastStatus, Frame, FrameError};

/// The status packet of §Read in the DYNAMIXEL document.
const STATUS: [u8; 15] =
    [0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x08, 0x00, 0x55, 0x00, 0xA6, 0x00, 0x00, 0x00, 0x8C, 0xC0];

/// The answer of devices 1 and 2 in §1.6.8 of the JA40 document.
const FAST: [u8; 24] = [
    0xFF, 0xFF, 0xFD, 0x00, 0xFE, 0x11, 0x00, 0x55, 0x00, 0x01, 0xD0, 0x07, 0x00, 0x00, 0x0C, 0x83,
    0x00, 0x02, 0x09, 0x00, 0x00, 0x00, 0x11, 0x40,
];

fn status_with(at: usize, byte: u8) -> Result<(), FrameError> {
    let mut bytes = STATUS;
    bytes[at] = byte;
    Frame::parse(&bytes).map(drop)
}

#[test]
fn the_examples_themselves_are_right() {
    assert_eq!(Frame::parse(&STATUS).map(drop), Ok(()));
    assert_eq!(FastStatus::parse(&FAST, 4, &[1, 2]).map(drop), Ok(()));
}

#[test]
fn each_rule_has_its_error() {
    use FrameError::{Crc, Header, Id, Length, Trailing, Truncated};
    let cases = [
        (status_with(2, 0xFE), Header { at: 2, found: 0xFE, expected: 0xFD }),
        (status_with(3, 0xFD), Header { at: 3, found: 0xFD, expected: 0x00 }),
        (status_with(4, 0xFF), Id { found: 0xFF }),
        (status_with(4, 0xFD), Id { found: 0xFD }),
        (status_with(5, 2), Length { found: 2, expected: 3 }),
        (status_with(5, 9), Truncated { available: 15, needed: 16 }),
        (status_with(6, 0xFF), Truncated { available: 15, needed: 65_295 }),
        (status_with(5, 7), Trailing { end: 14, available: 15 }),
        (status_with(14, 0xC1), Crc { at: 13, found: 0xC18C, expected: 0xC08C }),
        (Frame::parse(&STATUS[..3]).map(drop), Truncated { available: 3, needed: 7 }),
        (
            Frame::parse(&[0xFF, 0xFF, 0xFD, 0, 0xFF]).map(drop),
            Truncated { available: 5, needed: 7 },
        ),
        (Frame::parse(&[]).map(drop), Truncated { available: 0, needed: 7 }),
    ];
    for (found, expected) in cases {
        assert_eq!(found, Err(expected));
    }
}

#[test]
fn a_status_packet_has_an_error_byte() {
    let mut bytes = *b"\xFF\xFF\xFD\x00\x01\x03\x00\x55\x00\x00";
    let crc = actucheck_codec::crc::umts(&bytes[..8]).to_le_bytes();
    bytes[8..].copy_from_slice(&crc);
    let error = FrameError::Length { found: 3, expected: 4 };
    assert_eq!(Frame::parse(&bytes).map(drop), Err(error));
}

#[test]
fn a_bare_pattern_is_rejected_although_its_crc_is_right() {
    // Write FF FF FD to 564 from an implementation that does not stuff; CRC 81 05.
    let bytes = b"\xFF\xFF\xFD\x00\x01\x08\x00\x03\x34\x02\xFF\xFF\xFD\x81\x05";
    assert_eq!(Frame::parse(bytes).map(drop), Err(FrameError::Stuffing { at: 13 }));
    let mut buffer = [0; 8];
    let bare = unstuff(b"\xFF\xFF\xFD\x01", &mut buffer);
    assert_eq!(bare, Err(UnstuffError::Bare { at: 3 }));
}

#[test]
fn a_fast_status_is_checked_block_by_block() {
    let parse = |at: usize, byte: u8, length, ids: &[u8]| {
        let mut bytes = FAST;
        bytes[at] = byte;
        FastStatus::parse(&bytes, length, ids).map(drop)
    };
    let same = FAST[0];
    let order = FrameError::BlockId { at: 9, found: 1, expected: 2 };
    assert_eq!(parse(0, same, 4, &[2, 1]), Err(order));
    let length = |expected| Err(FrameError::Length { found: 17, expected });
    assert_eq!(parse(0, same, 4, &[1]), length(9));
    assert_eq!(parse(0, same, 2, &[1, 2]), length(13));
    assert_eq!(parse(0, same, 4, &[]), length(1));
    assert!(matches!(parse(7, 0x03, 4, &[1, 2]), Err(FrameError::Instruction { found: 3 })));
}

#[test]
fn the_crc_of_an_inner_block_counts() {
    // The first block's CRC is wrong, the packet's own is right for what it covers.
    let mut bytes = FAST;
    bytes[14] ^= 0x01;
    let crc = actucheck_codec::crc::umts(&bytes[..22]).to_le_bytes();
    bytes[22..].copy_from_slice(&crc);
    let error = FrameError::Crc { at: 14, found: 0x830D, expected: 0x830C };
    assert_eq!(FastStatus::parse(&bytes, 4, &[1, 2]).map(drop), Err(error));
}
