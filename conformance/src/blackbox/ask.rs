//! Requests to a device, in parts that can be generated and made smaller.

use super::probe::{Part, cut, joined};
use crate::shrink::{Shrink, one_smaller};

/// What is sent to a device before something must come back: packets without a pause between them.
#[derive(Clone, Debug)]
pub(super) struct Request {
    pub(super) parts: Vec<Part>,
    /// Where that is cut into pieces with pauses, in units of 1/65,536 of its length.
    pub(super) cuts: Vec<u16>,
}

impl Request {
    /// The pieces that are sent. `None` if a packet can't be built.
    pub(super) fn pieces(&self) -> Option<Vec<Vec<u8>>> {
        let pieces = cut(&joined(&self.parts)?, &self.cuts).into_iter().map(|piece| piece.0);
        Some(pieces.filter(|piece| !piece.is_empty()).collect())
    }
}

impl Shrink for Request {
    fn smaller(&self) -> Box<dyn Iterator<Item = Self> + '_> {
        let less = self.parts.smaller().map(|parts| Self { parts, ..self.clone() });
        let whole = self.cuts.smaller().map(|cuts| Self { cuts, ..self.clone() });
        let inside = one_smaller(&self.parts).map(|parts| Self { parts, ..self.clone() });
        Box::new(less.chain(whole).chain(inside))
    }
}
