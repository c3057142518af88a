use super::{Data, Meaning, Range, RegisterError};
use crate::number::{nearest, to_f64};

/// A row of a control table: the facts about a register, whose values are plain numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// Its name in the document.
    pub name: &'static str,
    /// Address of its lowest byte.
    pub address: u16,
    /// Size and signedness; the low byte comes first.
    pub kind: Kind,
    /// The memory area, which decides whether the value survives a power cycle.
    pub area: Area,
    /// Whether hosts may write it.
    pub access: Access,
    /// The initial value, if the document states it.
    pub initial: Option<i64>,
    /// The values that it may have.
    pub range: Range,
    /// Whether the documents agree on the range. Where they do not, [`Row::encode`] takes every
    /// value of the register's size.
    pub settled: bool,
    /// The physical value of one count.
    pub unit: Option<Unit>,
    /// Other ranges and units that apply while another register has a certain value. The first one
    /// whose condition holds applies.
    pub meanings: &'static [Meaning],
    /// Values with a name.
    pub values: &'static [NamedValue],
    /// Named bit fields.
    pub bits: &'static [BitField],
}

impl Row {
    /// The value in these bytes; `None` if their number is not that of the register.
    ///
    /// ```
    /// use actucheck_codec::ja40;
    /// let register = ja40::DEVICE.register(580).unwrap();
    /// assert_eq!(register.decode(b"\x94\x6C\x00\x00"), Some(27_796));
    /// ```
    #[must_use]
    pub fn decode(&self, bytes: &[u8]) -> Option<i64> {
        Some(match (self.kind, bytes) {
            (Kind::U8, &[byte]) => byte.into(),
            (Kind::I8, &[byte]) => i8::from_le_bytes([byte]).into(),
            (Kind::U16, &[low, high]) => u16::from_le_bytes([low, high]).into(),
            (Kind::I16, &[low, high]) => i16::from_le_bytes([low, high]).into(),
            (Kind::U32, &[a, b, c, d]) => u32::from_le_bytes([a, b, c, d]).into(),
            (Kind::I32, &[a, b, c, d]) => i32::from_le_bytes([a, b, c, d]).into(),
            _ => return None,
        })
    }

    /// The bytes to write for `value`. `limits` returns the value of the register at an address, as
    /// the bounds of some ranges are other registers' values, and some ranges depend on a mode. If
    /// it returns `None`, only the size of the register limits that bound. A range that is not
    /// [settled](Row::settled) limits nothing.
    ///
    /// ```
    /// use actucheck_codec::ja40;
    /// let goal = ja40::DEVICE.register_named("Goal Current").unwrap();
    /// let limits = |address| (address == 38).then_some(500); // Current Limit
    /// assert_eq!(goal.encode(-500, limits)?.as_bytes(), b"\x0C\xFE");
    /// assert!(goal.encode(501, limits).is_err());
    /// assert!(goal.encode(501, |_| None).is_ok());
    /// # Ok::<(), actucheck_codec::register::RegisterError>(())
    /// ```
    ///
    /// # Errors
    /// If the register is read-only or the value outside its range.
    pub fn encode(
        &self,
        value: i64,
        limits: impl Fn(u16) -> Option<i64>,
    ) -> Result<Data, RegisterError> {
        if self.settled && self.access == Access::ReadWrite {
            self.check(value, limits)?;
        }
        self.encode_unchecked(value)
    }

    /// The bytes to write for any `value` that the register's size holds, also outside its range.
    ///
    /// ```
    /// use actucheck_codec::ja40;
    /// let limit = ja40::DEVICE.register_named("Temperature Limit").unwrap(); // 0 to 100
    /// assert!(limit.encode(101, |_| None).is_err());
    /// assert_eq!(limit.encode_unchecked(101)?.as_bytes(), b"\x65");
    /// # Ok::<(), actucheck_codec::register::RegisterError>(())
    /// ```
    ///
    /// # Errors
    /// If the register is read-only or too small for the value.
    pub fn encode_unchecked(&self, value: i64) -> Result<Data, RegisterError> {
        if self.access == Access::ReadOnly {
            return Err(RegisterError::ReadOnly { register: self.name });
        }
        let (min, max) = self.kind.limits();
        if (min..=max).contains(&value) {
            Ok(Data::of(self.kind, value))
        } else {
            Err(RegisterError::OutOfRange { register: self.name, value, min, max, limit: None })
        }
    }

