//! The bytes of a body without stuffing, and their places in the frame.

use super::PREFIX;

/// Maps the bytes of an unstuffed body to their places in the frame.
pub(super) struct WireBody<'a> {
    plain: &'a [u8],
    /// The place in the frame of each byte of `plain`, and of its end.
    places: Vec<usize>,
}

impl<'a> WireBody<'a> {
    pub(super) fn of(stuffed_params: &[u8], plain: &'a [u8]) -> Self {
        let end = PREFIX + 1 + stuffed_params.len();
        let mut places = vec![PREFIX];
        let mut at = PREFIX + 1;
        let seen = |count: usize| plain.get(..count).unwrap_or_default();
        for count in 1..plain.len() {
            // A stuffing byte follows every pattern.
            if seen(count).ends_with(&[0xFF, 0xFF, 0xFD]) {
                at += 1;
            }
            places.push(at);
            at += 1;
        }
        places.push(end);
        Self { plain, places }
    }

    pub(super) fn place(&self, index: usize) -> usize {
        self.places.get(index).or(self.places.last()).copied().unwrap_or(PREFIX)
    }

    /// The bytes from `start` up to `end` with the stuffing that follows each.
    pub(super) fn text(&self, start: usize, end: usize) -> String {
        let bytes = self.plain.get(start..end).unwrap_or_default();
        let words: Vec<_> = bytes
            .iter()
            .enumerate()
            .map(|(index, byte)| {
                let at = start + index;
                let stuffed = self.place(at + 1) - self.place(at) > 1;
                format!("{byte:02x}{}", if stuffed { " (fd)" } else { "" })
            })
            .collect();
        words.join(" ")
    }
}
