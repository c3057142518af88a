//! Smaller probes. A failure is shrunk step by step while it stays of the same kind.

use actucheck_spec::wire::Packet;

use super::probe::{Part, Probe};
use super::wire;
use crate::shrink::{Shrink, one_smaller, pieces, without};

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
            Self::Converse(talk) => Box::new(talk.smaller().map(Self::Converse)),
            Self::Ask(requests) => {
                let fewer = requests.smaller().chain(one_smaller(requests));
                Box::new(fewer.map(Self::Ask))
            }
            Self::Stream(parts, cuts) => {
                let fewer = parts.smaller().map(|parts| Self::Stream(parts, cuts.clone()));
                let longer = cuts.smaller().map(|cuts| Self::Stream(parts.clone(), cuts));
                let inside = one_smaller(parts).map(|parts| Self::Stream(parts, cuts.clone()));
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
