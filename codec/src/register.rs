//! Rows of control tables: what the generated device modules are made of.

use crate::dynamixel2::Instruction;

/// An actuator's control table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Device {
    /// The id that the documents' YAML gives it.
    pub id: &'static str,
    /// Its name.
    pub name: &'static str,
    /// What Ping answers, where the document says so.
    pub model_number: Option<u16>,
    /// The instructions that it obeys.
    pub instructions: &'static [Instruction],
    /// Address of the register that keeps the EEPROM area read-only while it is not 0.
    pub eeprom_lock: Option<u16>,
    /// The control table, by rising address.
    pub registers: &'static [Register],
}

impl Device {
    /// The register that begins at this address.
    #[must_use]
    pub fn register(&self, address: u16) -> Option<&'static Register> {
        let index =
            self.registers.binary_search_by_key(&address, |register| register.address).ok()?;
        self.registers.get(index)
    }

    /// The register with this name: `Goal Position`.
    #[must_use]
    pub fn register_named(&self, name: &str) -> Option<&'static Register> {
        self.registers.iter().find(|register| register.name == name)
    }

    /// The registers that lie wholly within `length` bytes from `address`.
    pub fn registers_in(
        &self,
        address: u16,
        length: u16,
    ) -> impl Iterator<Item = &'static Register> + use<> {
        let end = u32::from(address) + u32::from(length);
        self.registers.iter().filter(move |register| {
            let last = u32::from(register.address) + u32::from(register.kind.size());
            register.address >= address && last <= end
        })
    }
}

/// A row of a control table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Register {
    /// Its name in the document.
    pub name: &'static str,
    /// Address of its lowest byte.
    pub address: u16,
    /// Size and signedness; the low byte comes first.
    pub kind: Kind,
    /// Whether it outlives a power cycle.
    pub area: Area,
    /// What hosts may do with it.
    pub access: Access,
    /// The value that it starts with, where the document says so.
    pub initial: Option<i64>,
    /// The values that it may have.
    pub range: Range,
    /// What one count of its value is.
    pub unit: Option<Unit>,
    /// Values with a name.
    pub values: &'static [NamedValue],
    /// Bits with a meaning of their own.
    pub bits: &'static [BitField],
}

impl Register {
    /// The value that these bytes hold; `None` if they are not as many as the register has.
    ///
    /// ```
    /// use actucheck_codec::ja40;
    /// assert_eq!(ja40::PRESENT_POSITION.read(b"\x94\x6C\x00\x00"), Some(27_796));
    /// ```
    #[must_use]
    pub fn read(&self, bytes: &[u8]) -> Option<i64> {
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

    /// The name of a value, if it has one.
    #[must_use]
    pub fn value_name(&self, value: i64) -> Option<&'static str> {
        self.values.iter().find(|row| row.value == value).map(|row| row.name)
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
}

/// Whether a register outlives a power cycle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Area {
    /// It does; it can be locked.
    Eeprom,
    /// It does not.
    Ram,
}

/// What hosts may do with a register.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Access {
    /// Read it.
    ReadOnly,
    /// Read and write it.
    ReadWrite,
}

/// The values that a register may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Range {
    /// Any that it can hold.
    Any,
    /// Those between two bounds, both included.
    Between {
        /// The smallest.
        min: Bound,
        /// The largest.
        max: Bound,
    },
    /// These.
    OneOf(&'static [i64]),
}

/// An end of a range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bound {
    /// A number.
    Value(i64),
    /// What another register holds.
    Register {
        /// The register's address.
        address: u16,
        /// Whether its value counts with the other sign.
        negated: bool,
    },
}

/// What one count of a value is.
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

/// Neighbouring bits with a meaning of their own.
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
    /// let profile_type = &ja40::MOVING_STATUS.bits[1];
    /// assert_eq!(profile_type.of(0x31), 3);
    /// ```
    #[must_use]
    pub fn of(&self, value: i64) -> i64 {
        let mask = 1_i64.checked_shl(self.width.into()).map_or(-1, |end| end - 1);
        value.checked_shr(self.lowest.into()).unwrap_or(0) & mask
    }
}
