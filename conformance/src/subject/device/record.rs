//! What passes on a line.

use std::time::Instant;

use actucheck_spec::wire::{Direction, Wire};

use crate::adapter::{Asked, Heard, Passed};

/// The most bytes of a step that are looked at.
const KEPT: usize = 1 << 16;

/// What passes in a step.
pub(super) struct Record {
    begun: Instant,
    line: Vec<Passed>,
    more: usize,
    /// All that came.
    pub(super) came: Vec<u8>,
    /// What was sent and comes back.
    echo: Vec<u8>,
    /// How many packets came before the last piece was sent.
    pub(super) before: usize,
}

impl Record {
    pub(super) fn new(echoed: &Asked) -> Self {
        let echo = echoed.send.iter().flat_map(|piece| piece.bytes.0.clone()).collect();
        let (line, came, begun) = (Vec::new(), Vec::new(), Instant::now());
        Self { begun, line, more: 0, came, echo, before: 0 }
    }

    pub(super) fn sent(&mut self, bytes: &[u8]) {
        self.add(Direction::Request, bytes);
    }

    /// Takes bytes that came. Returns whether they are more than an echo.
    pub(super) fn received(&mut self, bytes: &[u8]) -> bool {
        let same = self.echo.iter().zip(bytes).take_while(|(sent, came)| sent == came).count();
        self.echo.drain(..same);
        let bytes = bytes.get(same..).unwrap_or_default();
        if bytes.is_empty() {
            return false;
        }
        let room = KEPT.saturating_sub(self.came.len());
        let kept = bytes.get(..room).unwrap_or(bytes);
        self.came.extend_from_slice(kept);
        self.more += bytes.len() - kept.len();
        self.add(Direction::Reply, kept);
        true
    }

    fn add(&mut self, direction: Direction, bytes: &[u8]) {
        let at_ms = u64::try_from(self.begun.elapsed().as_millis()).unwrap_or(u64::MAX);
        match self.line.last_mut() {
            // An answer may come byte by byte.
            Some(last) if last.direction == direction && direction == Direction::Reply => {
                last.bytes.0.extend_from_slice(bytes);
            }
            _ => {
                let bytes = bytes.to_vec().into();
                self.line.push(Passed { at_ms, direction, bytes });
            }
        }
    }

    pub(super) fn last_is_sent(&mut self, asked: &Asked, wire: Wire) {
        self.before = asked.packets(wire, &self.came).len();
    }

    pub(super) fn heard(self) -> Heard {
        Heard { line: self.line, more: self.more }
    }
}
