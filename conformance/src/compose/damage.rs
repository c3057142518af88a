//! Damages a frame on purpose.

use std::str::FromStr;

use thiserror::Error;

/// What is done to a frame. Offsets count from 0 in the undamaged frame.
#[derive(Clone, Debug, Default)]
pub struct Damage {
    /// Bits that are turned over.
    pub flip: Vec<Bit>,
    /// Bytes that are left out.
    pub drop: Vec<usize>,
    /// The byte at which the frame ends early.
    pub cut: Option<usize>,
}

/// A bit of a frame: `5.3` is bit 3, where 0 is the lowest, of byte 5.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bit {
    byte: usize,
    bit: u8,
}

/// Why a frame can't be damaged so.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum DamageError {
    /// It is not written as a byte and a bit.
    #[error("a bit is written as BYTE.BIT, such as 5.3; bits are 0 to 7")]
    NoBit,
    /// The frame has no such byte.
    #[error("there is no byte {0}: the packet has {1} bytes, and the first is byte 0")]
    Outside(usize, usize),
}

impl FromStr for Bit {
    type Err = DamageError;

    fn from_str(text: &str) -> Result<Self, DamageError> {
        let parse = || {
            let (byte, bit) = text.split_once('.')?;
            Some(Self { byte: byte.parse().ok()?, bit: bit.parse().ok()? })
        };
        parse().filter(|place| place.bit < 8).ok_or(DamageError::NoBit)
    }
}

impl Damage {
    /// The damaged frame.
    ///
    /// # Errors
    /// If an offset is outside of the frame.
    pub fn apply(&self, frame: &[u8]) -> Result<Vec<u8>, DamageError> {
        let size = frame.len();
        let mut bytes: Vec<_> = frame.iter().copied().map(Some).collect();
        for Bit { byte, bit } in &self.flip {
            let place = bytes.get_mut(*byte).ok_or(DamageError::Outside(*byte, size))?;
            *place = place.map(|value| value ^ 1 << bit);
        }
        for byte in &self.drop {
            *bytes.get_mut(*byte).ok_or(DamageError::Outside(*byte, size))? = None;
        }
        if let Some(end) = self.cut {
            if end >= size {
                return Err(DamageError::Outside(end, size));
            }
            bytes.truncate(end);
        }
        Ok(bytes.into_iter().flatten().collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn offsets_are_those_of_the_undamaged_frame() {
        let flip = vec!["0.7".parse().unwrap(), "3.0".parse().unwrap()];
        let damage = Damage { flip, drop: vec![1], cut: Some(4) };
        assert_eq!(damage.apply(&[0, 1, 2, 3, 4]), Ok(vec![0x80, 2, 2]));
        assert_eq!(Damage::default().apply(&[1, 2]), Ok(vec![1, 2]));
    }

    #[test]
    fn what_is_outside_is_refused() {
        assert_eq!("5.8".parse::<Bit>(), Err(DamageError::NoBit));
        assert_eq!("5".parse::<Bit>(), Err(DamageError::NoBit));
        let flip = vec!["2.0".parse().unwrap()];
        let outside = Damage { flip, ..Damage::default() };
        assert_eq!(outside.apply(&[1, 2]), Err(DamageError::Outside(2, 2)));
        let cut = Damage { cut: Some(2), ..Damage::default() };
        assert_eq!(cut.apply(&[1, 2]), Err(DamageError::Outside(2, 2)));
    }
}
