//! The line to a device: what is sent, and what comes back in time.

#[cfg(test)]
mod tests;

use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use actucheck_spec::model::HexBytes;
use actucheck_spec::wire::{Direction, Packet, Wire};

use super::counts::Counts;
use super::decided;
use super::other_host::Own;
use super::record::Record;
use crate::adapter::{Asked, Heard, Pause, Piece, Reported};
use crate::port::{Bytes, Place, Port, PortError};
use crate::suite::device;
use crate::traffic::Traffic;

/// A pause between two looks at a shaft that turns.
const POLL: Duration = Duration::from_millis(10);
/// A pause in which bytes arrive alone.
const MOMENT: Duration = Duration::from_millis(2);
/// The shortest and the longest pause for an answer, whatever answers took so far.
const PAUSE: (Duration, Duration) = (SHORTEST_PAUSE, Duration::from_millis(200));
/// The shortest of them, from which it can be told about how long a run takes.
pub const SHORTEST_PAUSE: Duration = Duration::from_millis(5);
/// How long the line must be quiet after several packets at once: their answers come one after the other.
const SETTLED: Duration = Duration::from_millis(50);
/// After so many times the limit nothing more is listened to, even if bytes still come.
const MOST: u32 = 20;
/// How long it is listened for more devices.
const MORE: Duration = Duration::from_millis(100);
/// The most that is received before a conversation, in how many pieces.
const DRAINED: usize = 64;

/// No bytes.
static NOTHING: Asked = Asked {
    packet: None,
    fast: None,
    send: Vec::new(),
    awaits: 0,
    again: 0,
    until: None,
    only_if: None,
    sum: None,
};
/// The line to a device.
#[derive(Debug)]
pub struct Line {
    pub(super) wire: Wire,
    pub(super) place: Place,
    port: Box<dyn Bytes>,
    /// How long an answer is awaited.
    pub(super) limit: Duration,
    /// When this is set, no answer is awaited any more.
    interrupted: Arc<AtomicBool>,
    /// Whether the device is restored, which an interruption does not end.
    pub(super) is_restoring: bool,
    /// Whether what is sent comes back, as with most adapters for a line of one wire.
    echoes: bool,
    /// The bytes that ask whether the device is there, and what it answered last.
    hello: Option<(Vec<u8>, Packet)>,
    /// Why the port can't be used any more.
    pub(super) gone: Option<String>,
    /// What was sent last.
    last: Own,
    /// Whether several packets were sent at once, whose answers may still come.
    owes: bool,
    /// What passed so far.
    counts: Counts,
}

impl Line {
    /// Opens the line; `baud` is the rate in bit/s of a serial port.
    ///
    /// # Errors
    /// If the port can't be opened.
    pub fn open(
        wire: Wire,
        place: &Place,
        baud: u32,
        limit: Duration,
        interrupted: Arc<AtomicBool>,
    ) -> Result<Self, PortError> {
        let port = Port::open(place, baud)?;
        Ok(Self::on(wire, place, Box::new(port), limit, interrupted))
    }

    /// A line on a port that is open.
    #[must_use]
    pub fn on(
        wire: Wire,
        place: &Place,
        port: Box<dyn Bytes>,
        limit: Duration,
        interrupted: Arc<AtomicBool>,
    ) -> Self {
        let (place, last, counts) = (place.clone(), Own::default(), Counts::default());
        Self {
            wire,
            place,
            port,
            limit,
            interrupted,
            is_restoring: false,
            echoes: false,
            hello: None,
            gone: None,
            last,
            owes: false,
            counts,
        }
    }

    /// Sends what comes before everything else, if the wire has that, and looks for all devices then, as
    /// every host must there. Returns what answers, or nothing on other wires.
    ///
    /// # Errors
    /// If the port is gone.
    pub fn greet(&mut self, limit: Duration) -> Result<Option<Vec<Packet>>, PortError> {
        let wire = self.wire;
        let (Some(greeting), Some(all)) = (device::greeting(wire), device::hello_all(wire)) else {
            return Ok(None);
        };
        self.ask(&greeting, limit, 1)?;
        Ok(Some(self.ask(&all, MORE, usize::MAX)?))
    }

