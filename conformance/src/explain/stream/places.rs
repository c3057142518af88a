//! Where and when each byte of a stream was.

use std::collections::VecDeque;
use std::time::Duration;

use super::Place;

/// The places of the bytes that are in no event yet.
#[derive(Default)]
pub(in crate::explain) struct Places {
    /// Bytes before the next event.
    at: u64,
    fed: u64,
    /// The pieces from the next event on: where each ends, its line and its time.
    pieces: VecDeque<(u64, Option<u64>, Option<Duration>)>,
}

/// Longer than any packet: of skipped bytes before it, only the first have a place.
const LONGEST: u64 = 128 << 10;

impl Places {
    /// Takes a piece of so many bytes with its line and its time.
    pub(super) fn feed(&mut self, bytes: u64, line: Option<u64>, time: Option<Duration>) {
        self.fed += bytes;
        self.pieces.push_back((self.fed, line, time));
        while self.pieces.get(1).is_some_and(|(end, ..)| end + LONGEST < self.fed) {
            self.pieces.remove(1);
        }
    }

    /// How many bytes were fed.
    pub(super) const fn fed(&self) -> u64 {
        self.fed
    }

    /// The place of the next byte.
    pub(super) fn next(&mut self) -> Place {
        while self.pieces.len() > 1 && self.pieces.front().is_some_and(|(end, ..)| *end <= self.at)
        {
            self.pieces.pop_front();
        }
        let (_, line, time) = self.pieces.front().copied().unwrap_or_default();
        Place { at: self.at, line, time }
    }

    /// Passes so many bytes, and returns the time of the last one.
    pub(super) fn pass(&mut self, bytes: u64) -> Option<Duration> {
        self.at += bytes;
        let piece = self.pieces.iter().find(|(end, ..)| *end >= self.at);
        piece.and_then(|(_, _, time)| *time)
    }
}

#[cfg(test)]
mod tests {
    use actucheck_spec::wire::Wire;

    use super::super::{Event, Follower, Heard, Skipped};
    use crate::device::Tables;

    #[test]
    fn long_noise_in_many_lines_is_not_remembered_line_by_line() {
        let mut follower =
            Follower::new(Wire::default(), Tables::default()).expect("the default is followed");
        for line in 1..=400_000 {
            follower.feed(&[0], None, Some(line), None, &mut |_| {});
        }
        assert!(follower.places.pieces.len() < 200_000, "{}", follower.places.pieces.len());
        let mut places = Vec::new();
        follower.feed(
            b"\xFF\xFF\xFD\0\x01\x03\0\x01\x19\x4E",
            None,
            Some(400_001),
            None,
            &mut |event| {
                if let Event::Packet(Heard { place, .. }, _)
                | Event::Skipped(Skipped { place, .. }) = event
                {
                    places.push((place.at, place.line));
                }
            },
        );
        assert_eq!(places, [(0, Some(1)), (400_000, Some(400_001))]);
    }
}
