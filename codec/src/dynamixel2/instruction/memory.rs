//! Instructions that read and write one device's control table.

use super::addressed;
use super::params::Params;
use crate::layout::LayoutError;
use crate::register::Row;

/// Reads `length` bytes from `address` on; they are the data of the status packet (DYNAMIXEL
/// Protocol 2.0, Read; JA40 document, §1.6.2).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Read {
    /// The first byte's address.
    pub address: u16,
    /// The number of bytes.
    pub length: u16,
}

impl Read {
    fn with_params<T>(self, encode: impl FnOnce(&[&[u8]]) -> T) -> T {
        encode(&[&self.address.to_le_bytes(), &self.length.to_le_bytes()])
    }

    /// From the first to the last of these registers, and all that is between. What comes back is
    /// taken apart by a [`RegisterBlock`](crate::register::RegisterBlock).
    #[must_use]
    pub fn covering(rows: &[&Row]) -> Self {
        let end = |row: &&Row| row.address.saturating_add(row.kind.size());
        let address = rows.iter().map(|row| row.address).min().unwrap_or_default();
        let end = rows.iter().map(end).max().unwrap_or_default();
        Self { address, length: end - address }
    }

    /// Reads its parameters.
    ///
    /// # Errors
    /// If they are not four bytes.
    pub fn parse(params: &[u8]) -> Result<Self, LayoutError> {
        let mut params = Params::new(params);
        let read = Self { address: params.u16("address")?, length: params.u16("length")? };
        params.end()?;
        Ok(read)
    }
}

addressed!(Read);

macro_rules! write {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub struct $name<'a> {
            /// The first byte's address.
            pub address: u16,
            /// The bytes.
            pub data: &'a [u8],
        }

        impl<'a> $name<'a> {
            fn with_params<T>(self, encode: impl FnOnce(&[&[u8]]) -> T) -> T {
                encode(&[&self.address.to_le_bytes(), self.data])
            }

            /// Reads its parameters.
            ///
            /// # Errors
            /// If they are not two bytes at least.
            pub fn parse(params: &'a [u8]) -> Result<Self, LayoutError> {
                let mut params = Params::new(params);
                Ok(Self { address: params.u16("address")?, data: params.rest() })
            }
        }

        addressed!($name<'a>);
    };
}

write! {
    /// Writes bytes from `address` on (DYNAMIXEL Protocol 2.0, Write; JA40 document, §1.6.3).
    /// [`Register::write`](crate::register::Register::write) checks the value first.
    Write
}

write! {
    /// Registers a write, which an [`Action`](super::Action) carries out (DYNAMIXEL Protocol 2.0,
    /// Reg Write).
    RegWrite
}
