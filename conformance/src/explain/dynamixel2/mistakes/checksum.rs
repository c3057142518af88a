//! A CRC that was computed in another way.

use actucheck_spec::wire::dynamixel2::reference::{PREFIX, crc};

use super::super::super::mistake::{ALGORITHMS, Trials};
use super::layout::plain;
use super::{Seen, repaired};

pub(super) fn swapped(bytes: &[u8], trials: &mut Trials<'_>) {
    let Some(seen) = Seen::whole(bytes) else { return };
    let holds = crc(seen.before).to_be_bytes() == seen.crc;
    trials.packet_if(holds, repaired(bytes), || "the two bytes of the CRC are swapped".to_owned());
}

pub(super) fn zero(bytes: &[u8], trials: &mut Trials<'_>) {
    let Some(seen) = Seen::whole(bytes) else { return };
    let condition = || "the sender computed no CRC and sent 00 00".to_owned();
    trials.packet_if(seen.crc == [0, 0], repaired(bytes), condition);
}

/// Over other bytes than all before the CRC.
pub(super) fn range(bytes: &[u8], trials: &mut Trials<'_>) {
    let Some(seen) = Seen::whole(bytes) else { return };
    let from = |start: usize| seen.before.get(start..).unwrap_or_default();
    let (front, body) = seen.before.split_at_checked(PREFIX).unwrap_or_default();
    let not_stuffed = plain(body);
    let shorter = u16::try_from(not_stuffed.len() + 2).unwrap_or_default().to_le_bytes();
    let Some((_, but_last)) = seen.before.split_last() else { return };
    let ranges = [
        ("covers no header (FF FF FD 00)", from(4).to_vec()),
        ("does not cover the last byte before it", but_last.to_vec()),
        ("does not cover the first byte", from(1).to_vec()),
        (
            "does not cover the reserved byte",
            [front.get(..3).unwrap_or_default(), from(4)].concat(),
        ),
        ("covers its own place as 00 00", [seen.before, &[0, 0]].concat()),
        ("is computed before byte stuffing", [front, &not_stuffed].concat()),
        (
            "is computed before byte stuffing, with the length before it",
            [front.get(..5).unwrap_or_default(), &shorter, &not_stuffed].concat(),
        ),
        ("begins at the length field", from(5).to_vec()),
        ("begins at the instruction", from(PREFIX).to_vec()),
        ("covers the parameters only", from(PREFIX + 1).to_vec()),
    ];
    for (range, covered) in ranges {
        both_orders(&seen, bytes, crc(&covered), trials, &format!("the CRC {range}"));
    }
}

/// With another polynomial or initial value, or reflected.
pub(super) fn algorithm(bytes: &[u8], trials: &mut Trials<'_>) {
    let Some(seen) = Seen::whole(bytes) else { return };
    for algorithm in &ALGORITHMS {
        let found = algorithm.checksum(seen.before);
        both_orders(&seen, bytes, found, trials, &format!("the CRC is {}", algorithm.name));
    }
}

/// Tries a number as the CRC, its low byte first, then its high byte.
fn both_orders(
    seen: &Seen<'_>,
    bytes: &[u8],
    number: u16,
    trials: &mut Trials<'_>,
    condition: &str,
) {
    // The right one is another mistake's.
    if number == crc(seen.before) {
        return;
    }
    let is = |crc: [u8; 2]| crc == seen.crc;
    trials.packet_if(is(number.to_le_bytes()), repaired(bytes), || condition.to_owned());
    let swapped = || format!("{condition}, and its two bytes are swapped");
    trials.packet_if(is(number.to_be_bytes()), repaired(bytes), swapped);
}
