use core::marker::PhantomData;

use super::{Data, Kind, RegisterError, Row};
use crate::EncodeError;
use crate::dynamixel2::{Instruction, frame};

/// The value of a register: a number, an enum of named values, or a set of bits.
pub trait Value: Copy {
    /// The size and signedness of the registers that can hold it.
    const KIND: Kind;

    /// As the number in the register.
    fn raw(self) -> i64;

    /// From the number in the register; `None` if the type has no such value.
    fn from_raw(raw: i64) -> Option<Self>;
}

macro_rules! numbers {
    ($($number:ident: $kind:ident),*) => {$(
        impl Value for $number {
            const KIND: Kind = Kind::$kind;

            fn raw(self) -> i64 {
                self.into()
            }

            fn from_raw(raw: i64) -> Option<Self> {
                raw.try_into().ok()
            }
        }
    )*};
}

numbers!(u8: U8, i8: I8, u16: U16, i16: I16, u32: U32, i32: I32);

/// A register whose values have the type `T`. The device modules have one constant for each row of
/// the control table.
#[derive(Debug, PartialEq)]
pub struct Register<T> {
    /// Name, address, size, area, access, range and unit.
    pub row: &'static Row,
    value: PhantomData<fn() -> T>,
}

impl<T> Clone for Register<T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T> Copy for Register<T> {}

impl<T: Value> Register<T> {
    /// The register of this row. Call it where a constant is computed: there, a type that does
    /// not suit the row ends the build.
    ///
    /// The device modules are made so; for a device of your own,
    /// `actucheck_spec::generate::build_script` writes such a module.
    ///
    /// # Panics
    /// If the row's kind is another than the type's.
    #[must_use]
    pub const fn new(row: &'static Row) -> Self {
        assert!(row.kind as u8 == T::KIND as u8, "a register of another kind than its value");
        Self { row, value: PhantomData }
    }

    /// The request to read it from the device `id`.
    ///
    /// ```
    /// use actucheck_codec::dynamixel2::Frame;
    /// use actucheck_codec::ja40;
    /// let mut buffer = [0; 16];
    /// let packet = ja40::PRESENT_POSITION.read(1).encode(&mut buffer)?;
    /// assert_eq!(packet, b"\xFF\xFF\xFD\x00\x01\x07\x00\x02\x44\x02\x04\x00\x14\x95");
    ///
    /// let reply = b"\xFF\xFF\xFD\x00\x01\x08\x00\x55\x00\xA6\x00\x00\x00\x8C\xC0";
    /// let position = Frame::parse(reply)?.status()?.value(ja40::PRESENT_POSITION)?;
    /// assert_eq!(position, 166);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub const fn read(self, id: u8) -> RegisterRead {
        RegisterRead { id, row: self.row }
    }

    /// The request to write it on the device `id`. Bounds that are other registers' values are not
    /// checked; [`Register::write_within`] checks them.
    ///
    /// # Errors
    /// If the register is read-only or the value outside its range.
    pub fn write(self, id: u8, value: T) -> Result<RegisterWrite, RegisterError> {
        self.write_within(id, value, |_| None)
    }

    /// The request to write it on the device `id`, within bounds that are other registers' values.
    /// `limits` returns the value of the register at an address, as far as the caller knows it.
    ///
    /// ```
    /// use actucheck_codec::ja40;
    /// let limits = |address| match address {
    ///     48 => Some(16_384),  // Max Position Limit
    ///     52 => Some(-16_384), // Min Position Limit
    ///     _ => None,
    /// };
    /// let error = ja40::GOAL_POSITION.write_within(1, 20_000, limits).unwrap_err();
    /// assert_eq!(error.to_string(), "Goal Position is -16384 to 16384, not 20000");
    /// ```
    ///
    /// # Errors
    /// If the register is read-only or the value outside its range.
    pub fn write_within(
        self,
        id: u8,
        value: T,
        limits: impl Fn(u16) -> Option<i64>,
    ) -> Result<RegisterWrite, RegisterError> {
        let data = self.row.encode(value.raw(), limits)?;
        Ok(RegisterWrite { id, address: self.row.address, data, instruction: Instruction::Write })
    }

    /// The request to write any value on the device `id`, even outside the range.
    ///
    /// # Errors
    /// If the register is read-only.
    pub fn write_unchecked(self, id: u8, value: T) -> Result<RegisterWrite, RegisterError> {
        let data = self.row.encode_unchecked(value.raw())?;
        Ok(RegisterWrite { id, address: self.row.address, data, instruction: Instruction::Write })
    }

    /// The value in these bytes.
    ///
    /// # Errors
    /// If their number is not that of the register.
    pub fn decode(self, bytes: &[u8]) -> Result<T, RegisterError> {
        self.row.decode(bytes).and_then(T::from_raw).ok_or(RegisterError::Size {
            register: self.row.name,
            found: bytes.len(),
            expected: self.row.kind.size().into(),
        })
    }

    /// As [`Row::physical`].
    #[must_use]
    pub fn physical(self, value: T) -> Option<f64> {
        self.row.physical(value.raw())
    }

    /// As [`Row::from_physical`].
    ///
    /// ```
    /// use actucheck_codec::ja40;
    /// // 0.01 rev/min a count
    /// assert_eq!(ja40::GOAL_VELOCITY.from_physical(-12.344), Some(-1234));
    /// assert_eq!(ja40::GOAL_VELOCITY.physical(-1234), Some(-12.34));
    /// ```
    #[must_use]
    pub fn from_physical(self, physical: f64) -> Option<T> {
        self.row.from_physical(physical).and_then(T::from_raw)
    }
}

