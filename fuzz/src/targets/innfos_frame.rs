//! INNFOS frames and messages: decoded and encoded, against the reference and the YAML.

use std::sync::LazyLock;

use actucheck_codec::innfos::{
    self, ACTUATORS, Command, Format, Frame, FrameError, Message, MessageError, Value,
};
use actucheck_codec::{BufferTooSmall, EncodeError};
use actucheck_spec::model::Fault;
use actucheck_spec::wire::Direction;
use actucheck_spec::wire::innfos::{FullScale, Innfos, Operation, Packet, reference};
use arbitrary::{Result, Unstructured};

use crate::targets::shown;
use crate::yaml;

static INNFOS: LazyLock<Innfos> = LazyLock::new(|| yaml::read("wires/innfos.yaml"));
/// For each code and [direction](WAYS), the sizes that the data may have; `None` if there is no
/// such frame.
static SIZES: LazyLock<Vec<[Option<&[u16]>; 2]>> = LazyLock::new(|| {
    (0..=0xFF).map(|code| WAYS.map(|(direction, _)| sizes(direction, code))).collect()
});

/// Both directions of a frame.
pub(super) const WAYS: [(innfos::Direction, Direction); 2] = [
    (innfos::Direction::Request, Direction::Request),
    (innfos::Direction::Reply, Direction::Reply),
];

/// The input is read as a frame, and then as choices from which a frame is built.
///
/// # Panics
/// If the codec is wrong.
pub fn check(input: &[u8]) {
    for (direction, said) in WAYS {
        read(direction, said, input);
    }
    // The choices may end early; then there is no frame.
    let _ = build(&mut Unstructured::new(input));
}

/// The codec finds the same frame or the same fault as the reference.
fn read(direction: innfos::Direction, said: Direction, bytes: &[u8]) {
    let expected = reference::decode(said, bytes);
    let frame = match Frame::parse(direction, bytes) {
        Ok(frame) => frame,
        Err(error) => {
            assert!(error.offset() <= bytes.len(), "{error}");
            shown(&error);
            return assert_eq!(Err(fault(error)), expected, "{direction:?}");
        }
    };
    assert_eq!(Ok(packet(&frame)), expected);
    understood(&frame);
    built(direction, frame.address(), frame.command(), frame.data());
}

/// The content of the frame, in the YAML's terms.
pub(super) fn packet(frame: &Frame<'_>) -> Packet {
    let (address, command) = (frame.address(), frame.command().code());
    let data = frame.data().to_vec().into();
    Packet { direction: model(frame.direction()), address, command, data }
}

const fn model(direction: innfos::Direction) -> Direction {
    match direction {
        innfos::Direction::Request => Direction::Request,
        innfos::Direction::Reply => Direction::Reply,
    }
}

/// The fault that the reference reports.
const fn fault(error: FrameError) -> Fault {
    match error {
        FrameError::Header { .. } => Fault::Header,
        FrameError::Truncated { .. } => Fault::Truncated,
        FrameError::Tail { .. } => Fault::Tail,
        FrameError::Trailing { .. } => Fault::Trailing,
        FrameError::Crc { .. } => Fault::Crc,
    }
}

/// A message is allowed by a row of the YAML, and encoding it yields the same bytes.
fn understood(frame: &Frame<'_>) {
    let message = Message::parse(frame).inspect_err(shown);
    let way = usize::from(frame.direction() == innfos::Direction::Reply);
    let sizes = SIZES[usize::from(frame.command().code())][way].unwrap_or_default();
    let allowed = sizes.iter().any(|size| usize::from(*size) == frame.data().len());
    assert_eq!(message.is_ok(), allowed, "{frame:?}");
    let Ok(message) = message else { return };
    let mut buffers = [[0; 14]; 2];
    let [one, two] = &mut buffers;
    let again =
        innfos::encode(frame.direction(), frame.address(), frame.command(), frame.data(), one);
    assert_eq!(message.encode(two).unwrap(), again.unwrap(), "{message:?}");
}

/// See [`SIZES`].
fn sizes(direction: innfos::Direction, code: u8) -> Option<&'static [u16]> {
    let innfos = &*INNFOS;
    let command = innfos.command(code)?;
    let value = || command.format.map_or(&[0][..], |format| &innfos.format(format).unwrap().sizes);
    match (direction, command.operation) {
        (innfos::Direction::Reply, _) if command.reply.is_empty() => None,
        (innfos::Direction::Request, Operation::Read) => Some(&[0]),
        (innfos::Direction::Request, Operation::Write)
        | (innfos::Direction::Reply, Operation::Read) => Some(value()),
        (innfos::Direction::Reply, Operation::Write) => Some(&[1]),
    }
}

