use super::{Direction, Frame, FrameError};

/// The frames of a datagram, one after the other. The bytes after a damaged frame are skipped: the
/// document does not say where to continue.
///
/// ```
/// use actucheck_codec::innfos::{Direction, frames};
/// let datagram = b"\xEE\x01\x0E\x00\x01\x01\xED\xEE\x06\x07\x00\x01\x01\xED";
/// let mut frames = frames(Direction::Reply, datagram);
/// assert_eq!(frames.next().unwrap()?.address(), 1);
/// assert_eq!(frames.next().unwrap()?.address(), 6);
/// assert_eq!(frames.next(), None);
/// # Ok::<(), actucheck_codec::innfos::FrameError>(())
/// ```
#[must_use]
pub const fn frames(direction: Direction, datagram: &[u8]) -> Frames<'_> {
    Frames { direction, rest: datagram }
}

/// The iterator of [`frames`]. It ends after an error, whose offset counts from the first byte of
/// the damaged frame.
#[derive(Clone, Debug)]
pub struct Frames<'a> {
    direction: Direction,
    rest: &'a [u8],
}

impl<'a> Iterator for Frames<'a> {
    type Item = Result<Frame<'a>, FrameError>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.rest.is_empty() {
            return None;
        }
        let first = Frame::first(self.direction, self.rest);
        self.rest = first.map_or(&[], |(_, rest)| rest);
        Some(first.map(|(frame, _)| frame))
    }
}
