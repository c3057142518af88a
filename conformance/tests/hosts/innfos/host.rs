//! The host: it makes a call and tells what came of it.

use std::io::{self, ErrorKind};
use std::net::UdpSocket;
use std::time::{Duration, Instant};

use actucheck_codec::innfos::{Command, Format, Operation};
use actucheck_spec::model::HexBytes;
use serde::Serialize;

use super::faults::{Fault, Switch};
use super::frame::{Frame, encode, frames};
use crate::answer::Failure;

const HANDSHAKE: u8 = 0x44;
const QUERY: u8 = 0x02;
const ALARMS: u8 = 0xFF;
/// The alarms that have a name.
const NAMED: u16 = 0x07FF;

/// What an actuator has answered.
#[derive(Clone, Default, Serialize)]
pub(crate) struct Device {
    id: u8,
    #[serde(skip_serializing_if = "Option::is_none")]
    data: Option<HexBytes>,
    #[serde(skip_serializing_if = "Option::is_none")]
    mac: Option<HexBytes>,
}

/// What comes of a call.
pub(crate) type Devices = Result<Vec<Device>, Failure>;

pub(crate) struct Host {
    on: Switch,
    /// How long a call waits for its answer.
    limit: Duration,
    socket: UdpSocket,
    /// Whether the next call finds what is there before it.
    keeps_input: bool,
    /// Whether each call fails from now on.
    is_stuck: bool,
    /// What was read last.
    last: Option<Vec<Device>>,
}

impl Host {
    /// Opens `udp://ADDRESS`.
    pub(crate) fn open(on: Switch, limit: Duration, port: &str) -> io::Result<Self> {
        let address = port.strip_prefix("udp://").ok_or(ErrorKind::InvalidInput)?;
        let socket = UdpSocket::bind("127.0.0.1:0")?;
        socket.connect(address)?;
        let (keeps_input, is_stuck) = (false, false);
        Ok(Self { on, limit, socket, keeps_input, is_stuck, last: None })
    }

    pub(crate) fn call(&mut self, device: u8, command: u8, data: &[u8]) -> Devices {
        if self.is_stuck {
            return Err(Failure::new("port", "the port is in use"));
        }
        let known = Command::from_code(command);
        let Some(row) = known.row().filter(|row| usize::from(row.request) == data.len()) else {
            return Err(Failure::new("refused", "no table has this"));
        };
        if command == HANDSHAKE && self.on.is(Fault::GreetsOnlyInWords) {
            return Ok(vec![told(0, &[1])]);
        }
        self.send(device, command, &self.written(row.format, data))?;
        let result = match (row.operation, row.reply) {
            (_, []) => self.after_setpoint(),
            (_, sizes) if command == QUERY => self.find(sizes),
            (Operation::Read, sizes) => self.read(device, command, sizes),
            (Operation::Write, _) => self.write(device, command),
        };
        let class = result.as_ref().err().map(|failure| failure.class);
        self.keeps_input = self.on.is(Fault::NoDrain)
            || class == Some("timeout") && self.on.is(Fault::LateAnswerForNext);
        self.is_stuck = class == Some("corrupt") && self.on.is(Fault::StuckAfterCorrupt);
        result
    }

    /// The data that is sent.
    fn written(&self, format: Option<Format>, data: &[u8]) -> Vec<u8> {
        let mut data = data.to_vec();
        match self.on.0 {
            Some(Fault::LowByteFirst) => data.reverse(),
            Some(Fault::ModeFromZero) if format == Some(Format::Mode) => data[0] -= 1,
            Some(Fault::ClampsPosition) if data.first().is_some_and(|high| *high >= 0x80) => {
                data.fill(0);
            }
            _ => {}
        }
        data
    }

    fn send(&mut self, device: u8, command: u8, data: &[u8]) -> io::Result<()> {
        if !self.keeps_input {
            while self.receive(Some(Instant::now()))?.is_some() {}
        }
        if self.on.is(Fault::ShowsLife) {
            self.socket.send(&encode(self.on, 6, 0x00, &[]))?;
        }
        let frame = encode(self.on, device, command, data);
        let times = match self.on.0 {
            Some(Fault::AsksTwice) => 2,
            Some(Fault::Floods) => 100,
            _ => 1,
        };
        for _ in 0..times {
            self.socket.send(&frame)?;
        }
        if self.on.is(Fault::TwoDatagrams) {
            self.socket.send(&[0])?;
        }
        Ok(())
    }