    /// The packets that come back after a packet, until so many are there or nothing comes for so long.
    /// Finds out whether what is sent comes back too, and keeps the first only answer to a packet as what
    /// tells that the device is there.
    ///
    /// # Errors
    /// If the port is gone.
    pub fn exchange(
        &mut self,
        packet: &Packet,
        limit: Duration,
        awaits: usize,
    ) -> Result<Vec<Packet>, PortError> {
        let packets = self.ask(packet, limit, awaits)?;
        if let ([answer], None) = (packets.as_slice(), &self.hello) {
            self.hello = Some((self.wire.encode(packet).unwrap_or_default(), answer.clone()));
        }
        Ok(packets)
    }

    fn ask(
        &mut self,
        packet: &Packet,
        limit: Duration,
        awaits: usize,
    ) -> Result<Vec<Packet>, PortError> {
        let bytes = self.wire.encode(packet).unwrap_or_default();
        let piece = Piece { after: Pause::None, bytes: bytes.into() };
        let step = Asked { send: vec![piece], awaits, ..Asked::default() };
        let usual = std::mem::replace(&mut self.limit, limit);
        let heard = self.tried(&step);
        self.limit = usual;
        let heard = heard.map_err(|error| PortError::new(&self.place, error))?;
        Ok(step.packets(self.wire, &heard.received()))
    }

    /// A step. Finds out whether what is sent comes back.
    fn tried(&mut self, step: &Asked) -> io::Result<Heard> {
        self.drain()?;
        let heard = self.step(step)?;
        let sent: Vec<u8> = step.send.iter().flat_map(|piece| piece.bytes.0.clone()).collect();
        if self.echoes || !heard.received().starts_with(&sent) {
            return Ok(heard);
        }
        self.echoes = true;
        self.drain()?;
        self.step(step)
    }

    /// Asks all steps, and returns what was heard after each.
    pub(super) fn converse(&mut self, steps: &[Asked]) -> io::Result<Vec<Heard>> {
        let late = self.drain()?;
        self.last.look(self.wire, late)?;
        let mut heard: Vec<Heard> = Vec::new();
        for step in steps {
            let came = self.step(&decided::step(self.wire, step, steps, &heard))?;
            let bits = step.only_if.as_ref();
            let goes_on = bits.is_none_or(|bits| decided::holds(self.wire, step, &came, bits));
            heard.push(came);
            if !goes_on || self.is_interrupted() {
                break;
            }
        }
        let mut pieces = steps.iter().flat_map(|step| &step.send);
        self.owes = pieces.any(|piece| self.are_several(&piece.bytes));
        self.last = Own::of(self.wire, steps, &heard);
        for heard in &heard {
            self.last.look(self.wire, heard.received())?;
        }
        Ok(heard)
    }

    /// Whether these bytes are more than one packet.
    fn are_several(&self, bytes: &HexBytes) -> bool {
        self.wire.stream(std::slice::from_ref(bytes), Some(Direction::Request)).len() > 1
    }

    /// Takes what came since the last conversation, and what may still come of it.
    fn drain(&mut self) -> io::Result<Vec<u8>> {
        let (mut buffer, mut drained) = ([0; 1024], Vec::new());
        let quiet = if std::mem::take(&mut self.owes) { SETTLED } else { Duration::ZERO };
        // A device that sends without end does not stop a run.
        for _ in 0..DRAINED {
            let count = self.port.receive(&mut buffer, quiet)?;
            if count == 0 {
                break;
            }
            self.counts.unasked(count);
            drained.extend_from_slice(buffer.get(..count).unwrap_or_default());
        }
        Ok(drained)
    }

    fn step(&mut self, asked: &Asked) -> io::Result<Heard> {
        let mut record = Record::new(if self.echoes { asked } else { &NOTHING });
        for turn in 0..=asked.again {
            // What came before was not yet it.
            if turn > 0 && asked.until.is_some() {
                self.listen(&mut record, POLL, None)?;
                record = Record::new(if self.echoes { asked } else { &NOTHING });
            }
            for (place, piece) in asked.send.iter().enumerate() {
                match piece.after {
                    Pause::None => {}
                    Pause::Moment => self.listen(&mut record, MOMENT, None)?,
                    Pause::Ms(ms) => {
                        self.listen(&mut record, Duration::from_millis(ms.into()), None)?;
                    }
                    Pause::Answer => {
                        let pause = self.pause();
                        self.listen(&mut record, pause, None)?;
                    }
                }
                if place + 1 == asked.send.len() {
                    record.last_is_sent(asked, self.wire);
                }
                record.sent(&piece.bytes);
                self.counts.sent(&piece.bytes);
                self.port.send(&piece.bytes)?;
            }
            self.listen(&mut record, self.limit, Some(asked))?;
            if self.is_over(&record, asked) && self.is_reached(&record, asked)
                || self.is_interrupted()
            {
                break;
            }
        }
        Ok(record.heard())
    }

