//! The board: what hears the host's frames, and passes them on to the actuators.

use std::time::Duration;

use actucheck_codec::innfos::{
    BROADCAST_ADDRESS, Command, Direction, Flag, Frame, FrameError, HEADER, Message, Value,
};

use super::super::fault::Alarm;
use super::super::{Chunk, DeviceState, Devices, QUIET};
use super::actuator::Actuator;
use super::readings::{BoardReadings, Broadcast};

/// The place of the address in a frame.
const ADDRESS: usize = 1;

/// A board with its actuators.
pub(super) struct Board {
    actuators: Vec<Actuator>,
    readings: BoardReadings,
    /// How long the board looks for actuators.
    query: Duration,
    /// The beginning of a frame.
    begun: Vec<u8>,
    /// When the last byte was heard.
    heard: Duration,
}

impl Board {
    pub(super) fn new(
        actuators: Vec<Actuator>,
        readings: BoardReadings,
        query_milliseconds: u32,
    ) -> Self {
        let query = Duration::from_millis(query_milliseconds.into());
        Self { actuators, readings, query, begun: Vec::new(), heard: Duration::ZERO }
    }

    fn take(&mut self, frame: &Frame<'_>, now: Duration, send: &mut dyn FnMut(Chunk)) {
        let address = frame.address();
        let is_for_all = address == BROADCAST_ADDRESS;
        let mut send = |at: Duration, message: Message| {
            let mut buffer = [0; Message::MAX_LEN];
            // A message that the tables have can be encoded.
            if let Ok(bytes) = message.encode(&mut buffer) {
                send(Chunk { at, bytes: bytes.to_vec() });
            }
        };
        let command = frame.command();
        if command == Command::ReadBoardHandshake {
            if is_for_all && frame.data().is_empty() {
                send(now, Message::reply(address, command, Some(Value::Flag(Flag::YES))));
            }
            return;
        }
        let is_query = command == Command::ReadActuatorQuery;
        let at = if is_query { now + self.query } else { now };
        let is_silent = is_for_all && !is_query && self.readings.broadcast == Broadcast::Silent;
        for actuator in &mut self.actuators {
            if (is_for_all || actuator.address() == address)
                && let Some(value) = actuator.answer(frame, now)
                && !is_silent
            {
                send(at, Message::reply(actuator.address(), command, Some(value)));
            }
        }
    }
}

impl Devices for Board {
    /// A datagram has whole frames. A stream may pause within one. After a damaged frame the next
    /// header counts.
    fn hear(&mut self, bytes: &[u8], now: Duration, send: &mut dyn FnMut(Chunk)) -> Duration {
        let is_whole = Frame::first(Direction::Request, bytes).is_ok();
        if is_whole || now.saturating_sub(self.heard) > QUIET {
            self.begun.clear();
        }
        self.heard = now;
        let mut all = std::mem::take(&mut self.begun);
        all.extend_from_slice(bytes);
        let mut rest = all.as_slice();
        while !rest.is_empty() {
            match Frame::first(Direction::Request, rest) {
                Ok((frame, after)) => {
                    self.take(&frame, now, send);
                    rest = after;
                }
                Err(FrameError::Truncated { .. }) => break,
                Err(_) => {
                    let next = rest.iter().skip(1).position(|byte| *byte == HEADER);
                    rest = next.and_then(|next| rest.get(next + 1..)).unwrap_or_default();
                }
            }
        }
        let taken = all.len() - rest.len();
        all.drain(..taken);
        self.begun = all;
        now
    }

    fn restart(&mut self, now: Duration) {
        self.begun.clear();
        for actuator in &mut self.actuators {
            actuator.restart(now);
        }
    }

    fn alarm(&mut self, alarm: Alarm) {
        for actuator in &mut self.actuators {
            actuator.alarm(alarm);
        }
    }

    fn rename(&self, answer: &mut [u8]) {
        if let Some(address) = answer.get_mut(ADDRESS) {
            *address = address.wrapping_add(1).max(1);
        }
    }

    fn free(&self) -> Duration {
        Duration::ZERO
    }

    fn is_within_packet(&self) -> bool {
        !self.begun.is_empty()
    }

    fn quiet(&mut self) {
        self.begun.clear();
    }

    fn first(&self, bytes: &[u8]) -> usize {
        let frame = Frame::first(Direction::Request, bytes);
        frame.map_or(1, |(_, after)| bytes.len() - after.len())
    }

    fn states(&mut self, now: Duration) -> Vec<DeviceState> {
        self.actuators.iter_mut().map(|actuator| actuator.state(now)).collect()
    }
}