    /// The next datagram; `None` at the end of the time, if it has one.
    fn receive(&self, end: Option<Instant>) -> io::Result<Option<Vec<u8>>> {
        let left = end.map(|end| end.saturating_duration_since(Instant::now()));
        // A time-out of zero is none.
        self.socket.set_nonblocking(left == Some(Duration::ZERO))?;
        self.socket.set_read_timeout(left.filter(|left| !left.is_zero()))?;
        let mut bytes = vec![0; 0x1_0000];
        match self.socket.recv(&mut bytes) {
            Ok(count) => Ok(Some(bytes[..count].to_vec())),
            Err(error) if matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut) => {
                Ok(None)
            }
            Err(error) => Err(error),
        }
    }

    /// Takes frames until one is what was waited for, or the time is over. Fails then, as nothing or
    /// something else came.
    fn listen<T>(
        &self,
        expected: usize,
        mut take: impl FnMut(Frame) -> Option<T>,
    ) -> Result<T, Failure> {
        let end = (!self.on.is(Fault::WaitsForever)).then(|| Instant::now() + self.limit);
        let mut other = false;
        while let Some(datagram) = self.receive(end)? {
            for frame in frames(self.on, &datagram, expected) {
                if let Some(taken) = take(frame) {
                    return Ok(taken);
                }
            }
            other = true;
            if self.on.is(Fault::GivesUpAtForeign) {
                break;
            }
        }
        let class = if other { "corrupt" } else { "timeout" };
        Err(Failure::new(class, "no answer came"))
    }

    fn after_setpoint(&self) -> Devices {
        if self.on.is(Fault::WaitsAfterSetpoint) {
            self.listen(1, |_| None::<()>)?;
        }
        Ok(Vec::new())
    }

    fn read(&mut self, device: u8, command: u8, sizes: &[u16]) -> Devices {
        let (on, size) = (self.on, usize::from(sizes[0]));
        let answer = self.listen(size, |Frame { address, command: of, mut data }| {
            let is_meant = (address == device || on.is(Fault::AnyAddress))
                && (of == command || on.is(Fault::AnyCommand));
            if on.is(Fault::PadsWithZero) && data.len() < size {
                data.resize(size, 0);
            }
            if on.is(Fault::CutsToSize) {
                data.truncate(size);
            }
            (is_meant && data.len() == size).then_some(data)
        });
        let mut data = match (answer, &self.last) {
            (Err(_), Some(last)) if on.is(Fault::LastGoodOnTimeout) => return Ok(last.clone()),
            (answer, _) => answer?,
        };
        if on.is(Fault::HandsOnLowByteFirst) {
            data.reverse();
        }
        if on.is(Fault::ZeroIsNoValue) && data.iter().all(|byte| *byte == 0) {
            return Err(Failure::new("timeout", "no value"));
        }
        if let (ALARMS, &[high, low]) = (command, &*data)
            && on.is(Fault::NamedAlarmsOnly)
        {
            data = (u16::from_be_bytes([high, low]) & NAMED).to_be_bytes().to_vec();
        }
        let devices = vec![told(device, &data)];
        let before = self.last.replace(devices.clone());
        Ok(before.filter(|_| on.is(Fault::StaleValues)).unwrap_or(devices))
    }

    fn write(&self, device: u8, command: u8) -> Devices {
        let any = self.on.is(Fault::AnyWriteAddress);
        let done = Ok(vec![Device { id: device, ..Device::default() }]);
        let flag = self.listen(1, |Frame { address, command: of, data }| match *data {
            [flag] if (address == device || any) && of == command => Some(flag),
            _ => None,
        });
        match flag {
            Err(_) if self.on.is(Fault::SilenceIsSuccess) => done,
            Err(failure) => Err(failure),
            Ok(0) if self.on.is(Fault::RefusalIsSuccess) => done,
            Ok(0) if self.on.is(Fault::RefusalIsSilence) => {
                Err(Failure::new("timeout", "nothing came"))
            }
            Ok(0) => Err(Failure::new("status", "the actuator refuses it")),
            Ok(_) => done,
        }
    }

    /// The actuators that answer the query until the time is over.
    fn find(&self, sizes: &[u16]) -> Devices {
        let mut devices: Vec<Device> = Vec::new();
        let largest = sizes.iter().copied().max().unwrap_or_default();
        let ended = self.listen(largest.into(), |Frame { address, command, data }| {
            let is_meant = command == QUERY || self.on.is(Fault::FindsAnything);
            let has_size = sizes.iter().any(|size| usize::from(*size) == data.len());
            let is_new = devices.iter().all(|device| device.id != address);
            if is_meant && has_size && is_new {
                devices.push(Device { id: address, data: None, mac: Some(HexBytes(data)) });
            }
            (self.on.is(Fault::FirstFound) && !devices.is_empty()).then_some(())
        });
        match ended {
            Err(failure) if devices.is_empty() => Err(failure),
            _ => Ok(devices),
        }
    }
}

fn told(id: u8, data: &[u8]) -> Device {
    Device { id, data: Some(data.to_vec().into()), mac: None }
}
