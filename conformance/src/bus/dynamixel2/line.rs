//! The line: what carries bytes between the host and the devices, and when they are there.

use std::time::Duration;

use actucheck_codec::dynamixel2::HEADER;
use actucheck_codec::dynamixel2::stream::{Event, Parser};
use actucheck_spec::wire::dynamixel2::reference::repair;

use super::super::fault::Alarm;
use super::super::{Chunk, DeviceState, Devices, QUIET};
use super::LARGEST_ID;
use super::damaged::Damaged;
use super::device::VirtualDevice;
use super::hearing::Hearing;
use super::readings::{CrcError, LineReadings};

/// Bits of a byte on the line: a start bit, the byte, a stop bit.
const BITS: u64 = 10;
/// Blocks of 64 bytes: the longest packet that the length field can say.
const BLOCKS: usize = 1025;

/// A half-duplex line with its devices.
pub(in super::super) struct Line {
    parser: Box<Parser<BLOCKS>>,
    damaged: Damaged,
    /// When the last byte was heard.
    heard: Duration,
    devices: Vec<VirtualDevice>,
    readings: LineReadings,
    clock: Clock,
    scratch: Vec<u8>,
}

impl Line {
    /// A line on which bytes take no time, unless it has a rate in bit/s.
    pub(in super::super) fn new(
        devices: Vec<VirtualDevice>,
        readings: LineReadings,
        rate: Option<u32>,
    ) -> Self {
        Self {
            parser: Box::new(Parser::with_max_packet(BLOCKS * 64)),
            damaged: Damaged::default(),
            heard: Duration::ZERO,
            devices,
            readings,
            clock: Clock { rate, free: Duration::ZERO },
            scratch: Vec::new(),
        }
    }
}

impl Devices for Line {
    fn hear(&mut self, bytes: &[u8], now: Duration, send: &mut dyn FnMut(Chunk)) -> Duration {
        if now.saturating_sub(self.heard) > QUIET {
            self.quiet();
        }
        let Self { parser, damaged, devices, readings, clock, scratch, .. } = self;
        self.heard = clock.carry(bytes.len(), now);
        parser.feed(bytes, |event| {
            // Bytes that are no packet are for nobody.
            if let Event::Frame(frame) = event {
                let readings = *readings;
                Hearing { devices, readings, clock, now, send }.hear(&frame, scratch);
            }
        });
        if readings.crc_error == CrcError::Answer {
            damaged.feed(bytes, |packet| {
                let readings = *readings;
                Hearing { devices, readings, clock, now, send }.hear_damaged(packet);
            });
        }
        self.heard
    }

    fn restart(&mut self, now: Duration) {
        for device in &mut self.devices {
            device.advance(now);
            device.reboot();
        }
    }

    fn alarm(&mut self, alarm: Alarm) {
        let names: &[_] = match alarm {
            Alarm::LowVoltage => &["Input Voltage Error"],
            Alarm::Overheating => &["Overheating Error"],
            Alarm::Overload => &["Overload Error"],
            Alarm::Encoder => &["Encoder Error", "Motor Encoder Error"],
        };
        for device in &mut self.devices {
            device.alarm(names);
        }
    }

    fn rename(&self, answer: &mut [u8]) {
        // The ID comes after the header.
        if let Some(id) = answer.get_mut(HEADER.len()) {
            *id = if *id < LARGEST_ID { *id + 1 } else { 0 };
        }
        repair(answer);
    }

    fn free(&self) -> Duration {
        self.clock.free
    }

    fn is_within_packet(&self) -> bool {
        self.parser.pending() > 0
    }

    fn quiet(&mut self) {
        self.parser.idle();
        self.damaged.quiet();
    }

    fn first(&self, bytes: &[u8]) -> usize {
        let rest = bytes.strip_prefix(&HEADER).filter(|_| !self.is_within_packet());
        match rest {
            Some([_, low, high, ..]) => {
                let length = u16::from_le_bytes([*low, *high]);
                HEADER.len() + 3 + usize::from(length)
            }
            _ => 1,
        }
    }

    fn states(&mut self, now: Duration) -> Vec<DeviceState> {
        self.devices.iter_mut().map(|device| device.state(now)).collect()
    }
}

/// When the line is free.
pub(super) struct Clock {
    rate: Option<u32>,
    free: Duration,
}

impl Clock {
    /// Carries bytes from `now` on, or when those before them are through. Returns when the last of
    /// them is there.
    pub(super) fn carry(&mut self, bytes: usize, now: Duration) -> Duration {
        let start = self.free.max(now);
        self.free = self.rate.filter(|rate| *rate > 0).map_or(start, |rate| {
            let bits = u64::try_from(bytes).unwrap_or(u64::MAX).saturating_mul(BITS);
            start + Duration::from_nanos(bits.saturating_mul(1_000_000_000) / u64::from(rate))
        });
        self.free
    }

    /// A device waits before it answers, where time counts.
    pub(super) fn wait(&mut self, delay: Duration, now: Duration) {
        if self.rate.is_some() {
            self.free = self.free.max(now) + delay;
        }
    }
}
