//! Parts of a frame that are wrong, missing or left over.

use actucheck_codec::innfos::HEADER;
use actucheck_spec::wire::Direction;
use actucheck_spec::wire::innfos::reference::{PREFIX, TAIL, crc, decode};

use super::super::super::mistake::{Trials, difference, hex};
use super::super::CRC_AND_END;

/// More data than in any frame of the document: a length above it is no evidence of a frame.
const MOST: usize = 255;

/// A frame that went the other way than was told.
pub(super) fn direction(bytes: &[u8], trials: &mut Trials<'_>) {
    for direction in Direction::ALL {
        if decode(direction, bytes).is_ok() {
            trials.fits(format!("it is a {direction}"));
        }
    }
}

/// With a CRC or without.
pub(super) fn length(bytes: &[u8], trials: &mut Trials<'_>) {
    let Some(is) = stated(bytes) else { return };
    for around in [1, CRC_AND_END] {
        let Some(right) = bytes.len().checked_sub(PREFIX + around) else { return };
        let Ok(field) = u16::try_from(right) else { return };
        let mut meant = bytes.to_vec();
        meant.splice(3..PREFIX, field.to_be_bytes());
        let condition = || {
            if usize::from(field.swap_bytes()) == is {
                "the two bytes of the length are swapped".to_owned()
            } else if is == 8 * right {
                "the length counts bits".to_owned()
            } else {
                let difference = difference(right, is);
                format!("the length is {}, {difference} than it says", hex(&field.to_be_bytes()))
            }
        };
        trials.packet_if(is != right, meant, condition);
    }
}

pub(super) fn header(bytes: &[u8], trials: &mut Trials<'_>) {
    // One more before a header is an address.
    let Some((first, rest)) = bytes.split_first().filter(|(first, _)| **first != HEADER) else {
        return;
    };
    let condition = || format!("the header is {HEADER:02X}, not {first:02X}");
    trials.packet([&[HEADER], rest].concat(), condition);
    trials.packet([&[HEADER], bytes].concat(), || format!("a header {HEADER:02X} comes first"));
}

pub(super) fn end(bytes: &[u8], trials: &mut Trials<'_>) {
    let Some((last, before)) = bytes.split_last() else { return };
    let condition = || format!("the last byte is {TAIL:02X}, not {last:02X}");
    trials.packet([before, &[TAIL]].concat(), condition);
    trials.packet([bytes, &[TAIL]].concat(), || format!("the end byte {TAIL:02X} follows"));
}

pub(super) fn trailing(bytes: &[u8], trials: &mut Trials<'_>) {
    let Some(length) = stated(bytes) else { return };
    for around in [1, CRC_AND_END] {
        let Some((frame, after)) = bytes.split_at_checked(PREFIX + length + around) else { return };
        trials.without_end(frame, after);
    }
}

/// What came is the beginning of a frame.
pub(super) fn cut(bytes: &[u8], trials: &mut Trials<'_>) {
    if bytes.first() != Some(&HEADER) {
        return;
    }
    let Some(length) = stated(bytes) else {
        return trials.fits("the rest of the frame follows".to_owned());
    };
    if length > MOST {
        return;
    }
    let least = (PREFIX + length + 1).saturating_sub(bytes.len());
    if least > 0 {
        let follow = if least == 1 { "byte follows" } else { "bytes follow" };
        let with_crc = least + 2;
        return trials.fits(format!("{least} more {follow}, or {with_crc} if it has a CRC"));
    }
    // One byte of its CRC is there, and must be right. If only the end byte is missing, the end is wrong.
    let (body, _) = bytes.split_at_checked(PREFIX + length).unwrap_or_default();
    let data = body.get(PREFIX..).unwrap_or_default();
    let whole = [body, &crc(data).to_le_bytes(), &[TAIL]].concat();
    if let Some(rest) = whole.strip_prefix(bytes).filter(|rest| rest.len() == 2) {
        trials.packet(whole.clone(), || format!("2 more bytes follow: {}", hex(rest)));
    }
}

/// Nothing tells which of the two is missing, nor its value.
pub(super) fn who_or_what(bytes: &[u8], trials: &mut Trials<'_>) {
    if let Some((header, rest)) = bytes.split_first() {
        trials.like(&[&[*header, 0], rest].concat(), "the address or the command is missing");
    }
}

/// The length field.
fn stated(bytes: &[u8]) -> Option<usize> {
    let [_, _, _, high, low, ..] = *bytes else { return None };
    Some(usize::from(u16::from_be_bytes([high, low])))
}
