use super::Kind;

/// The bytes of a register's value, low byte first: 1, 2 or 4.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Data {
    bytes: [u8; 4],
    len: usize,
}

impl Data {
    /// The lowest bytes of `value`, for the size of the register.
    pub(super) fn of(kind: Kind, value: i64) -> Self {
        let [a, b, c, d, ..] = value.to_le_bytes();
        Self { bytes: [a, b, c, d], len: kind.size().into() }
    }

    /// The bytes.
    #[must_use]
    pub fn as_bytes(&self) -> &[u8] {
        self.bytes.get(..self.len).unwrap_or_default()
    }
}

impl AsRef<[u8]> for Data {
    fn as_ref(&self) -> &[u8] {
        self.as_bytes()
    }
}
