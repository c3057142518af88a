//! A device on its port.

mod keeper;
mod record;

use std::io;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use actucheck_spec::model::Role;
use actucheck_spec::wire::{Direction, Packet, Wire};

use super::{Answer, Subject};
use crate::adapter::{
    Asked, Heard, Hello, Implementation, Limits, Output, Pause, Permissions, Piece, Question,
    Reported, VERSION,
};
use crate::port::{Bytes, Place, Port, PortError};
use crate::suite::device;

pub use self::keeper::{Keeper, Kept};
use self::record::Record;

/// A pause in which bytes arrive alone.
const MOMENT: Duration = Duration::from_millis(2);
/// The shortest and the longest pause for an answer, whatever answers took so far.
const PAUSE: (Duration, Duration) = (Duration::from_millis(5), Duration::from_millis(200));
/// After so many times the limit nothing more is listened to, even if bytes still come.
const MOST: u32 = 20;
const OTHER_HOST: &str = "another host sends on this line; stop it, and run this again, as the answers are not to one of them";
/// How long it is listened for more devices.
const MORE: Duration = Duration::from_millis(100);
/// The most bytes of a step that are looked at, and that are kept in how many pieces.
const KEPT: (usize, usize) = (1 << 16, 64);

/// A device on its port. Copies share the port.
#[derive(Clone, Debug)]
pub struct Device {
    hello: Hello,
    line: Arc<Mutex<Line>>,
    allowed: Permissions,
    /// Keeps what it holds, if it may be written to.
    keeper: Arc<Mutex<Option<Keeper>>>,
}

/// The line to a device.
#[derive(Debug)]
pub struct Line {
    wire: Wire,
    place: Place,
    port: Box<dyn Bytes>,
    /// How long an answer is awaited.
    limit: Duration,
    /// When this is set, no answer is awaited any more.
    interrupted: Arc<AtomicBool>,
    /// Whether the device is restored, which an interruption does not end.
    is_restoring: bool,
    /// Whether what is sent comes back, as with most adapters for a line of one wire.
    echoes: bool,
    /// The bytes that ask whether the device is there, and what it answered last.
    hello: Option<(Vec<u8>, Packet)>,
    /// Why the port can't be used any more.
    gone: Option<String>,
    /// What passed so far.
    counts: Counts,
}

/// What passed on a line.
#[derive(Clone, Debug, Default)]
pub struct Counts {
    /// How many packets and parts of packets were sent.
    pub pieces: usize,
    /// How many bytes were sent.
    pub sent: usize,
    /// How many bytes came.
    pub received: usize,
    /// How many bytes came that nothing had asked for.
    pub unasked: usize,
    /// How long the first byte of answers to whole packets took.
    pub times: Vec<Duration>,
}

