//! The names of mistakes that more than one place knows.

pub(in crate::explain) const CRC_SWAPPED: &str = "CRC bytes swapped";
pub(in crate::explain) const CRC_ZERO: &str = "CRC left at zero";
pub(in crate::explain) const CUT: &str = "cut short";
pub(in crate::explain) const MISSING_BYTE: &str = "one byte missing";
pub(in crate::explain) const NEEDLESS_BYTE: &str = "one byte too many";
pub(in crate::explain) const NO_STUFFING: &str = "no byte stuffing";
pub(in crate::explain) const OTHER_BIT: &str = "one bit changed";
pub(in crate::explain) const OTHER_BYTE: &str = "one byte changed";
pub(in crate::explain) const OTHER_CRC: &str = "other CRC";
pub(in crate::explain) const OTHER_RANGE: &str = "CRC over other bytes";
pub(in crate::explain) const STUFFING_LEFT: &str = "byte stuffing left in";
pub(in crate::explain) const STUFFING_TWICE: &str = "byte stuffing twice";
pub(in crate::explain) const TRAILING: &str = "bytes after the packet";
pub(in crate::explain) const WRONG_HEADER: &str = "wrong header";
pub(in crate::explain) const WRONG_LENGTH: &str = "wrong length";
