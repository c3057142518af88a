//! Smaller probes. A failure is shrunk step by step while it stays of the same kind.

use actucheck_spec::wire::Packet;

use super::probe::{Part, Probe};
use super::wire;

/// Into how many pieces bytes are cut at most, so that long ones do not take forever.
const PIECES: usize = 64;

/// What can be shrunk.
pub(super) trait Shrink: Sized {
    /// The same, smaller or plainer in one way each, the largest changes first.
    fn smaller(&self) -> Box<dyn Iterator<Item = Self> + '_>;
}

/// Shrinks something by one change after the other, until none of them leaves the failure as it
/// is, after so many `steps`, or when it no longer `goes_on`. `fails` asks for something smaller;
/// it returns `None` if there is nothing to ask.
pub(super) fn shrink<T: Shrink>(
    whole: T,
    mut steps: usize,
    goes_on: &dyn Fn() -> bool,
    mut fails: impl FnMut(&T) -> Option<bool>,
) -> T {
    let mut smallest = whole;
    // The place in the list of changes, and whether one succeeded since the list began.
    let (mut place, mut succeeded) = (0, false);
    loop {
        let mut found = None;
        for candidate in smallest.smaller().skip(place) {
            if steps == 0 || !goes_on() {
                break;
            }
            let failed = fails(&candidate);
            steps -= usize::from(failed.is_some());
            if failed == Some(true) {
                found = Some(candidate);
                break;
            }
            place += 1;
        }
        match found {
            // The next change is at the same place in the new list.
            Some(candidate) => (smallest, succeeded) = (candidate, true),
            None if succeeded && steps > 0 && goes_on() => (place, succeeded) = (0, false),
            None => return smallest,
        }
    }
}

/// Fewer in a row.
impl<T: Clone> Shrink for Vec<T> {
    fn smaller(&self) -> Box<dyn Iterator<Item = Self> + '_> {
        Box::new(without(self))
    }
}

impl Shrink for Packet {
    fn smaller(&self) -> Box<dyn Iterator<Item = Self> + '_> {
        let packets = wire::of(self.wire()).map(|probes| (probes.smaller)(self));
        Box::new(packets.unwrap_or_default().into_iter())
    }
}

impl Shrink for Probe {
    fn smaller(&self) -> Box<dyn Iterator<Item = Self> + '_> {
        match self {
            Self::Crc(message) => Box::new(bytes(message).map(Self::Crc)),
            Self::Stuff(body) => Box::new(bytes(body).map(Self::Stuff)),
            Self::Unstuff(body) => Box::new(bytes(body).map(Self::Unstuff)),
            Self::Encode(packet) => Box::new(packet.smaller().map(Self::Encode)),
            Self::Decode(packet, damage) => {
                let less = damage.smaller().map(|damage| Self::Decode(packet.clone(), damage));
                let packets = packet.smaller();
                Box::new(less.chain(packets.map(|packet| Self::Decode(packet, damage.clone()))))
            }
            Self::Stream(parts, cuts) => {
                let fewer = parts.smaller().map(|parts| Self::Stream(parts, cuts.clone()));
                let longer = cuts.smaller().map(|cuts| Self::Stream(parts.clone(), cuts));
                let inside = parts.iter().enumerate().flat_map(move |(place, part)| {
                    part.smaller().map(move |part| {
                        let mut parts = parts.clone();
                        parts.iter_mut().skip(place).take(1).for_each(|slot| *slot = part.clone());
                        Self::Stream(parts, cuts.clone())
                    })
                });
                Box::new(fewer.chain(longer).chain(inside))
            }
        }
    }
}

impl Shrink for Part {
    fn smaller(&self) -> Box<dyn Iterator<Item = Self> + '_> {
        let less = self.damage.smaller().map(|damage| Self { damage, ..self.clone() });
        let quieter = bytes(&self.noise).map(|noise| Self { noise, ..self.clone() });
        let packets = self.packet.smaller().map(|packet| Self { packet, ..self.clone() });
        Box::new(less.chain(quieter).chain(packets))
    }
}

/// The places of pieces: the whole, its halves, and so on.
fn pieces(size: usize) -> impl Iterator<Item = (usize, usize)> {
    let least = size.div_ceil(PIECES).max(1);
    let sizes = std::iter::successors(Some(size), |piece| Some(piece / 2));
    let whole = sizes.take_while(move |piece| *piece >= least).flat_map(move |piece| {
        (0..size).step_by(piece).map(move |from| (from, (from + piece).min(size)))
    });
    let end = (least > 1).then(|| (size - 1, size));
    whole.chain(end)
}

/// The items without some in a row.
pub(super) fn without<T: Clone>(items: &[T]) -> impl Iterator<Item = Vec<T>> + use<'_, T> {
    pieces(items.len()).map(move |(from, to)| {
        let (before, behind) = (items.get(..from), items.get(to..));
        [before.unwrap_or_default(), behind.unwrap_or_default()].concat()
    })
}

/// The bytes without some in a row, and with zeros in their place.
pub(super) fn bytes(bytes: &[u8]) -> impl Iterator<Item = Vec<u8>> {
    let zeros = pieces(bytes.len()).filter_map(move |(from, to)| {
        let mut plain = bytes.to_vec();
        plain.get_mut(from..to)?.fill(0);
        (plain != bytes).then_some(plain)
    });
    without(bytes).chain(zeros)
}

/// Lower numbers.
pub(super) fn lower(number: usize) -> impl Iterator<Item = usize> {
    let mut lower =
        vec![0, 1, number / 2, number - number / 4, number - number / 16, number.wrapping_sub(1)];
    lower.retain(|lower| *lower < number);
    lower.sort_unstable();
    lower.dedup();
    lower.into_iter()
}
