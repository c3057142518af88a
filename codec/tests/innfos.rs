//! INNFOS frames and messages against the documents' vectors, the YAML, and themselves.

#![allow(clippy::unwrap_used, clippy::indexing_slicing, clippy::panic)] // tests may stop

use std::sync::LazyLock;

use actucheck_codec::innfos::{
    self, ACTUATORS, Actuator, Alarms, Command, Direction, Flag, Format, Frame, FrameError,
    FullScale, Iq8, Iq24, Mac, Message, MessageError, Mode, Operation, Value,
};
use actucheck_codec::{BufferTooSmall, EncodeError};
use actucheck_spec::Spec;
use actucheck_spec::model::{Fault, Outcome, Vector};
use actucheck_spec::wire::innfos as model;
use actucheck_spec::wire::{self, Packet};
use proptest::collection::vec;
use proptest::prelude::*;

static SPEC: LazyLock<Spec> = LazyLock::new(|| Spec::embedded().unwrap());

fn vectors() -> impl Iterator<Item = &'static Vector> {
    SPEC.vectors().filter(|(file, _)| file.wire == model::WIRE).map(|(_, vector)| vector)
}

/// Direction, address, command and data.
fn parts(vector: &Vector) -> Option<(Direction, u8, u8, &[u8])> {
    let Packet::Innfos(packet) = vector.packet.as_ref()? else { panic!("{}", vector.id) };
    let model::Packet { direction, address, command, data } = packet;
    Some((of(*direction), *address, *command, data))
}

fn of(direction: wire::Direction) -> Direction {
    match direction {
        wire::Direction::Request => Direction::Request,
        wire::Direction::Reply => Direction::Reply,
    }
}

fn fault(error: FrameError) -> Fault {
    match error {
        FrameError::Header { .. } => Fault::Header,
        FrameError::Truncated { .. } => Fault::Truncated,
        FrameError::Tail { .. } => Fault::Tail,
        FrameError::Trailing { .. } => Fault::Trailing,
        FrameError::Crc { .. } => Fault::Crc,
    }
}

#[test]
fn every_vector_is_built_and_read_or_refused() {
    let mut count = 0;
    for vector in vectors() {
        count += 1;
        let id = &vector.id;
        let Some((direction, address, command, data)) = parts(vector) else {
            let error = Frame::parse(of(vector.direction.unwrap()), vector.frame()).unwrap_err();
            assert_eq!(Some(fault(error)), vector.fault, "{id}: {error}");
            assert!(error.offset() <= vector.frame().len(), "{id}");
            continue;
        };
        let command = Command::from_code(command);
        let frame = Frame::parse(direction, vector.frame()).unwrap_or_else(|e| panic!("{id}: {e}"));
        assert_eq!((frame.direction(), frame.address()), (direction, address), "{id}");
        assert_eq!((frame.command(), frame.data()), (command, data), "{id}");
        let mut buffer = [0; 512];
        let built = innfos::encode(direction, address, command, data, &mut buffer).unwrap();
        if vector.result == Outcome::Valid {
            assert_eq!(built, vector.frame(), "{id}");
            let message = Message::parse(&frame).unwrap_or_else(|e| panic!("{id}: {e}"));
            let mut buffer = [0; 14];
            assert_eq!(message.encode(&mut buffer).unwrap(), vector.frame(), "{id}");
        } else {
            assert_eq!(Frame::parse(direction, built), Ok(frame), "{id}");
        }
        if let Some(printed) = vector.defective() {
            let error = Frame::parse(direction, printed).err().map(fault);
            assert_eq!(error, vector.printed_fault, "{id}");
        }
    }
    assert!(count > 60, "{count} vectors");
}

#[test]
fn every_command_is_that_of_the_yaml() {
    let said = &SPEC.wires.innfos.content;
    assert_eq!(Command::ALL.len(), said.commands.len());
    for said_row in &said.commands {
        let command = Command::from_code(said_row.code);
        let row = command.row().unwrap();
        assert_eq!(command.code(), said_row.code);
        assert!(command.name().ends_with(&said_row.name), "{}", command.name());
        assert_eq!(said_row.operation == model::Operation::Read, row.operation == Operation::Read);
        assert_eq!((said_row.request, said_row.reply.as_slice()), (row.request, row.reply));
        assert_eq!(said_row.unit.as_deref(), row.unit);
        let full_scale = row.full_scale.map(|scale| match scale {
            FullScale::Current => model::FullScale::Current,
            FullScale::MotorSpeed => model::FullScale::MotorSpeed,
        });
        assert_eq!(said_row.full_scale, full_scale);
        assert_eq!(said_row.format, row.format.map(said_format), "{}", said_row.name);
        if let Some(format) = row.format {
            let said_sizes = &said.format(said_format(format)).unwrap().sizes;
            assert_eq!(said_sizes, format.sizes());
            if let Format::Scaled { factor } = format {
                assert_eq!(said_row.factor.unwrap().to_bits(), factor.to_bits());
            }
        }
    }
    let fraction = |format| said.format(format).unwrap().fraction_bits.map(u32::from);
    assert_eq!(fraction(model::Format::Iq8), Some(Iq8::FRACTION_BITS));
    assert_eq!(fraction(model::Format::Iq24), Some(Iq24::FRACTION_BITS));
}

