//! What each target does with its input.

use actucheck_codec::stuffing::{stuff, stuffed_len, unstuff};
use actucheck_codec::{Frame, frame};

/// Stuffing and back is the identity, equals search and replace, and leaves no header.
///
/// # Panics
/// If the codec is wrong.
pub fn stuffing(body: &[u8]) {
    let mut stuffed = vec![0; stuffed_len(body)];
    stuff(body, &mut stuffed).unwrap();
    assert_eq!(stuffed, replaced(body));
    assert!(!stuffed.windows(4).any(|window| window == [0xFF, 0xFF, 0xFD, 0x00]));
    let mut back = vec![0; stuffed.len()];
    assert_eq!(unstuff(&stuffed, &mut back).unwrap(), body);
}

/// The body with FD behind every pattern, one comparison a byte.
fn replaced(body: &[u8]) -> Vec<u8> {
    let mut out = Vec::new();
    for end in 1..=body.len() {
        out.push(body[end - 1]);
        if body[..end].ends_with(&[0xFF, 0xFF, 0xFD]) {
            out.push(0xFD);
        }
    }
    out
}

/// What is read as a packet is built again to the very same bytes; the rest does not panic.
///
/// # Panics
/// If the codec is wrong.
pub fn frame(bytes: &[u8]) {
    let Ok(packet) = Frame::parse(bytes) else { return };
    let params: Vec<u8> = packet.params().collect();
    let mut again = vec![0; bytes.len()];
    let built = frame::encode(packet.id(), packet.instruction(), &[&params], &mut again);
    assert_eq!(built.unwrap(), bytes);
}
