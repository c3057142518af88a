//! The stream parser on bytes as they are.

use actucheck_spec::wire::dynamixel2::reference::{self, HEADER, PREFIX};

use super::stream;
use crate::draw::Draw;

/// The input is what a bus carries; somewhere in it, drawn from its bytes, the bus is quiet.
///
/// # Panics
/// If the codec is wrong.
pub fn check(input: &[u8]) {
    let pause = Draw::of(input).below(input.len() + 1);
    let (before, behind) = input.split_at(pause);
    stream::events(&[input.to_vec(), Vec::new()]);
    stream::events(&[before.to_vec(), behind.to_vec()]);
}

/// Gives every packet that is whole by its length the CRC that it should have. Of overlapping ones
/// the last is right then.
pub fn repair(input: &mut [u8]) {
    for start in 0..input.len() {
        let Some(rest) = input.get_mut(start..).filter(|rest| rest.starts_with(&HEADER)) else {
            continue;
        };
        let Some(length) = rest.get(5..PREFIX) else { break };
        let end = PREFIX + usize::from(u16::from_le_bytes([length[0], length[1]]));
        if let Some((body, crc)) = rest.get_mut(..end).and_then(<[u8]>::split_last_chunk_mut::<2>) {
            *crc = reference::crc(body).to_le_bytes();
        }
    }
}