fn said_format(format: Format) -> model::Format {
    match format {
        Format::Flag => model::Format::Flag,
        Format::Mode => model::Format::Mode,
        Format::Alarms => model::Format::Alarms,
        Format::Iq8 => model::Format::Iq8,
        Format::Iq24 => model::Format::Iq24,
        Format::Scaled { .. } => model::Format::Scaled,
        Format::Mac => model::Format::Mac,
    }
}

#[test]
fn modes_alarms_and_models_are_those_of_the_yaml() {
    let said = &SPEC.wires.innfos.content;
    for code in 0..=u8::MAX {
        assert_eq!(Mode::from_code(code).code(), code);
        let row = said.modes.rows.iter().find(|row| row.code == code);
        let name = row.map_or("unknown", |row| row.name.as_str());
        assert_eq!(Mode::from_code(code).name(), name);
    }
    let named: u16 = said.alarms.rows.iter().map(|row| row.mask).sum();
    assert_eq!(Alarms(u16::MAX).others(), !named);
    let alarms = Alarms(0x0005);
    assert!(alarms.overvoltage() && alarms.locked_rotor() && !alarms.undervoltage());
    assert_eq!(alarms.with_overvoltage(false).with_driver_protection(true), Alarms(0x0404));
    assert_eq!(ACTUATORS.len(), said.actuators.rows.len());
    for (row, actuator) in said.actuators.rows.iter().zip(ACTUATORS) {
        let said = [row.current, row.motor_speed, row.output_speed].map(f64::to_bits);
        let found = [actuator.current, actuator.motor_speed, actuator.output_speed];
        assert_eq!((row.name.as_str(), said), (actuator.name, found.map(f64::to_bits)));
    }
}

#[test]
fn a_message_that_no_table_allows_is_refused() {
    let mut buffer = [0; 16];
    let command = Command::WritePosition;
    let without = Message::request(1, command, None).encode(&mut buffer);
    assert_eq!(without, Err(MessageError::Value { command }));
    let flag = Message::request(1, command, Some(Value::Flag(Flag::YES))).encode(&mut buffer);
    assert_eq!(flag, Err(MessageError::Value { command }));
    let reply = Message::reply(1, command, Some(Value::Flag(Flag::YES))).encode(&mut buffer);
    assert_eq!(reply, Err(MessageError::NoReply { command }));
    let unknown = Message::request(1, Command::Unknown(0xED), None).encode(&mut buffer);
    assert_eq!(unknown, Err(MessageError::Unknown { code: 0xED }));
    let too_small = EncodeError::Buffer(BufferTooSmall { needed: 12, available: 11 });
    let value = Some(Value::Iq24(Iq24(0)));
    let small = Message::request(1, command, value).encode(&mut buffer[..11]);
    assert_eq!(small, Err(MessageError::Encode(too_small)));
    let data = innfos::encode(Direction::Request, 1, command, &[1, 2], &mut buffer).unwrap();
    let frame = Frame::parse(Direction::Request, data).unwrap();
    let size = MessageError::Size { command, found: 2, expected: &[4] };
    assert_eq!(Message::parse(&frame), Err(size));
}

#[test]
fn a_frame_that_ends_early_tells_its_size() {
    let mut buffer = [0; 16];
    for (direction, data) in
        [(Direction::Request, &[][..]), (Direction::Request, &[1]), (Direction::Reply, &[1, 2])]
    {
        let frame =
            innfos::encode(direction, 1, Command::from_code(0x06), data, &mut buffer).unwrap();
        for available in 0..frame.len() {
            // Without a length, the size of the smallest frame is expected.
            let needed = if available < 5 { 6 } else { frame.len() };
            let error = FrameError::Truncated { available, needed };
            assert_eq!(
                Frame::parse(direction, &frame[..available]).map(drop),
                Err(error),
                "{frame:?}"
            );
        }
    }
}

#[test]
fn a_flag_is_yes_or_no_or_neither() {
    assert_eq!(
        (0..=2).map(|byte| Flag(byte).is_yes()).collect::<Vec<_>>(),
        [Some(false), Some(true), None]
    );
    assert_eq!((Flag::NO, Flag::YES), (Flag(0), Flag(1)));
}

