use core::fmt;

use crate::dynamixel2::ErrorNumber;
use crate::number::Or;

/// Why a register can't be written or read.
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
        /// The address of the register that holds the end which the value is beyond; `None` if it
        /// is the document or the register's size that sets it.
        limit: Option<u16>,
    },
    /// It has a list of values, and this is not one of them.
    NotListed {
        /// Its name.
        register: &'static str,
        /// The value.
        value: i64,
        /// The list of values.
        listed: &'static [i64],
    },
    /// The number of bytes is wrong.
    Size {
        /// Its name.
        register: &'static str,
        /// The number of bytes found.
        found: usize,
        /// The number of bytes of the register.
        expected: usize,
    },
    /// Not all of its bytes are among those of a block.
    NotInBlock {
        /// Its name.
        register: &'static str,
        /// Where the block begins.
        address: u16,
        /// How many bytes the block has.
        length: usize,
    },
}

impl RegisterError {
    /// What a device answers with (DYNAMIXEL Protocol 2.0, Status Packet, Error).
    ///
    /// ```
    /// use actucheck_codec::dynamixel2::ErrorNumber;
    /// use actucheck_codec::ja40;
    /// let limits = |address| (address == 38).then_some(500); // Current Limit
    /// let error = ja40::GOAL_CURRENT.row.accept(b"\xF5\x01", limits).unwrap_err();
    /// assert_eq!(error.number(), ErrorNumber::DataLimitError);
    /// ```
    #[must_use]
    pub const fn number(&self) -> ErrorNumber {
        match self {
            Self::ReadOnly { .. } | Self::NotInBlock { .. } => ErrorNumber::AccessError,
            Self::OutOfRange { limit: Some(_), .. } => ErrorNumber::DataLimitError,
            Self::OutOfRange { .. } | Self::NotListed { .. } => ErrorNumber::DataRangeError,
            Self::Size { .. } => ErrorNumber::DataLengthError,
        }
    }
}

impl fmt::Display for RegisterError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::ReadOnly { register } => write!(f, "{register} is read-only"),
            Self::OutOfRange { register, value, min, max, .. } => {
                write!(f, "{register} is {min} to {max}, not {value}")
            }
            Self::NotListed { register, value, listed } => {
                write!(f, "{register} is {}, not {value}", Or(listed))
            }
            Self::Size { register, found, expected } => {
                write!(f, "{register} has {expected} bytes, not {found}")
            }
            Self::NotInBlock { register, address, length } => {
                write!(f, "{register} is not within the {length} bytes from address {address}")
            }
        }
    }
}

impl core::error::Error for RegisterError {}
