//! Virtual devices: a bus that programs can't tell from hardware.
//!
//! Nothing here reads a clock or does input and output. Bytes come in with the time, and go out with the
//! time at which they are there; so a test runs in no time, and a program decides what waiting means.
//! Times count from the moment at which the bus got power.
//!
//! ```
//! use std::time::Duration;
//! use actucheck::bus::VirtualBus;
//!
//! let mut bus: VirtualBus = "ja40@1 ja40@2:present-position=2000".parse()?;
//! // Read Present Position, 4 bytes, of device 2.
//! let read = b"\xFF\xFF\xFD\x00\x02\x07\x00\x02\x44\x02\x04\x00\x1E\xA5";
//! bus.send(read, Duration::ZERO);
//! let answer = b"\xFF\xFF\xFD\x00\x02\x08\x00\x55\x00\xD0\x07\x00\x00\x54\x72";
//! assert_eq!(bus.receive(Duration::from_millis(1)), answer);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod answers;
mod dynamixel2;
mod fault;
mod innfos;
mod motion;
mod place;
mod readings;
#[cfg(unix)]
mod script;

use std::collections::VecDeque;
use std::net::SocketAddr;
use std::ops::RangeInclusive;
use std::str::FromStr;
use std::time::Duration;

use actucheck_spec::Spec;
use actucheck_spec::wire::{self, Wire};

use crate::device;

pub(crate) use self::answers::{Answers, Bursts};
pub use self::dynamixel2::VirtualDevice;
use self::fault::{Alarm, Faults, OnDevice, What};
pub use self::fault::{Fault, FaultError};
pub use self::place::{Place, PlaceError, Places, tables};
pub use self::readings::{Reading, ReadingError, Readings};
#[cfg(unix)]
pub(crate) use self::script::Script;

/// Bytes that devices send, and when the last of them is there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Chunk {
    /// The time.
    pub at: Duration,
    /// The bytes.
    pub bytes: Vec<u8>,
}

/// Who sends, and gets what answers it. The bus keeps it with the answers, and does not look at it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sender {
    /// The host's number.
    pub host: u64,
    /// Its address, if several send as this host.
    pub peer: Option<SocketAddr>,
}

/// The devices of a wire, and the line that they are on.
trait Devices: Send {
    /// Takes the bytes of a host, and hands on what devices send, an answer at a time. Returns when the
    /// last byte is there.
    fn hear(&mut self, bytes: &[u8], now: Duration, send: &mut dyn FnMut(Chunk)) -> Duration;

    /// All devices lose their power and get it back.
    fn restart(&mut self, now: Duration);

    /// The devices that know this alarm have it from now on.
    fn alarm(&mut self, alarm: Alarm);

    /// Makes the answer one of another device, which is right in itself.
    fn rename(&self, answer: &mut [u8]);

    /// When the line has carried all that was sent on it.
    fn free(&self) -> Duration;

    /// Whether bytes that were heard may be the beginning of a packet.
    fn is_within_packet(&self) -> bool;

    /// Lets no packet go on after the bytes that were heard.
    fn quiet(&mut self);

    /// How many of these bytes are one packet, if they are the next that are heard. A packet that has
    /// begun, or what is none, comes byte by byte.
    fn first(&self, bytes: &[u8]) -> usize;

    /// What the devices do.
    fn states(&mut self, now: Duration) -> Vec<DeviceState>;
}

/// What a device does, for who looks on. What it does not tell is `None`.
#[derive(Clone, Debug, PartialEq)]
pub struct DeviceState {
    /// Its ID, or its address.
    pub id: u8,
    /// What it is.
    pub name: &'static str,
    /// Its position, in counts or in turns as its wire has them.
    pub position: Option<f64>,
    /// Where it is to go, in the same.
    pub goal: Option<f64>,
    /// Whether torque is on.
    pub torque: Option<bool>,
    /// Its hardware error status or its alarms, 0 for none.
    pub error: Option<i64>,
}

/// What a wire has for a bus.
struct Own {
    wire: Wire,
    /// The IDs that its devices may have.
    ids: RangeInclusive<u8>,
    /// Whether its devices have control tables, which users may write themselves.
    has_tables: bool,
    /// Whether an answer is a datagram of its own.
    has_datagrams: bool,
    /// Whether a device of this name is on it.
    knows: fn(&str) -> bool,
    /// The names of its devices.
    names: fn() -> Vec<String>,
    /// What the documents leave unspecified about them.
    readings: &'static [Reading],
    /// Puts devices on it, at least one.
    connect: Connect,
    /// What is answered on a line that plays a script, whatever the script says: what a host may ask before
    /// it makes calls, and each time the answers.
    #[cfg(unix)]
    greeted: fn() -> Vec<script::Greeted>,
}

