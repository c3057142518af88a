//! A byte that is changed, missing or one too many.

use std::ops::RangeInclusive;

use actucheck_codec::innfos::HEADER;
use actucheck_spec::wire::innfos::reference::TAIL;

use super::super::super::mistake::Trials;

/// Sizes of the frames of the document that have a CRC. Without one, any value of most bytes is right.
const WITH_CRC: RangeInclusive<usize> = 9..=32;
/// The place of the length. Any value of the address and the command before it is right: no CRC covers
/// them.
const LENGTH: usize = 3;

/// Whether bytes begin and end like a frame. What is wrong with its ends needs no search.
fn has_ends(bytes: &[u8]) -> bool {
    bytes.first() == Some(&HEADER) && bytes.last() == Some(&TAIL)
}

pub(super) fn needless(bytes: &[u8], trials: &mut Trials<'_>) {
    if WITH_CRC.contains(&bytes.len().saturating_sub(1)) && has_ends(bytes) {
        trials.without_each(bytes);
    }
}

/// With one bit of a byte turned over.
pub(super) fn bit(bytes: &[u8], trials: &mut Trials<'_>) {
    change(bytes, trials, u8::is_power_of_two);
}

/// With another value of a byte that more than one bit is changed of.
pub(super) fn changed(bytes: &[u8], trials: &mut Trials<'_>) {
    change(bytes, trials, |change| change.count_ones() > 1);
}

fn change(bytes: &[u8], trials: &mut Trials<'_>, wanted: impl Fn(u8) -> bool) {
    if !WITH_CRC.contains(&bytes.len()) || !has_ends(bytes) {
        return;
    }
    for at in LENGTH..bytes.len() {
        for change in (0..=u8::MAX).filter(|change| wanted(*change)) {
            let mut meant = bytes.to_vec();
            let Some(byte) = meant.get_mut(at) else { return };
            *byte ^= change;
            let right = *byte;
            trials.packet(meant, || format!("byte {at} is {right:02X}"));
        }
    }
}

pub(super) fn missing(bytes: &[u8], trials: &mut Trials<'_>) {
    if !WITH_CRC.contains(&(bytes.len() + 1)) || !has_ends(bytes) {
        return;
    }
    for at in LENGTH..bytes.len() {
        // Another one like the byte before it may as well come before that.
        let others = (0..=u8::MAX).filter(|byte| bytes.get(at - 1) != Some(byte));
        for byte in others {
            let mut meant = bytes.to_vec();
            meant.insert(at, byte);
            trials.packet(meant, || format!("a byte {byte:02X} comes before byte {at}"));
        }
    }
}
