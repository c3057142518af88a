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
    let (right, meant) = (crc(seen.before), repaired(bytes));
    for (range, covered) in ranges {
        trials.crc(seen.crc, crc(&covered), right, &meant, &format!("the CRC {range}"));
    }
}

/// With another polynomial or initial value, or reflected.
pub(super) fn algorithm(bytes: &[u8], trials: &mut Trials<'_>) {
    let Some(seen) = Seen::whole(bytes) else { return };
    let (right, meant) = (crc(seen.before), repaired(bytes));
    for algorithm in &ALGORITHMS {
        let number = algorithm.checksum(seen.before);
        trials.crc(seen.crc, number, right, &meant, &format!("the CRC is {}", algorithm.name));
    }
}