type Connect = fn(&Spec, &[Place], &Setup) -> Result<Box<dyn Devices>, PlaceError>;

/// The wires whose devices there are.
static WIRES: [Own; 2] = [
    Own {
        wire: wire::innfos::WIRE,
        ids: innfos::ADDRESSES,
        has_tables: false,
        has_datagrams: true,
        knows: innfos::knows,
        names: innfos::names,
        readings: innfos::READINGS,
        connect: innfos::board,
        #[cfg(unix)]
        greeted: innfos::greeted,
    },
    Own {
        wire: wire::dynamixel2::WIRE,
        ids: 0..=dynamixel2::LARGEST_ID,
        has_tables: true,
        has_datagrams: false,
        knows: device::knows,
        names: dynamixel2::names,
        readings: dynamixel2::READINGS,
        connect: dynamixel2::line,
        #[cfg(unix)]
        greeted: Vec::new,
    },
];

/// Whether an answer on this wire is a datagram of its own.
pub(crate) fn has_datagrams(wire: Wire) -> bool {
    WIRES.iter().any(|own| own.wire == wire && own.has_datagrams)
}

/// The IDs that devices on this wire may have.
pub(crate) fn ids(wire: Wire) -> RangeInclusive<u8> {
    let own = WIRES.iter().find(|own| own.wire == wire);
    own.map_or(0..=u8::MAX, |own| own.ids.clone())
}

/// Whether devices on this wire have control tables.
pub(crate) fn has_tables(wire: Wire) -> bool {
    WIRES.iter().any(|own| own.wire == wire && own.has_tables)
}

/// No packet goes on after so long a pause.
pub const QUIET: Duration = Duration::from_millis(100);

/// While so many answers are on their way, what is sent waits.
const MOST: usize = 1024;

/// Devices on a bus.
pub struct VirtualBus {
    own: &'static Own,
    devices: Box<dyn Devices>,
    echo: bool,
    faults: Faults,
    /// What is on its way, by time, and to whom.
    coming: VecDeque<(Sender, Chunk)>,
    /// When the last piece of an answer that was split is there. No other comes before that.
    split: Duration,
}

/// What a bus is besides its devices.
#[derive(Clone, Debug, Default)]
pub struct Setup {
    /// What is done where the documents leave something open.
    pub readings: Readings,
    /// The rate of the line in bit/s; bytes take no time if it is `None`. A network has none.
    pub rate: Option<u32>,
    /// Whether a host hears what it sends, as with most adapters for a line of one wire.
    pub echo: bool,
    /// What goes wrong.
    pub faults: Vec<Fault>,
    /// Where the faults' chance begins.
    pub seed: u64,
}

impl VirtualBus {
    /// A bus with these devices, which have just got power.
    ///
    /// # Errors
    /// If a device or a register is not known, there is no device, or they are of two wires.
    pub fn new(spec: &Spec, places: &[Place], setup: Setup) -> Result<Self, PlaceError> {
        let own = place::wire(places)?;
        let devices = (own.connect)(spec, places, &setup)?;
        let Setup { echo, faults, seed, .. } = setup;
        let (faults, coming) = (Faults::new(faults, seed), VecDeque::new());
        Ok(Self { own, devices, echo, faults, coming, split: Duration::ZERO })
    }

    /// A line on which nothing answers but a script; `None` if there is no such line for the wire.
    #[cfg(unix)]
    pub(crate) fn scripted(wire: Wire, script: Script) -> Option<Self> {
        let own = WIRES.iter().find(|own| own.wire == wire)?;
        script.greet((own.greeted)());
        let (devices, faults) = (Box::new(script), Faults::new(Vec::new(), 0));
        Some(Self {
            own,
            devices,
            echo: false,
            faults,
            coming: VecDeque::new(),
            split: Duration::ZERO,
        })
    }

    /// The wire of its devices.
    #[must_use]
    pub const fn wire(&self) -> Wire {
        self.own.wire
    }

    /// Takes what the only host sends.
    pub fn send(&mut self, bytes: &[u8], now: Duration) {
        self.send_from(Sender::default(), bytes, now);
    }