/// The request for a register's value: a Read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RegisterRead {
    id: u8,
    row: &'static Row,
}

impl RegisterRead {
    /// Builds the packet in `buffer`, 14 bytes, or more if it needs stuffing; returns it.
    ///
    /// # Errors
    /// As [`frame::encode`].
    pub fn encode<'b>(&self, buffer: &'b mut [u8]) -> Result<&'b [u8], EncodeError> {
        let (address, length) = (self.row.address.to_le_bytes(), self.row.kind.size());
        frame::encode(self.id, Instruction::Read, &[&address, &length.to_le_bytes()], buffer)
    }

    /// The size of the packet in bytes, including stuffing.
    ///
    /// # Errors
    /// As `encode`, except for the size of its buffer.
    pub fn encoded_len(&self) -> Result<usize, EncodeError> {
        frame::len_of(|buffer| self.encode(buffer))
    }
}

/// The request to write a register, with a checked value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RegisterWrite {
    id: u8,
    address: u16,
    data: Data,
    instruction: Instruction,
}

impl RegisterWrite {
    /// The same as a Reg Write, which waits for an Action.
    #[must_use]
    pub const fn registered(self) -> Self {
        Self { instruction: Instruction::RegWrite, ..self }
    }

    /// The value's bytes, for a Sync Write or a Bulk Write.
    #[must_use]
    pub const fn data(&self) -> Data {
        self.data
    }

    /// Builds the packet in `buffer`, 13 to 16 bytes, or more if it needs stuffing; returns it.
    ///
    /// # Errors
    /// As [`frame::encode`].
    pub fn encode<'b>(&self, buffer: &'b mut [u8]) -> Result<&'b [u8], EncodeError> {
        let address = self.address.to_le_bytes();
        frame::encode(self.id, self.instruction, &[&address, self.data.as_bytes()], buffer)
    }

    /// The size of the packet in bytes, including stuffing.
    ///
    /// # Errors
    /// As `encode`, except for the size of its buffer.
    pub fn encoded_len(&self) -> Result<usize, EncodeError> {
        frame::len_of(|buffer| self.encode(buffer))
    }
}
