//! The ends of what can vary: lengths that need both bytes, as many devices as a wire has, and the
//! bits and units of registers.

#![allow(clippy::unwrap_used)] // tests may stop at a surprise

use actucheck_codec::dynamixel2::fast_status::{self, Block};
use actucheck_codec::dynamixel2::instruction::{
    BulkRead, BulkWrite, DeviceData, DeviceRange, DeviceWrite, FastSyncRead, FastSyncWrite,
    SyncRead, SyncWrite,
};
use actucheck_codec::dynamixel2::{FastStatus, Frame, Request, StatusError};
use actucheck_codec::innfos::{self, Command, Direction};
use actucheck_codec::ja40;
use actucheck_codec::register::BitField;
use actucheck_spec::wire::dynamixel2::reference as dynamixel2;
use actucheck_spec::wire::innfos::reference as modbus;

/// Every ID that a device may have.
const IDS: std::ops::RangeInclusive<u8> = 0..=252;

#[test]
fn innfos_data_may_have_more_than_a_byte_can_count() {
    for size in [254, 255, 256, 257, 65_535_u16] {
        let data = vec![0xED; size.into()];
        // Header, address, command, the length with its high byte first, data, CRC, end.
        let crc = modbus::crc(&data).to_le_bytes();
        let frame = [&[0xEE, 6, 0x2A], &size.to_be_bytes()[..], &data, &crc, &[0xED]].concat();
        let command = Command::from_code(0x2A);
        let mut buffer = vec![0; frame.len()];
        for direction in [Direction::Request, Direction::Reply] {
            assert_eq!(
                innfos::encode(direction, 6, command, &data, &mut buffer).unwrap(),
                frame,
                "{size} bytes"
            );
            let read = innfos::Frame::parse(direction, &frame).unwrap();
            assert_eq!((read.address(), read.command(), read.data()), (6, command, &data[..]));
        }
    }
}

/// The frame of an instruction to all devices.
fn to_all(code: u8, params: &[u8]) -> Vec<u8> {
    dynamixel2::frame(dynamixel2::BROADCAST, &dynamixel2::stuff(&[&[code], params].concat()))
}

/// A packet is the same again after it was read and its request encoded.
fn comes_back(bytes: &[u8]) {
    let (mut scratch, mut buffer) = (vec![0; bytes.len()], vec![0; bytes.len()]);
    let frame = Frame::parse(bytes).unwrap();
    let request = Request::parse(&frame, &mut scratch).unwrap();
    assert_eq!(request.encode(dynamixel2::BROADCAST, &mut buffer).unwrap(), bytes);
}

#[test]
fn an_instruction_may_name_every_device() {
    let ids: Vec<u8> = IDS.collect();
    let mut buffer = vec![0; 4096];
    let head = [0x44, 0x02, 1, 0];

    let expected = to_all(0x82, &[&head, &ids[..]].concat());
    let read = SyncRead { address: 580, length: 1, ids: &ids };
    assert_eq!(read.encode(&mut buffer).unwrap(), expected);
    comes_back(&expected);
    let expected = to_all(0x8A, &[&head, &ids[..]].concat());
    let read = FastSyncRead { address: 580, length: 1, ids: &ids };
    assert_eq!(read.encode(&mut buffer).unwrap(), expected);
    comes_back(&expected);

    let data: Vec<_> = ids.iter().map(|id| [id ^ 0x5A]).collect();
    let devices = ids.iter().zip(&data).map(|(id, data)| DeviceData { id: *id, data });
    let each: Vec<u8> = ids.iter().zip(&data).flat_map(|(id, data)| [*id, data[0]]).collect();
    let expected = to_all(0x83, &[&head, &each[..]].concat());
    let write = SyncWrite { address: 580, length: 1, devices: devices.clone() };
    assert_eq!(write.encode(&mut buffer).unwrap(), expected);
    comes_back(&expected);
    let expected = to_all(0x8B, &[&head, &each[..]].concat());
    let write = FastSyncWrite { address: 580, length: 1, devices };
    assert_eq!(write.encode(&mut buffer).unwrap(), expected);
    comes_back(&expected);

    let devices = ids.iter().map(|id| DeviceRange { id: *id, address: 580, length: 1 });
    let each: Vec<u8> = ids.iter().flat_map(|id| [&[*id][..], &head].concat()).collect();
    let expected = to_all(0x92, &each);
    assert_eq!(BulkRead { devices }.encode(&mut buffer).unwrap(), expected);
    comes_back(&expected);

    let devices =
        ids.iter().zip(&data).map(|(id, data)| DeviceWrite { id: *id, address: 580, data });
    let each = ids.iter().zip(&data).flat_map(|(id, data)| [&[*id][..], &head, data].concat());
    let expected = to_all(0x93, &each.collect::<Vec<_>>());
    assert_eq!(BulkWrite { devices }.encode(&mut buffer).unwrap(), expected);
    comes_back(&expected);
}

#[test]
fn every_device_may_answer_in_one_packet() {
    let ids: Vec<u8> = IDS.collect();
    let data: Vec<_> = ids.iter().map(|id| [*id, 0xFF, 0xFF, 0xFD]).collect();
    let block = |(id, data)| Block { error: StatusError(id ^ 0x80), id, data };
    let blocks: Vec<_> =
        ids.iter().copied().zip(&data).map(|(id, data)| block((id, data))).collect();
    let length = u16::try_from(1 + 8 * blocks.len()).unwrap().to_le_bytes();
    let mut expected =
        [&dynamixel2::HEADER[..], &[dynamixel2::BROADCAST], &length, &[0x55]].concat();
    for Block { error, id, data } in &blocks {
        expected.extend([error.0, *id].iter().chain(*data));
        expected.extend(dynamixel2::crc(&expected).to_le_bytes());
    }
    let mut buffer = vec![0; expected.len()];
    assert_eq!(fast_status::encode(&blocks, &mut buffer).unwrap(), expected);
    let read = FastStatus::parse(&expected, 4, &ids).unwrap();
    assert_eq!(read.blocks().collect::<Vec<_>>(), blocks);
}

#[test]
fn a_bit_field_is_its_bits_and_no_others() {
    let of = |lowest, width, value| BitField { name: "", lowest, width, values: &[] }.of(value);
    assert_eq!(of(0, 1, 0b1011), 1);
    assert_eq!(of(2, 1, 0b1011), 0);
    assert_eq!(of(4, 2, 0x31), 3);
    assert_eq!(of(4, 4, 0xA5), 0xA);
    assert_eq!(of(7, 1, 0x7F), 0);
    // The bits of a negative number are those of its two's complement.
    assert_eq!(of(0, 8, -1), 0xFF);
    assert_eq!(of(8, 8, -2), 0xFF);
    assert_eq!(of(0, 64, -2), -2);
    assert_eq!(of(64, 1, -1), 0);
}

/// The units as the JA40 document prints them.
#[test]
fn a_physical_value_is_the_count_times_the_unit() {
    let near = |found: Option<f64>, expected: f64| {
        assert!(
            found.is_some_and(|found| (found - expected).abs() < 1e-9),
            "{found:?}, {expected}"
        );
    };
    near(ja40::GOAL_VELOCITY.physical(-1234), -12.34); // 0.01 rev/min
    near(ja40::GOAL_CURRENT.physical(1000), 2_517.7); // 2.5177 mA
    assert_eq!(ja40::GOAL_VELOCITY.from_physical(-12.344), Some(-1234));
    assert_eq!(ja40::ID.physical(1), None, "it has no unit");
}