    /// Takes what one of several hosts sends. Returns when the last byte is there.
    pub fn send_from(&mut self, sender: Sender, bytes: &[u8], now: Duration) -> Duration {
        let mut answers = Vec::new();
        let heard = self.devices.hear(bytes, now, &mut |chunk| answers.push(chunk));
        if self.echo && !bytes.is_empty() {
            self.put(sender, Chunk { at: heard, bytes: bytes.to_vec() });
        }
        for answer in answers {
            let pieces = self.struck(answer, now);
            let is_split = pieces.len() > 1;
            for Chunk { at, bytes } in pieces {
                let at = at.max(self.split);
                self.split = if is_split { at } else { self.split };
                self.put(sender, Chunk { at, bytes });
            }
        }
        heard
    }

    /// What arrives of an answer.
    fn struck(&mut self, answer: Chunk, now: Duration) -> Vec<Chunk> {
        let mut pieces = vec![answer];
        let mut faults = self.faults.next();
        // What a device does comes before what the line does to it.
        faults.sort_by_key(|fault| matches!(fault, What::Line(_)));
        for fault in faults {
            match fault {
                What::Line(fault) => self.faults.strike(fault, &mut pieces),
                What::Device(OnDevice::OtherId) => {
                    for piece in &mut pieces {
                        self.devices.rename(&mut piece.bytes);
                    }
                }
                What::Device(OnDevice::Power) => {
                    pieces.clear();
                    self.devices.restart(now);
                }
                What::Device(OnDevice::Alarm(alarm)) => self.devices.alarm(alarm),
            }
        }
        pieces
    }

    fn put(&mut self, sender: Sender, chunk: Chunk) {
        let place = self.coming.partition_point(|(_, other)| other.at <= chunk.at);
        self.coming.insert(place, (sender, chunk));
    }

    /// The bytes that are there by now. Where answers are datagrams, those of one: take them until there
    /// are none.
    #[must_use]
    pub fn receive(&mut self, now: Duration) -> Vec<u8> {
        self.receive_for(now).map(|(_, bytes)| bytes).unwrap_or_default()
    }

    /// The same, and who has asked for them: take them until there are none.
    pub fn receive_for(&mut self, now: Duration) -> Option<(Sender, Vec<u8>)> {
        let (sender, Chunk { mut bytes, .. }) =
            self.coming.pop_front_if(|(_, chunk)| chunk.at <= now)?;
        let goes_on = |next: &mut (Sender, Chunk)| next.0 == sender && next.1.at <= now;
        while !self.own.has_datagrams
            && let Some((_, chunk)) = self.coming.pop_front_if(goes_on)
        {
            bytes.extend(chunk.bytes);
        }
        Some((sender, bytes))
    }

    /// Whether something is on its way to a host.
    #[must_use]
    pub fn is_awaited(&self, host: u64) -> bool {
        self.coming.iter().any(|(sender, _)| sender.host == host)
    }

    /// When the next bytes are there; `None` if none are on their way.
    #[must_use]
    pub fn next(&self) -> Option<Duration> {
        self.coming.front().map(|(_, chunk)| chunk.at)
    }

    /// When the line has carried all that was sent on it, and not too many answers are on their way. What
    /// is sent before then waits.
    #[must_use]
    pub fn free(&self) -> Duration {
        let next = self.next().filter(|_| self.coming.len() >= MOST);
        self.devices.free().max(next.unwrap_or_default())
    }

    /// Whether the last bytes that were sent may be the beginning of a packet.
    #[must_use]
    pub fn is_within_packet(&self) -> bool {
        self.devices.is_within_packet()
    }

    /// Lets no packet go on after the bytes that were sent last, and by whom. Packets after a false
    /// beginning of one are heard now.
    pub fn quiet(&mut self, sender: Sender, now: Duration) {
        self.devices.quiet();
        self.send_from(sender, &[], now);
    }

    /// What the devices do.
    #[must_use]
    pub fn devices(&mut self, now: Duration) -> Vec<DeviceState> {
        self.devices.states(now)
    }

    /// How many of some bytes to send next, so that no packet is sent together with what comes after it.
    #[must_use]
    pub fn first(&self, bytes: &[u8]) -> usize {
        self.devices.first(bytes).min(bytes.len())
    }
}

/// Devices with white space between: `ja40@1 ja40@2:present-position=2000 my-servo.yaml@7`.
impl FromStr for VirtualBus {
    type Err = PlaceError;

    fn from_str(text: &str) -> Result<Self, PlaceError> {
        let places = text.split_whitespace().map(str::parse).collect::<Result<Vec<_>, _>>()?;
        let spec = Spec::embedded().map_err(|defects| PlaceError::Spec(defects.len()))?;
        Self::new(&spec, &places, Setup::default())
    }
}