fn build(choices: &mut Unstructured<'_>) -> Result<()> {
    let (direction, _) = *choices.choose(&WAYS)?;
    let (address, code) = choices.arbitrary()?;
    if choices.arbitrary()? {
        let command = Command::from_code(code);
        assert_eq!(command.code(), code);
        // Sometimes more data than the low byte of the length can state.
        let most = if choices.ratio(1, 16)? { 280 } else { 12 };
        let size = choices.int_in_range(0..=most)?;
        built(direction, address, command, choices.bytes(size.min(choices.len()))?);
        return Ok(());
    }
    let command = *choices.choose(&Command::ALL)?;
    let format = command.row().and_then(|row| row.format);
    let value = format.map(|format| value(choices, format)).transpose()?;
    if let Some(value) = value {
        physical(command, value, choices.choose_index(ACTUATORS.len())?);
    }
    let message = match direction {
        innfos::Direction::Request => Message::request(address, command, value),
        innfos::Direction::Reply => Message::reply(address, command, value),
    };
    let mut buffer = [0; 14];
    if let Ok(frame) = message.encode(&mut buffer).inspect_err(shown) {
        assert_eq!(Message::parse(&Frame::parse(direction, frame).unwrap()), Ok(message));
    }
    Ok(())
}

fn value(choices: &mut Unstructured<'_>, format: Format) -> Result<Value> {
    let size = usize::from(*choices.choose(format.sizes())?);
    let bytes: [u8; 6] = choices.arbitrary()?;
    let value = Value::decode(format, &bytes[..size]).unwrap();
    assert!(value.is(format), "{value:?}");
    assert_eq!(value.encode().as_bytes(), &bytes[..size]);
    match value {
        Value::Flag(flag) => {
            let meaning = [false, true].get(usize::from(bytes[0]));
            assert_eq!(flag.is_yes(), meaning.copied());
        }
        Value::Mac(mac) => assert_eq!(mac.as_bytes(), &bytes[..size]),
        _ => {}
    }
    Ok(value)
}

/// A quantity follows from the number in the data and the YAML, and converting it back yields the
/// value.
fn physical(command: Command, value: Value, model: usize) {
    let (innfos, actuator) = (&*INNFOS, &ACTUATORS[model]);
    let said = innfos.command(command.code()).unwrap();
    let fraction = said.format.and_then(|format| innfos.format(format)?.fraction_bits);
    let row = &innfos.actuators.rows[model];
    let scale = match said.full_scale {
        None => 1.0,
        Some(FullScale::Current) => row.current,
        Some(FullScale::MotorSpeed) => row.motor_speed,
    };
    let scaled = |number: i32| f64::from(number) / f64::from(1 << fraction.unwrap()) * scale;
    let expected = match value {
        Value::Iq8(number) => Some(scaled(number.0.into())),
        Value::Iq24(number) => Some(scaled(number.0)),
        Value::Scaled(number) => said.factor.map(|factor| f64::from(number) / factor),
        _ => None,
    };
    let found = command.physical(value, actuator);
    assert_eq!(found.map(f64::to_bits), expected.map(f64::to_bits), "{command:?}, {value:?}");
    let again = found.and_then(|physical| command.from_physical(physical, actuator));
    assert_eq!(again, found.map(|_| value), "{command:?}");

    // A quantity can be set by a command that writes one, NaN by none.
    let set = |physical| Message::set(1, command, physical, actuator).inspect_err(shown);
    let writes = said.operation == Operation::Write && found.is_some();
    let expected = writes.then(|| Message::request(1, command, Some(value)));
    assert_eq!(found.and_then(|physical| set(physical).ok()), expected, "{command:?}");
    assert_eq!(set(f64::NAN), Err(MessageError::NotANumber { command }));
}

/// The built bytes are those of the reference, have exactly the size that an error states, and
/// decode to the same content.
fn built(direction: innfos::Direction, address: u8, command: Command, data: &[u8]) {
    let code = command.code();
    let packet_again =
        Packet { direction: model(direction), address, command: code, data: data.to_vec().into() };
    let expected = reference::encode(&packet_again).unwrap();
    let mut buffer = vec![0; expected.len()];
    assert_eq!(innfos::encode(direction, address, command, data, &mut buffer), Ok(&expected[..]));
    let too_small = BufferTooSmall { needed: expected.len(), available: expected.len() - 1 };
    let built = innfos::encode(direction, address, command, data, &mut buffer[1..]);
    assert_eq!(built, Err(EncodeError::Buffer(too_small)));
    assert_eq!(Frame::parse(direction, &expected).map(|frame| packet(&frame)), Ok(packet_again));
}

/// Turns the input into a frame: a request, or a reply if its address is odd.
pub fn repair(input: &mut [u8]) {
    let direction = if input.get(1).is_some_and(|address| address % 2 == 1) { 2 } else { 1 };
    let Some(room) = input.len().checked_sub(6) else { return };
    // A CRC for at least this many bytes of data.
    let length = if room >= direction + 2 { room - 2 } else { room.min(direction - 1) };
    let [high, low] = u16::try_from(length).unwrap_or(u16::MAX).to_be_bytes();
    input[0] = 0xEE;
    input[3..5].copy_from_slice(&[high, low]);
    let end = 5 + length;
    if length >= direction {
        let crc = reference::crc(&input[5..end]);
        input[end..end + 2].copy_from_slice(&crc.to_le_bytes());
    }
    if let Some(tail) = input.last_mut() {
        *tail = 0xED;
    }
}
