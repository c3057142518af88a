//! Reads parameters from front to back.

use crate::dynamixel2::header::is_device;
use crate::dynamixel2::instruction::RequestError;
use crate::layout::LayoutError;

/// The parameters not read yet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Params<'a> {
    left: &'a [u8],
    offset: usize,
}

impl<'a> Params<'a> {
    pub(super) fn new(params: &'a [u8]) -> Self {
        Self { left: params, offset: 0 }
    }

    /// Reads the next bytes as a field.
    pub(super) fn take(
        &mut self,
        field: &'static str,
        needed: usize,
    ) -> Result<&'a [u8], LayoutError> {
        let (offset, available) = (self.offset, self.left.len());
        let short = LayoutError::Short { field, offset, available, needed };
        let (bytes, left) = self.left.split_at_checked(needed).ok_or(short)?;
        self.left = left;
        self.offset += needed;
        Ok(bytes)
    }

    pub(super) fn array<const N: usize>(
        &mut self,
        field: &'static str,
    ) -> Result<[u8; N], LayoutError> {
        let (offset, available) = (self.offset, self.left.len());
        let short = LayoutError::Short { field, offset, available, needed: N };
        self.take(field, N)?.try_into().map_err(|_| short)
    }

    pub(super) fn u8(&mut self, field: &'static str) -> Result<u8, LayoutError> {
        self.array(field).map(u8::from_le_bytes)
    }

    pub(super) fn u16(&mut self, field: &'static str) -> Result<u16, LayoutError> {
        self.array(field).map(u16::from_le_bytes)
    }

    /// The ID of a device that the parameters name.
    pub(super) fn id(&mut self) -> Result<u8, RequestError> {
        let found = self.u8("id")?;
        if is_device(found) { Ok(found) } else { Err(RequestError::Id { found }) }
    }

    /// The rest.
    pub(super) const fn rest(self) -> &'a [u8] {
        self.left
    }

    /// Fails if bytes are left.
    pub(super) fn end(self) -> Result<(), LayoutError> {
        let (offset, bytes) = (self.offset, self.left.len());
        if bytes == 0 { Ok(()) } else { Err(LayoutError::Extra { offset, bytes }) }
    }
}