#[test]
fn what_follows_a_damaged_frame_is_lost() {
    let good = b"\xEE\x06\x07\x00\x01\x01\xED";
    let datagram = [good, &b"\xEE\x06\x07\x00\x01\x01\xEC"[..], good].concat();
    let found: Vec<_> = innfos::frames(Direction::Reply, &datagram).collect();
    assert_eq!(found.len(), 2);
    assert_eq!(found[0], Frame::parse(Direction::Reply, good));
    assert_eq!(found[1], Err(FrameError::Tail { at: 6, found: 0xEC }));
}

#[test]
fn the_high_byte_comes_first() {
    // 1 with 24 fractional bits is 0x0100_0000, with 8 fractional bits 0x0100.
    let one = Value::Iq24(Iq24::from_f64(1.0).unwrap());
    assert_eq!(one.encode().as_bytes(), [0x01, 0x00, 0x00, 0x00]);
    assert_eq!(Value::decode(Format::Iq24, &[0x01, 0x00, 0x00, 0x00]), Some(one));
    let one = Value::Iq8(Iq8::from_f64(1.0).unwrap());
    assert_eq!(one.encode().as_bytes(), [0x01, 0x00]);
    assert_eq!(Value::decode(Format::Iq8, &[0x01, 0x00]), Some(one));
    assert_eq!(Value::Scaled(0x0102_0304).encode().as_bytes(), [1, 2, 3, 4]);
}

/// A value of the format, from any bits.
fn value(format: Format, bits: i32, six: [u8; 6]) -> Value {
    let [a, b, ..] = bits.to_be_bytes();
    match format {
        Format::Flag => Value::Flag(Flag(a)),
        Format::Mode => Value::Mode(Mode::from_code(a)),
        Format::Alarms => Value::Alarms(Alarms(u16::from_be_bytes([a, b]))),
        Format::Iq8 => Value::Iq8(Iq8(i16::from_be_bytes([a, b]))),
        Format::Iq24 => Value::Iq24(Iq24(bits)),
        Format::Scaled { .. } => Value::Scaled(bits),
        Format::Mac => Value::Mac(Mac::new(&six[..if a > 99 { 4 } else { 6 }]).unwrap()),
    }
}

/// The full scale in the YAML.
fn said_scale(code: u8, actuator: &Actuator) -> f64 {
    match SPEC.wires.innfos.content.command(code).unwrap().full_scale {
        None => 1.0,
        Some(model::FullScale::Current) => actuator.current,
        Some(model::FullScale::MotorSpeed) => actuator.motor_speed,
    }
}

fn direction() -> impl Strategy<Value = Direction> {
    prop_oneof![Just(Direction::Request), Just(Direction::Reply)]
}

/// Bytes in which those of frames are common.
fn tricky() -> impl Strategy<Value = Vec<u8>> {
    let byte = prop_oneof![
        4 => Just(0xEE_u8), 3 => Just(0xED), 4 => 0..3_u8, 2 => Just(0x44), 1 => any::<u8>(),
    ];
    vec(byte, 0..40)
}

