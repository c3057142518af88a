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
    let (_, meant) = seen.repaired();
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
        let condition =
            || format!("the CRC is left out (it is {words}, but such a frame has none)");
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
    let (right, meant) = seen.repaired();
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
        trials.crc(seen.crc, crc(covered), right, &meant, &format!("the CRC {range}"));
    }
}

/// With another polynomial or initial value.
pub(super) fn algorithm(bytes: &[u8], trials: &mut Trials<'_>) {
    let Some(seen) = Seen::of(bytes) else { return };
    let (right, meant) = seen.repaired();
    for algorithm in &ALGORITHMS {
        let number = algorithm.checksum(seen.data);
        trials.crc(seen.crc, number, right, &meant, &format!("the CRC is {}", algorithm.name));
    }
}