    /// The value that a host's Write of these bytes sets, as a device reads it. `limits` is as in
    /// [`Row::encode`].
    ///
    /// # Errors
    /// If the register is read-only, the bytes are not as many as it has, or the value is outside
    /// its range; [`RegisterError::number`] is what to answer then.
    pub fn accept(
        &self,
        bytes: &[u8],
        limits: impl Fn(u16) -> Option<i64>,
    ) -> Result<i64, RegisterError> {
        let register = self.name;
        if self.access == Access::ReadOnly {
            return Err(RegisterError::ReadOnly { register });
        }
        let (found, expected) = (bytes.len(), self.kind.size().into());
        let value = self.decode(bytes).ok_or(RegisterError::Size { register, found, expected })?;
        if self.settled {
            self.check(value, limits)?;
        }
        Ok(value)
    }

    /// The name of a value, if it has one.
    #[must_use]
    pub fn value_name(&self, value: i64) -> Option<&'static str> {
        self.values.iter().find(|row| row.value == value).map(|row| row.name)
    }

    /// A value in the register's [`Unit`]: the count times the factor; `None` if it has no unit. If
    /// the unit depends on a mode, see [`Row::unit_while`].
    #[must_use]
    pub fn physical(&self, value: i64) -> Option<f64> {
        self.unit.map(|unit| to_f64(value) * unit.factor)
    }

    /// The count nearest to a physical value; of two that are equally near, the one farther from 0.
    /// What is beyond the size of the register becomes its largest or smallest value. `None` if the
    /// register has no unit, or for NaN.
    ///
    /// ```
    /// use actucheck_codec::ja40;
    /// let limit = ja40::DEVICE.register_named("Current Limit").unwrap(); // 2.5177 mA a count
    /// assert_eq!(limit.from_physical(1000.0), Some(397));
    /// assert_eq!(limit.from_physical(1e9), Some(65_535));
    /// ```
    #[must_use]
    pub fn from_physical(&self, physical: f64) -> Option<i64> {
        let (min, max) = self.kind.limits();
        nearest(physical / self.unit?.factor).map(|count| count.clamp(min, max))
    }
}

/// Size and signedness of a register.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    /// One byte.
    U8,
    /// One byte, signed.
    I8,
    /// Two bytes.
    U16,
    /// Two bytes, signed.
    I16,
    /// Four bytes.
    U32,
    /// Four bytes, signed.
    I32,
}

impl Kind {
    /// Bytes.
    #[must_use]
    pub const fn size(self) -> u16 {
        match self {
            Self::U8 | Self::I8 => 1,
            Self::U16 | Self::I16 => 2,
            Self::U32 | Self::I32 => 4,
        }
    }

    /// The smallest and the largest value of this size.
    #[must_use]
    pub fn limits(self) -> (i64, i64) {
        match self {
            Self::U8 => (0, u8::MAX.into()),
            Self::I8 => (i8::MIN.into(), i8::MAX.into()),
            Self::U16 => (0, u16::MAX.into()),
            Self::I16 => (i16::MIN.into(), i16::MAX.into()),
            Self::U32 => (0, u32::MAX.into()),
            Self::I32 => (i32::MIN.into(), i32::MAX.into()),
        }
    }
}

/// The memory area of a register.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Area {
    /// EEPROM area: the value survives a power cycle; writing can be locked.
    Eeprom,
    /// RAM area: the value is lost at a power cycle.
    Ram,
}

/// Whether hosts may write a register.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Access {
    /// Read-only.
    ReadOnly,
    /// Read and write.
    ReadWrite,
}

/// The physical value of one count.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    /// The physical value of one count.
    pub factor: f64,
    /// The unit of that.
    pub symbol: &'static str,
}

/// A value with a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NamedValue {
    /// The value.
    pub value: i64,
    /// Its name.
    pub name: &'static str,
}

/// Neighbouring bits with a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BitField {
    /// Its name.
    pub name: &'static str,
    /// The lowest bit, from 0.
    pub lowest: u8,
    /// How many bits.
    pub width: u8,
    /// Values with a name, shifted down to bit 0.
    pub values: &'static [NamedValue],
}

impl BitField {
    /// The field's part of a register's value, shifted down to bit 0.
    ///
    /// ```
    /// use actucheck_codec::ja40;
    /// let profile_type = &ja40::MOVING_STATUS.row.bits[1];
    /// assert_eq!(profile_type.of(0x31), 3);
    /// ```
    #[must_use]
    pub fn of(&self, value: i64) -> i64 {
        let mask = 1_i64.checked_shl(self.width.into()).map_or(-1, |end| end.wrapping_sub(1));
        value.checked_shr(self.lowest.into()).unwrap_or(0) & mask
    }
}
