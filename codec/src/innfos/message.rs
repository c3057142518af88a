use super::{
    Actuator, Command, Data, Direction, Format, Frame, MessageError, Operation, Value, encode,
    encoded_len,
};

/// The meaning of a frame: a command, and its value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Message {
    /// Its direction.
    pub direction: Direction,
    /// The actuator that it is for or from; 0 means all actuators, or the board.
    pub address: u8,
    /// The command.
    pub command: Command,
    /// The value to write, the value that was read, or the result of a write.
    pub value: Option<Value>,
}

impl Message {
    /// A message from the host.
    #[must_use]
    pub const fn request(address: u8, command: Command, value: Option<Value>) -> Self {
        Self { direction: Direction::Request, address, command, value }
    }

    /// A message from the host that sets a quantity in the command's unit.
    ///
    /// ```
    /// use actucheck_codec::innfos::{Command, DD_6010, Message, MessageError};
    /// let command = Command::WritePosition;
    /// assert!(Message::set(6, command, 1.5, &DD_6010).is_ok()); // R
    /// let refused = Message::set(6, command, f64::NAN, &DD_6010);
    /// assert_eq!(refused, Err(MessageError::NotANumber { command }));
    /// ```
    ///
    /// # Errors
    /// If `physical` is NaN, or the command takes no quantity.
    pub fn set(
        address: u8,
        command: Command,
        physical: f64,
        actuator: &Actuator,
    ) -> Result<Self, MessageError> {
        if physical.is_nan() {
            return Err(MessageError::NotANumber { command });
        }
        let value = command.from_physical(physical, actuator);
        let value = value.ok_or(MessageError::Value { command })?;
        match format(Direction::Request, command)? {
            Some(_) => Ok(Self::request(address, command, Some(value))),
            None => Err(MessageError::Value { command }),
        }
    }

    /// A message to the host.
    #[must_use]
    pub const fn reply(address: u8, command: Command, value: Option<Value>) -> Self {
        Self { direction: Direction::Reply, address, command, value }
    }

    /// Reads the meaning of `frame`.
    ///
    /// ```
    /// use actucheck_codec::innfos::{Command, Frame, Direction, Message, Mode, Value};
    /// let frame = Frame::parse(Direction::Request, b"\xEE\x06\x07\x00\x01\x06\x3F\x42\xED")?;
    /// let message = Message::parse(&frame)?;
    /// assert_eq!(message.command, Command::WriteMode);
    /// assert_eq!(message.value, Some(Value::Mode(Mode::TrapezoidalPosition)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// If the command is not in the document, has no reply, or the data has the wrong size.
    pub fn parse(frame: &Frame<'_>) -> Result<Self, MessageError> {
        let (direction, command, data) = (frame.direction(), frame.command(), frame.data());
        let format = format(direction, command)?;
        let expected: &[u16] = format.map_or(&[0], Format::sizes);
        let size = MessageError::Size { command, found: data.len(), expected };
        let value = match format {
            None if data.is_empty() => None,
            None => return Err(size),
            Some(format) => Some(Value::decode(format, data).ok_or(size)?),
        };
        Ok(Self { direction, address: frame.address(), command, value })
    }

    /// The size of the longest message's frame.
    pub const MAX_LEN: usize = encoded_len(Direction::Request, Data::MAX_LEN);

    /// Builds the frame in `buffer`; returns it. [`Message::MAX_LEN`] bytes are always enough.
    ///
    /// # Errors
    /// If the command is not in the document, has no reply, the value is not of its format, or
    /// `buffer` is too small; the error has the size needed.
    pub fn encode<'b>(&self, buffer: &'b mut [u8]) -> Result<&'b [u8], MessageError> {
        let Self { direction, address, command, value } = *self;
        let data = match (format(direction, command)?, value) {
            (None, None) => Data::default(),
            (Some(format), Some(value)) if value.is(format) => value.encode(),
            _ => return Err(MessageError::Value { command }),
        };
        Ok(encode(direction, address, command, data.as_bytes(), buffer)?)
    }
}

/// The format of the command's value in this direction; a write is answered with a flag.
fn format(direction: Direction, command: Command) -> Result<Option<Format>, MessageError> {
    let row = command.row().ok_or(MessageError::Unknown { code: command.code() })?;
    match (direction, row.operation) {
        (Direction::Reply, _) if row.reply.is_empty() => Err(MessageError::NoReply { command }),
        (Direction::Reply, Operation::Read) | (Direction::Request, Operation::Write) => {
            Ok(row.format)
        }
        (Direction::Reply, Operation::Write) => Ok(Some(Format::Flag)),
        (Direction::Request, Operation::Read) => Ok(None),
    }
}
