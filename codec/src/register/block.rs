use super::{Register, RegisterError, Value};

/// The bytes of neighbouring registers, to be taken apart by type.
///
/// ```
/// use actucheck_codec::dynamixel2::instruction::Read;
/// use actucheck_codec::ja40;
/// use actucheck_codec::register::RegisterBlock;
///
/// let read = Read::covering(&[ja40::PRESENT_CURRENT.row, ja40::PRESENT_POSITION.row]);
/// assert_eq!((read.address, read.length), (574, 10));
/// // What the device answers; Present Velocity is between the two.
/// let data = b"\x0C\xFE\x64\x00\x00\x00\x94\x6C\x00\x00";
/// let block = RegisterBlock::new(read.address, data);
/// assert_eq!(block.value(ja40::PRESENT_CURRENT)?, -500);
/// assert_eq!(block.value(ja40::PRESENT_POSITION)?, 27_796);
/// # Ok::<(), actucheck_codec::register::RegisterError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RegisterBlock<'a> {
    address: u16,
    data: &'a [u8],
}

impl<'a> RegisterBlock<'a> {
    /// The bytes from this address on.
    #[must_use]
    pub const fn new(address: u16, data: &'a [u8]) -> Self {
        Self { address, data }
    }

    /// The value of one of the registers.
    ///
    /// # Errors
    /// If not all of the register's bytes are in the block.
    pub fn value<T: Value>(&self, register: Register<T>) -> Result<T, RegisterError> {
        let row = register.row;
        let from = row.address.checked_sub(self.address).map(usize::from);
        let bytes = from.and_then(|from| self.data.get(from..)?.get(..row.kind.size().into()));
        bytes.map_or(
            Err(RegisterError::NotInBlock {
                register: row.name,
                address: self.address,
                length: self.data.len(),
            }),
            |bytes| register.decode(bytes),
        )
    }
}
