use super::{Alarms, Format, Iq8, Iq24, Mode};

/// The value in the data of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Value {
    /// Yes or no.
    Flag(Flag),
    /// The quantity that the actuator controls.
    Mode(Mode),
    /// Its alarms.
    Alarms(Alarms),
    /// A number with 8 fractional bits.
    Iq8(Iq8),
    /// A number with 24 fractional bits.
    Iq24(Iq24),
    /// A whole number, the quantity times the command's factor.
    Scaled(i32),
    /// The bytes that identify an actuator.
    Mac(Mac),
}

impl Value {
    /// The value of `data` in this format; `None` if the size is wrong.
    #[must_use]
    pub fn decode(format: Format, data: &[u8]) -> Option<Self> {
        Some(match (format, data) {
            (Format::Flag, &[byte]) => Self::Flag(Flag(byte)),
            (Format::Mode, &[code]) => Self::Mode(Mode::from_code(code)),
            (Format::Alarms, &[high, low]) => Self::Alarms(Alarms(u16::from_be_bytes([high, low]))),
            (Format::Iq8, &[high, low]) => Self::Iq8(Iq8(i16::from_be_bytes([high, low]))),
            (Format::Iq24, &[a, b, c, d]) => Self::Iq24(Iq24(i32::from_be_bytes([a, b, c, d]))),
            (Format::Scaled { .. }, &[a, b, c, d]) => {
                Self::Scaled(i32::from_be_bytes([a, b, c, d]))
            }
            (Format::Mac, data) => Self::Mac(Mac::new(data)?),
            _ => return None,
        })
    }

    /// Whether it has this format.
    #[must_use]
    pub const fn is(self, format: Format) -> bool {
        matches!(
            (self, format),
            (Self::Flag(_), Format::Flag)
                | (Self::Mode(_), Format::Mode)
                | (Self::Alarms(_), Format::Alarms)
                | (Self::Iq8(_), Format::Iq8)
                | (Self::Iq24(_), Format::Iq24)
                | (Self::Scaled(_), Format::Scaled { .. })
                | (Self::Mac(_), Format::Mac)
        )
    }

    /// Its bytes.
    #[must_use]
    pub fn encode(self) -> Data {
        match self {
            Self::Flag(Flag(byte)) => Data::of(&[byte]),
            Self::Mode(mode) => Data::of(&[mode.code()]),
            Self::Alarms(Alarms(bits)) => Data::of(&bits.to_be_bytes()),
            Self::Iq8(Iq8(number)) => Data::of(&number.to_be_bytes()),
            Self::Iq24(Iq24(number)) | Self::Scaled(number) => Data::of(&number.to_be_bytes()),
            Self::Mac(Mac(data)) => data,
        }
    }
}

/// 1 for success, enabled, on or normal; 0 for the opposite; other bytes are kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Flag(pub u8);

impl Flag {
    /// Failure, disabled, off.
    pub const NO: Self = Self(0);
    /// Success, enabled, on, normal.
    pub const YES: Self = Self(1);

    /// Its meaning; `None` for a byte that the document does not explain.
    #[must_use]
    pub const fn is_yes(self) -> Option<bool> {
        match self.0 {
            0 => Some(false),
            1 => Some(true),
            _ => None,
        }
    }
}

/// What the document calls a MAC address: four bytes, or six (INNFOS document, Query actuator).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Mac(Data);

impl Mac {
    /// From these bytes; `None` if they are not four or six.
    #[must_use]
    pub fn new(bytes: &[u8]) -> Option<Self> {
        matches!(bytes.len(), 4 | 6).then(|| Self(Data::of(bytes)))
    }

    /// Its bytes.
    #[must_use]
    pub fn as_bytes(&self) -> &[u8] {
        self.0.as_bytes()
    }
}

/// The bytes of a value, high byte first: 1 to 6.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Data {
    bytes: [u8; Self::MAX_LEN],
    len: usize,
}

impl Data {
    /// The most that a value has.
    pub(super) const MAX_LEN: usize = 6;

    /// As many bytes at most.
    fn of(given: &[u8]) -> Self {
        let mut bytes = [0; Self::MAX_LEN];
        for (slot, byte) in bytes.iter_mut().zip(given) {
            *slot = *byte;
        }
        Self { bytes, len: given.len() }
    }

    /// The bytes.
    #[must_use]
    pub fn as_bytes(&self) -> &[u8] {
        self.bytes.get(..self.len).unwrap_or_default()
    }
}