    /// Listens until all is there that is `awaited`, or nothing came for so long.
    fn listen(
        &mut self,
        record: &mut Record,
        limit: Duration,
        awaited: Option<&Asked>,
    ) -> io::Result<()> {
        let begun = Instant::now();
        let last_piece = awaited.and_then(|asked| asked.send.last());
        let takes = |piece: &Piece| device::takes(self.wire, &piece.bytes);
        let takes = last_piece.map_or(Duration::ZERO, takes);
        let (mut last, mut is_first) = (begun, true);
        let mut buffer = [0; 4096];
        loop {
            let is_over = awaited.is_some_and(|asked| self.is_over(record, asked));
            let limit_now = if is_first { limit + takes } else { limit };
            let left = limit_now.saturating_sub(last.elapsed());
            if is_over || begun.elapsed() > limit * MOST + takes || self.is_interrupted() {
                return Ok(());
            }
            let count = self.port.receive(&mut buffer, left)?;
            if count == 0 {
                return Ok(());
            }
            let bytes = buffer.get(..count).unwrap_or_default();
            let is_answer = record.received(bytes) && std::mem::take(&mut is_first);
            // What is damaged may be answered late, if it is.
            let is_timed = is_answer && takes.is_zero() && self.port.takes_time();
            let called = awaited.and_then(|asked| asked.packet.as_ref()?.call.as_ref());
            if let Some(call) = called.filter(|_| is_timed) {
                self.counts.answered(call.name, begun.elapsed());
            }
            self.counts.received(count);
            // A pause is as long as it is.
            if awaited.is_some() {
                last = Instant::now();
            }
        }
    }

    /// Whether all is there that is awaited.
    fn is_over(&self, record: &Record, asked: &Asked) -> bool {
        if let Some(fast) = &asked.fast {
            return self.wire.decode(&record.came, &fast.clone().into()).is_ok();
        }
        let packets = asked.packets(self.wire, &record.came);
        // An answer to something else may come late, but nothing comes after the answer to this.
        let is_last = match (asked.send.last(), &self.hello) {
            (Some(Piece { after: Pause::Answer, bytes }), Some((hello, answer)))
                if bytes.0 == *hello =>
            {
                packets.last().is_some_and(|last| self.says(last) == self.says(answer))
            }
            _ => true,
        };
        is_last && packets.len() >= record.before + asked.awaits
    }

    /// Whether what is there holds what is waited for.
    fn is_reached(&self, record: &Record, asked: &Asked) -> bool {
        let data = || decided::data(self.wire, asked, &record.came);
        asked.until.as_ref().is_none_or(|bits| data().is_some_and(|data| bits.are_in(&data.0)))
    }

    /// What a packet says, but for the alert, which a device may get at any time.
    fn says(&self, packet: &Packet) -> Vec<Reported> {
        let reported = device::reported(self.wire, packet).into_iter();
        reported.map(|answer| Reported { alert: None, ..answer }).collect()
    }

    /// How long a pause must be so that an answer would be there.
    fn pause(&self) -> Duration {
        (self.counts.slowest() * 2).clamp(PAUSE.0, PAUSE.1)
    }

    pub(super) fn is_interrupted(&self) -> bool {
        !self.is_restoring && self.interrupted.load(Ordering::Relaxed)
    }

    /// What passed so far.
    #[must_use]
    pub fn traffic(&self) -> Traffic {
        self.counts.traffic()
    }

    /// Why the port can't be used any more, if it can't.
    #[must_use]
    pub fn gone(&self) -> Option<&str> {
        self.gone.as_deref()
    }
}