/// How many times of answers are kept.
const TIMES: usize = 4096;

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
        let (place, counts) = (place.clone(), Counts::default());
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
        let step = Asked { packet: None, fast: None, send: vec![piece], awaits, again: 0 };
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

    fn converse(&mut self, steps: &[Asked]) -> io::Result<Vec<Heard>> {
        self.drain()?;
        let heard: Vec<_> = steps.iter().map(|step| self.step(step)).collect::<io::Result<_>>()?;
        if heard.iter().any(|heard| self.has_other_host(steps, heard)) {
            return Err(io::Error::other(OTHER_HOST));
        }
        Ok(heard)
    }

    /// Whether an instruction for a device came that nothing was sent to. A device that answers with a wrong
    /// instruction has its own ID in the packet.
    fn has_other_host(&self, steps: &[Asked], heard: &Heard) -> bool {
        let wire = self.wire;
        if !wire.tells_direction() {
            return false;
        }
        let requests = |bytes: Vec<u8>| {
            let packets = wire.stream(&[bytes.into()], Some(Direction::Request));
            packets.into_iter().filter(|packet| packet.direction() == Direction::Request)
        };
        let came = requests(heard.received()).map(|packet| wire.device(&packet));
        let pieces = steps.iter().flat_map(|step| &step.send);
        let sent: Vec<u8> = pieces.flat_map(|piece| piece.bytes.0.clone()).collect();
        let sent: Vec<u8> = requests(sent).map(|packet| wire.device(&packet)).collect();
        came.into_iter().any(|device| !sent.contains(&device))
    }

    /// Takes what came since the last conversation.
    fn drain(&mut self) -> io::Result<()> {
        let mut buffer = [0; 1024];
        // A device that sends without end does not stop a run.
        for _ in 0..KEPT.1 {
            match self.port.receive(&mut buffer, Duration::ZERO)? {
                0 => break,
                count => self.counts.unasked += count,
            }
        }
        Ok(())
    }

    fn step(&mut self, asked: &Asked) -> io::Result<Heard> {
        let mut record = Record::new(if self.echoes { asked } else { &NOTHING });
        for _ in 0..=asked.again {
            for (place, piece) in asked.send.iter().enumerate() {
                match piece.after {
                    Pause::None => {}
                    Pause::Moment => self.listen(&mut record, MOMENT, None)?,
                    Pause::Answer => {
                        let pause = self.pause();
                        self.listen(&mut record, pause, None)?;
                    }
                }
                if place + 1 == asked.send.len() {
                    record.last_is_sent(asked, self.wire);
                }
                record.sent(&piece.bytes);
                self.counts.pieces += 1;
                self.counts.sent += piece.bytes.len();
                self.port.send(&piece.bytes)?;
            }
            self.listen(&mut record, self.limit, Some(asked))?;
            if self.is_over(&record, asked) || self.is_interrupted() {
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
            let is_timed = awaited.is_some_and(|asked| asked.packet.is_some()) && takes.is_zero();
            if is_answer && is_timed {
                self.counts.times.truncate(TIMES - 1);
                self.counts.times.push(begun.elapsed());
            }
            self.counts.received += count;
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

    /// What a packet says, but for the alert, which a device may get at any time.
    fn says(&self, packet: &Packet) -> Vec<Reported> {
        let reported = device::reported(self.wire, packet).into_iter();
        reported.map(|answer| Reported { alert: None, ..answer }).collect()
    }

    /// How long a pause must be so that an answer would be there.
    fn pause(&self) -> Duration {
        let slowest = self.counts.times.iter().max().copied().unwrap_or_default();
        (slowest * 2).clamp(PAUSE.0, PAUSE.1)
    }

    fn is_interrupted(&self) -> bool {
        !self.is_restoring && self.interrupted.load(Ordering::Relaxed)
    }

    /// What passed so far.
    #[must_use]
    pub const fn counts(&self) -> &Counts {
        &self.counts
    }

    /// Why the port can't be used any more, if it can't.
    #[must_use]
    pub fn gone(&self) -> Option<&str> {
        self.gone.as_deref()
    }
}

/// No bytes.
static NOTHING: Asked = Asked { packet: None, fast: None, send: Vec::new(), awaits: 0, again: 0 };

impl Device {
    /// A device of this name and firmware on a line.
    #[must_use]
    pub fn new(name: String, firmware: String, line: Line, allowed: Permissions) -> Self {
        let language = "a device".to_owned();
        let implementation = Implementation { name, version: firmware, language, url: None };
        let hello = Hello {
            protocol: VERSION,
            implementation: implementation.legible(),
            wires: vec![line.wire.id().to_owned()],
            ops: vec!["device".to_owned()],
            roles: vec![Role::Device],
            calls: None,
            max_in_flight: 1,
            limits: Limits::default(),
        };
        let (line, keeper) = (Arc::new(Mutex::new(line)), Arc::default());
        Self { hello, line, allowed, keeper }
    }

    /// The same device, of which this keeper keeps what it holds. Without one nothing is written to it.
    #[must_use]
    pub fn kept_by(mut self, keeper: Keeper) -> Self {
        self.keeper = Arc::new(Mutex::new(Some(keeper)));
        self
    }

    /// Sets the device back to what it held before, and says what came of it; `None` if nothing was written.
    #[must_use]
    pub fn end(&self) -> Option<Kept> {
        let mut keeper = self.keeper.lock().unwrap_or_else(PoisonError::into_inner);
        let mut line = self.line.lock().unwrap_or_else(PoisonError::into_inner);
        keeper.as_mut()?.end(&mut *line)
    }

    /// Looks at the line.
    pub fn look<T>(&self, look: impl FnOnce(&Line) -> T) -> T {
        look(&self.line.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

impl Subject for Device {
    fn hello(&self) -> &Hello {
        &self.hello
    }

    fn ask(&mut self, question: &Question) -> Answer {
        let Question::Device { needs, steps, .. } = question else {
            return Answer::Skipped("a device has only its port".to_owned());
        };
        let missing = needs.without(&self.allowed);
        if !missing.only_read() {
            return Answer::Skipped(format!("it needs --allow {missing}"));
        }
        let mut keeper = self.keeper.lock().unwrap_or_else(PoisonError::into_inner);
        let mut line = self.line.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(gone) = &line.gone {
            return Answer::NotAsked(gone.clone());
        }
        let heard = if needs.only_read() {
            line.converse(steps)
        } else {
            let Some(keeper) = keeper.as_mut() else {
                return Answer::Skipped("nothing keeps what its registers hold".to_owned());
            };
            if let Err(reason) = keeper.before(needs, &mut *line) {
                return Answer::Skipped(reason);
            }
            let heard = line.converse(steps);
            if heard.is_ok() {
                keeper.after(&mut *line);
            }
            heard
        };
        match heard {
            _ if line.is_interrupted() => Answer::NotAsked("interrupted".to_owned()),
            Ok(heard) => Answer::Ok(Output::Line(heard)),
            Err(error) => {
                let gone = PortError::new(&line.place, error).to_string();
                line.gone = Some(gone.clone());
                Answer::NotAsked(gone)
            }
        }
    }

    /// The same device is asked again what failed.
    fn another(&self) -> Option<Box<dyn Subject + Send>> {
        Some(Box::new(self.clone()))
    }
}
