//! Parts of a packet that are wrong, missing or left over.

use actucheck_spec::wire::dynamixel2::reference::{
    BROADCAST, HEADER, PATTERN, PREFIX, STATUS, crc, frame, stuff, unstuff,
};

use super::super::super::mistake::{Trials, difference, hex};
use super::{Seen, crc_is_right, repaired};

/// The CRC of the sender covers either length.
pub(super) fn length(bytes: &[u8], trials: &mut Trials<'_>) {
    let Some(seen) = Seen::of(bytes).filter(|seen| seen.length != seen.right) else { return };
    let Ok(right) = u16::try_from(seen.right) else { return };
    // A fast status packet that ends early has the right CRC of a block at its end.
    if seen.id == BROADCAST && seen.body.first() == Some(&STATUS) {
        return;
    }
    let mut meant = bytes.to_vec();
    meant.splice(5..PREFIX, right.to_le_bytes());
    let condition = || {
        if usize::from(right.swap_bytes()) == seen.length {
            return "the two bytes of the length are swapped".to_owned();
        }
        let difference = difference(seen.right, seen.length);
        format!("the length is {}, {difference} than it says", hex(&right.to_le_bytes()))
    };
    trials.packet_if(crc_is_right(bytes), repaired(&meant), condition);
    trials.packet(meant, condition);
}

/// Left out everywhere, or at some places; also where the sender's CRC covers it.
pub(super) fn stuffing(bytes: &[u8], trials: &mut Trials<'_>) {
    let Some(seen) = Seen::whole(bytes) else { return };
    let front = seen.before.get(..PREFIX).unwrap_or_default();
    for plain in [plain(seen.body), seen.body.to_vec()] {
        let stuffed = stuff(&plain);
        let covered = crc(&[front, &stuffed].concat()).to_le_bytes() == seen.crc;
        let meant = frame(seen.id, &stuffed);
        let condition = |crc: &str| {
            let missing = meant.len() - bytes.len();
            let s = if missing == 1 { "" } else { "s" };
            format!("the sender left out byte stuffing ({missing} byte{s} FD){crc}")
        };
        trials.packet_if(crc_is_right(bytes), meant.clone(), || condition(""));
        trials.packet_if(covered, meant.clone(), || condition(", which the CRC covers"));
    }
}

/// Added to what had it. Alone, such a packet is right; it says something else than was meant.
pub(super) fn twice(bytes: &[u8], trials: &mut Trials<'_>) {
    let Some(seen) = Seen::whole(bytes) else { return };
    let Ok(once) = unstuff(seen.body) else { return };
    let condition = || "the sender added byte stuffing twice".to_owned();
    trials.packet_if(crc_is_right(bytes), frame(seen.id, &once), condition);
}

/// The body without byte stuffing, where it has any.
pub(super) fn plain(body: &[u8]) -> Vec<u8> {
    let mut plain: Vec<u8> = Vec::new();
    let mut stuffed = false;
    for byte in body {
        if !(stuffed && *byte == 0xFD) {
            plain.push(*byte);
        }
        stuffed = !stuffed && plain.ends_with(&PATTERN);
    }
    plain
}

/// The reserved byte left out, and covered by the CRC or not.
pub(super) fn reserved(bytes: &[u8], trials: &mut Trials<'_>) {
    let Some(rest) = bytes.strip_prefix(&PATTERN) else { return };
    let meant = [&HEADER, rest].concat();
    let condition = || "the reserved byte 00 comes after FF FF FD".to_owned();
    trials.packet(meant.clone(), condition);
    trials.packet_if(crc_is_right(bytes), repaired(&meant), condition);
}

/// Other bytes in the place of the header, which the sender's CRC covers.
pub(super) fn header(bytes: &[u8], trials: &mut Trials<'_>) {
    let mut meant = bytes.to_vec();
    let Some(place) = meant.first_chunk_mut() else { return };
    let found = std::mem::replace(place, HEADER);
    meant = repaired(&meant);
    let condition = || format!("the header is {}, not {}", hex(&HEADER), hex(&found));
    trials.packet_if(crc_is_right(bytes) && found != HEADER, meant, condition);
}

/// A status packet without its instruction, which length and CRC may cover or not.
pub(super) fn status(bytes: &[u8], trials: &mut Trials<'_>) {
    let (front, rest) = bytes.split_at_checked(PREFIX).unwrap_or_default();
    let meant = [front, &[STATUS], rest].concat();
    let condition = || "the instruction 55 of a status packet comes after the length".to_owned();
    trials.packet_if(crc_is_right(bytes), repaired(&meant), condition);
    trials.packet(meant, condition);
}

pub(super) fn trailing(bytes: &[u8], trials: &mut Trials<'_>) {
    let Some(seen) = Seen::of(bytes) else { return };
    if let Some((packet, after)) = bytes.split_at_checked(PREFIX + seen.length) {
        trials.without_end(packet, after);
    }
}

/// `FF FF ID LENGTH INSTRUCTION PARAMETERS CHECKSUM`: the complement of the sum of all from the ID on.
pub(super) fn protocol_1(bytes: &[u8], trials: &mut Trials<'_>) {
    let (mut rest, mut ids) = (bytes, Vec::new());
    while let [0xFF, 0xFF, id, length, behind @ ..] = rest {
        let Some((body, next)) = behind.split_at_checked(usize::from(*length)) else { return };
        let sum = [*id, *length].iter().chain(body).fold(0_u8, |sum, byte| sum.wrapping_add(*byte));
        // An ID of FF would look like a longer header.
        if *id > 0xFE || body.len() < 2 || sum != 0xFF {
            return;
        }
        ids.push(id.to_string());
        rest = next;
    }
    if rest.is_empty() && !ids.is_empty() {
        let word = if ids.len() == 1 { "it is a packet" } else { "they are packets" };
        let more = match ids.split_off(ids.len().min(4)).len() {
            0 => String::new(),
            more => format!(" and {more} more"),
        };
        trials.fits(format!("{word} of Protocol 1.0, of ID {}{more}", ids.join(", ")));
    }
}

/// What came is the beginning of a packet.
pub(super) fn cut(bytes: &[u8], trials: &mut Trials<'_>) {
    let begins = !bytes.is_empty() && bytes.iter().zip(HEADER).all(|(byte, right)| *byte == right);
    let missing = match *bytes {
        _ if !begins => return,
        [_, _, _, _, id, ..] if id == 0xFD || id == 0xFF => return,
        [_, _, _, _, _, low, high, ..] => {
            let size = PREFIX + usize::from(u16::from_le_bytes([low, high]));
            size.checked_sub(bytes.len()).filter(|missing| *missing > 0 && size > PREFIX + 2)
        }
        _ => return trials.fits("the rest of the packet follows".to_owned()),
    };
    let Some(missing) = missing else { return };
    // If only the last byte is missing, the one before it is checked.
    let condition = if let (1, Some((low, before))) = (missing, bytes.split_last()) {
        let [right, last] = crc(before).to_le_bytes();
        if *low != right {
            return;
        }
        format!("one more byte follows: {last:02X}")
    } else {
        let follow = if missing == 1 { "byte follows" } else { "bytes follow" };
        format!("{missing} more {follow}")
    };
    trials.fits(condition);
}
