use core::fmt;

/// Why a register can't be written or read so.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RegisterError {
    /// Hosts may only read it.
    ReadOnly {
        /// Its name.
        register: &'static str,
    },
    /// The value lies outside its range.
    OutOfRange {
        /// Its name.
        register: &'static str,
        /// The value.
        value: i64,
        /// The smallest value that it takes.
        min: i64,
        /// The largest.
        max: i64,
    },
    /// It takes some values only, and this is none of them.
    NotListed {
        /// Its name.
        register: &'static str,
        /// The value.
        value: i64,
        /// All that it takes.
        listed: &'static [i64],
    },
    /// The bytes are not as many as it has.
    Size {
        /// Its name.
        register: &'static str,
        /// How many they are.
        found: usize,
        /// How many it has.
        expected: usize,
    },
}

impl fmt::Display for RegisterError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::ReadOnly { register } => write!(f, "{register} is read-only"),
            Self::OutOfRange { register, value, min, max } => {
                write!(f, "{register} is {min} to {max}, not {value}")
            }
            Self::NotListed { register, value, listed } => {
                write!(f, "{register} is one of {listed:?}, not {value}")
            }
            Self::Size { register, found, expected } => {
                write!(f, "{register} has {expected} bytes, not {found}")
            }
        }
    }
}

impl core::error::Error for RegisterError {}
