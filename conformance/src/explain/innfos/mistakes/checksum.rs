//! A CRC that was computed in another way, or that should not be there.

use actucheck_spec::wire::innfos::reference::{PREFIX, crc};

use super::super::super::mistake::{ALGORITHMS, Trials};
use super::Seen;

pub(super) fn swapped(bytes: &[u8], trials: &mut Trials<'_>) {
    let Some(seen) = Seen::of(bytes) else { return };
    let [first, second] = seen.crc;
    let meant = seen.with(&[second, first]);
    trials.packet(meant, || "the two bytes of the CRC are swapped".to_owned());
}

pub(super) fn zero(bytes: &[u8], trials: &mut Trials<'_>) {
    let Some(seen) = Seen::of(bytes) else { return };
    let meant = seen.with(&crc(seen.data).to_le_bytes());
    let condition = || "the sender computed no CRC and sent 00 00".to_owned();
    trials.packet_if(seen.crc == [0, 0], meant, condition);
}

/// In a frame that has none.
pub(super) fn needless(bytes: &[u8], trials: &mut Trials<'_>) {
    let Some(seen) = Seen::of(bytes) else { return };
    let right = crc(seen.data);
    for (crc, words) in [
        (right.to_le_bytes(), "right"),
        (right.to_be_bytes(), "right if its two bytes are swapped"),
        ([0, 0], "zero"),
    ] {
        let condition = || format!("the CRC, which is {words}, is left out: this frame has none");
        trials.packet_if(seen.crc == crc, seen.with(&[]), condition);
    }
}

/// In a frame that needs one.
pub(super) fn missing(bytes: &[u8], trials: &mut Trials<'_>) {
    let Some((end, before)) = bytes.split_last() else { return };
    let right = crc(before.get(PREFIX..).unwrap_or_default()).to_le_bytes();
    let meant = [before, &right, &[*end]].concat();
    trials.packet(meant, || "the sender left out the CRC".to_owned());
}

/// Over other bytes than the data.
pub(super) fn range(bytes: &[u8], trials: &mut Trials<'_>) {
    let Some(seen) = Seen::of(bytes) else { return };
    let from = |start: usize| seen.before.get(start..).unwrap_or_default();
    for (range, covered) in [
        ("covers all bytes before it", from(0)),
        ("covers all between the header and it", from(1)),
        ("begins at the command", from(2)),
        ("begins at the length", from(3)),
        ("does not cover the first byte of data", from(PREFIX + 1)),
        (
            "does not cover the last byte of data",
            seen.data.split_last().map_or(&[][..], |(_, data)| data),
        ),
    ] {
        both_orders(&seen, crc(covered), trials, &format!("the CRC {range}"));
    }
}

/// With another polynomial or initial value.
pub(super) fn algorithm(bytes: &[u8], trials: &mut Trials<'_>) {
    let Some(seen) = Seen::of(bytes) else { return };
    for algorithm in &ALGORITHMS {
        let found = algorithm.checksum(seen.data);
        both_orders(&seen, found, trials, &format!("the CRC is {}", algorithm.name));
    }
}

/// Tries a number as the CRC, its low byte first, then its high byte.
fn both_orders(seen: &Seen<'_>, number: u16, trials: &mut Trials<'_>, condition: &str) {
    let right = crc(seen.data);
    // The right one is another mistake's.
    if number == right {
        return;
    }
    let meant = seen.with(&right.to_le_bytes());
    trials.packet_if(number.to_le_bytes() == seen.crc, meant.clone(), || condition.to_owned());
    let swapped = || format!("{condition}, and its two bytes are swapped");
    trials.packet_if(number.to_be_bytes() == seen.crc, meant, swapped);
}