proptest! {
    #[test]
    fn every_message_comes_back(
        address in any::<u8>(), bits in any::<i32>(), six in any::<[u8; 6]>(),
    ) {
        for command in Command::ALL {
            let row = command.row().unwrap();
            let value = row.format.map(|format| value(format, bits, six));
            let answer = Some(Value::Flag(Flag(six[0])));
            let (request, reply) = match row.operation {
                Operation::Read => (None, value),
                Operation::Write => (value, answer),
            };
            let mut messages = vec![Message::request(address, command, request)];
            if !row.reply.is_empty() {
                messages.push(Message::reply(address, command, reply));
            }
            for message in messages {
                let mut buffer = [0; 14];
                let bytes = message.encode(&mut buffer).unwrap();
                let frame = Frame::parse(message.direction, bytes).unwrap();
                prop_assert_eq!(Message::parse(&frame), Ok(message));
                let size = u16::try_from(frame.data().len()).unwrap();
                match message.direction {
                    Direction::Request => prop_assert_eq!(size, row.request),
                    Direction::Reply => prop_assert!(row.reply.contains(&size)),
                }
            }
        }
    }

    #[test]
    fn every_frame_comes_back(
        direction in direction(), address in any::<u8>(), code in any::<u8>(), data in tricky(),
        tail in tricky(),
    ) {
        let command = Command::from_code(code);
        let mut buffer = [0; 64];
        let bytes = innfos::encode(direction, address, command, &data, &mut buffer).unwrap().to_vec();
        let frame = Frame::parse(direction, &bytes).unwrap();
        prop_assert_eq!((frame.direction(), frame.address()), (direction, address));
        prop_assert_eq!((frame.command(), frame.data()), (command, data.as_slice()));
        let (needed, available) = (bytes.len(), bytes.len() - 1);
        let error = innfos::encode(direction, address, command, &data, &mut buffer[..available]);
        let too_small = EncodeError::Buffer(BufferTooSmall { needed, available });
        prop_assert_eq!(error, Err(too_small));
        for end in 0..bytes.len() {
            prop_assert!(Frame::parse(direction, &bytes[..end]).is_err());
        }
        let followed = [bytes.as_slice(), &tail].concat();
        let (first, rest) = Frame::first(direction, &followed).unwrap();
        let open = direction == Direction::Reply && [0x02, 0x44].contains(&code) && data.len() == 1;
        if !open {
            prop_assert_eq!((first, rest), (frame, tail.as_slice()));
        }
        let both = [bytes.as_slice(), &bytes].concat();
        prop_assert_eq!(innfos::frames(direction, &both).count(), 2);
    }

    #[test]
    fn fixed_point_numbers_are_the_nearest(bits in any::<i32>(), value in -140.0..140.0_f64) {
        prop_assert_eq!(Iq24::from_f64(Iq24(bits).to_f64()), Some(Iq24(bits)));
        let short = Iq8(i16::from_be_bytes([bits.to_be_bytes()[0], bits.to_be_bytes()[1]]));
        prop_assert_eq!(Iq8::from_f64(short.to_f64()), Some(short));
        let inside = value.clamp(-128.0, 128.0 - 1.0 / 16_777_216.0);
        let error = Iq24::from_f64(value).unwrap().to_f64() - inside;
        prop_assert!(error.abs() <= 0.5 / 16_777_216.0, "{}", error);
        let inside = value.clamp(-128.0, 128.0 - 1.0 / 256.0);
        let error = Iq8::from_f64(value).unwrap().to_f64() - inside;
        prop_assert!(error.abs() <= 0.5 / 256.0, "{}", error);
    }

    #[test]
    fn quantities_come_back(bits in any::<i32>(), index in 0..ACTUATORS.len()) {
        let actuator = &ACTUATORS[index];
        for command in Command::ALL {
            let format = command.row().unwrap().format;
            let Some(value) = format.map(|format| value(format, bits, [0; 6])) else { continue };
            let scale = said_scale(command.code(), actuator);
            let expected = match value {
                Value::Iq8(number) => Some(f64::from(number.0) / 256.0 * scale),
                Value::Iq24(number) => Some(f64::from(number.0) / 16_777_216.0 * scale),
                Value::Scaled(number) => Some(f64::from(number) / 75.225),
                _ => None,
            };
            let physical = command.physical(value, actuator);
            prop_assert_eq!(physical, expected, "{}", command.name());
            let back = physical.and_then(|physical| command.from_physical(physical, actuator));
            prop_assert_eq!(back, expected.map(|_| value), "{}", command.name());
        }
    }

    #[test]
    fn far_quantities_saturate_and_none_panics(physical in any::<f64>()) {
        for command in Command::ALL.into_iter().chain([Command::Unknown(0xED)]) {
            let value = command.from_physical(physical, &ACTUATORS[0]);
            prop_assert!(value.is_none() || !physical.is_nan());
        }
        let largest = Command::WriteStallEnergy.from_physical(f64::INFINITY, &ACTUATORS[0]);
        prop_assert_eq!(largest, Some(Value::Scaled(i32::MAX)));
        let smallest = Command::WriteSpeed.from_physical(-1e30, &ACTUATORS[0]);
        prop_assert_eq!(smallest, Some(Value::Iq24(Iq24(i32::MIN))));
    }

    #[test]
    fn no_bytes_make_anything_panic(direction in direction(), bytes in tricky()) {
        let framed = [&[0xEE, 0x00, 0x44, 0x00], bytes.as_slice()].concat();
        for bytes in [&bytes, &framed] {
            if let Err(error) = Frame::parse(direction, bytes) {
                prop_assert!(error.offset() <= bytes.len(), "{}", error);
            }
            let frames = innfos::frames(direction, bytes).map_while(Result::ok);
            let taken: usize = frames.map(|frame| {
                let _ = Message::parse(&frame);
                frame.data().len() + 6
            }).sum();
            prop_assert!(taken <= bytes.len());
            for format in Command::ALL.iter().filter_map(|command| command.row()?.format) {
                if let Some(value) = Value::decode(format, bytes) {
                    let data = value.encode();
                    prop_assert_eq!(data.as_bytes(), bytes.as_slice());
                }
            }
        }
    }
}
