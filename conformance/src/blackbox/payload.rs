//! Payloads of packets: sizes at which implementations change their way, and bytes that look like
//! headers and byte stuffing.

use proptest::collection::vec;
use proptest::prelude::{BoxedStrategy, Strategy, any};
use proptest::prop_oneof;
use proptest::sample::select;

use crate::adapter::Limits;
use crate::suite::random::data;

/// The longest data, in bytes, of most probes.
const SHORT: usize = 48;
/// The greatest number that a length of two bytes can have.
const GREATEST: usize = 65_535;

/// Bytes of any size that a length allows. `around` is the number of bytes that a frame has in
/// addition.
pub(super) fn payload(around: usize, limits: &Limits) -> BoxedStrategy<Vec<u8>> {
    prop_oneof![
        60 => data(0..SHORT),
        6 => filled((SHORT..300).boxed()),
        6 => filled(near(powers(6..12), around)),
        1 => filled(near(powers(12..17), around)),
        6 => filled(near(stated(limits), around)),
    ]
    .boxed()
}

/// These powers of two.
fn powers(exponents: std::ops::Range<u32>) -> Vec<usize> {
    exponents.map(|exponent| 1 << exponent).collect()
}

/// The limits that an adapter states; where it states none, a limit that many buffers have.
fn stated(limits: &Limits) -> Vec<usize> {
    let limits: Vec<_> = [limits.send(), limits.receive()].into_iter().flatten().collect();
    if limits.is_empty() { vec![1024] } else { limits }
}

/// Sizes of a payload that make a frame or the payload itself about as long as one of `sizes`.
fn near(sizes: Vec<usize>, around: usize) -> BoxedStrategy<usize> {
    (select(sizes), prop_oneof![(0..=0_usize), around..=around], 0..6_usize)
        .prop_map(|(size, around, off)| (size + 3).saturating_sub(around + off).min(GREATEST))
        .boxed()
}

/// So many bytes: a few that repeat, with others in places.
fn filled(size: BoxedStrategy<usize>) -> impl Strategy<Value = Vec<u8>> {
    let tile = prop_oneof![3 => data(1..2), 2 => data(1..20)];
    (size, tile, vec((any::<u16>(), data(1..5)), 0..4)).prop_map(|(size, tile, others)| {
        let mut bytes: Vec<u8> = tile.iter().copied().cycle().take(size).collect();
        for (at, others) in others {
            let at = usize::from(at) * size / 65_536;
            bytes.iter_mut().skip(at).zip(others).for_each(|(slot, byte)| *slot = byte);
        }
        bytes
    })
}
