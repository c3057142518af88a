//! The host: it makes a call and tells what came of it.

use std::io;
use std::time::Duration;

use actucheck_spec::model::HexBytes;

use super::answer::{Device, Devices, Failure, STATUS, blocks, judge, ping};
use super::faults::{Fault, Switch};
use super::inbox::{Inbox, Packet, Status};
use super::memory::Memory;
use super::packet::{BROADCAST, encode};
use super::port::Port;
use super::request::{Call, Request, Wanted};

const PING: u8 = 0x01;
const ACTION: u8 = 0x05;
const REBOOT: u8 = 0x08;

pub(crate) struct Host {
    on: Switch,
    /// How long a call waits for its answer.
    limit: Duration,
    port: Port,
    inbox: Inbox,
    /// Whether the next call finds what is there before it.
    keeps_input: bool,
    /// Whether each call fails from now on.
    is_stuck: bool,
    /// What was read last.
    last: Option<Vec<Device>>,
}

impl Host {
    pub(crate) fn open(on: Switch, limit: Duration, path: &str, baud: u32) -> io::Result<Self> {
        Ok(Self {
            on,
            limit,
            port: Port::open(on, path, baud)?,
            inbox: Inbox::new(on),
            keeps_input: false,
            is_stuck: false,
            last: None,
        })
    }

    /// The port if it is in memory.
    pub(crate) fn memory(&mut self) -> Option<&mut Memory> {
        self.port.memory()
    }

    pub(crate) fn call(&mut self, call: &Call) -> Devices {
        if self.is_stuck {
            return Err(Failure::new("port", "the port is in use"));
        }
        let mut again = match self.on.0 {
            Some(Fault::RetriesOnce) => 1,
            Some(Fault::RetriesForever) => usize::MAX,
            _ => 0,
        };
        let mut result = self.attempt(call);
        while again > 0 && result.as_ref().is_err_and(Failure::is_no_answer) {
            again -= 1;
            result = self.attempt(call);
        }
        self.remember(call, result)
    }

    /// Keeps what a fault returns later.
    fn remember(&mut self, call: &Call, result: Devices) -> Devices {
        let class = result.as_ref().err().map(|failure| failure.class);
        let (is_late, is_corrupt) = (class == Some("timeout"), class == Some("corrupt"));
        self.keeps_input |= is_late && self.on.is(Fault::LateAnswerForNext);
        self.keeps_input |= self.on.is(Fault::NoDrain);
        self.is_stuck |= is_late && self.on.is(Fault::BusyAfterTimeout);
        self.is_stuck |= is_corrupt && self.on.is(Fault::StuckAfterCorrupt);
        if is_corrupt && self.on.is(Fault::UnhandledCorrupt) {
            return Err(Failure::new("internal", "an exception"));
        }
        if !call.reads() {
            return result;
        }
        if is_late
            && let Some(last) = &self.last
            && self.on.is(Fault::LastGoodOnTimeout)
        {
            return Ok(last.clone());
        }
        let devices = result?;
        let before = self.last.replace(devices.clone());
        Ok(before.filter(|_| self.on.is(Fault::StaleValues)).unwrap_or(devices))
    }

    /// Sends a request and waits for what answers it.
    fn attempt(&mut self, call: &Call) -> Devices {
        let on = self.on;
        let request = call.request(on).map_err(|why| Failure::new("refused", why))?;
        if request.instruction == REBOOT && on.is(Fault::RebootNotSent) {
            return Ok(vec![Device { id: request.id, ..Device::default() }]);
        }
        let sent = self.send(&request)?;
        if let Wanted::One(id, _) = request.wanted
            && request.instruction == ACTION
            && on.is(Fault::ActionAnswerUnread)
        {
            self.keeps_input = true;
            return Ok(vec![Device { id, ..Device::default() }]);
        }
        self.inbox.expect(&sent, request.wanted.length());
        let devices = match request.wanted {
            Wanted::Nothing => self.after_broadcast(&sent),
            Wanted::One(id, length) => self.one(&sent, id, length),
            Wanted::Each { devices, by_position } => self.each(&sent, &devices, by_position),
            Wanted::All(length) => self.all(&sent, length),
            Wanted::Fast { ids, length } => self.fast(&sent, &ids, length),
        }?;
        let is_ping = request.instruction == PING;
        Ok(if is_ping {
            devices.into_iter().map(|device| ping(on, device)).collect()
        } else {
            devices
        })
    }

    /// Sends a request, after what came before it was taken away.
    fn send(&mut self, request: &Request) -> Result<Vec<u8>, Failure> {
        let on = self.on;
        if !std::mem::take(&mut self.keeps_input) {
            self.port.drain()?;
            if !on.is(Fault::KeepsHalf) {
                self.inbox.clear();
            }
        }
        let mut sent = encode(on, request.id, request.instruction, &request.params);
        if on.is(Fault::BytesBeforeRequest) {
            sent.splice(..0, [0xFF, 0xFF]);
        }
        let times = if on.is(Fault::Floods) { 1000 } else { 1 };
        let end = self.port.now() + self.limit;
        (0..times).try_for_each(|_| self.port.send(&sent, end))?;
        if on.is(Fault::DrainsAfterSending) {
            self.port.sleep(self.limit / 4);
            self.port.drain()?;
        }
        Ok(sent)
    }

    /// Reads until `take` has what it needs, or the time is over.
    fn listen(&mut self, mut take: impl FnMut(&mut Inbox, Packet) -> bool) -> Result<(), Failure> {
        let on = self.on;
        let limit = if on.is(Fault::LimitTooShort) { self.limit / 10 } else { self.limit };
        let mut end = self.port.now() + limit;
        let mut reads = 0;
        loop {
            let mut count = 0;
            while let Some(packet) = self.inbox.next() {
                count += 1;
                if take(&mut self.inbox, packet) {
                    return Ok(());
                }
            }
            if reads == 1 && count == 0 && on.is(Fault::GivesUpAtSplit) {
                return Ok(());
            }
            let waits = on.is(Fault::WaitsForever)
                || self.inbox.has_begun() && on.is(Fault::WaitsForeverForRest);
            // The line may never rest.
            if self.port.now() >= end && !waits {
                return Ok(());
            }
            let read = self.port.receive((!waits).then_some(end))?;
            if read.is_empty() {
                return Ok(());
            }
            reads += 1;
            self.inbox.push(&read);
            if on.is(Fault::LimitRestarts) {
                end = self.port.now() + limit;
            }
        }
    }

    /// Nobody answers.
    fn after_broadcast(&mut self, sent: &[u8]) -> Devices {
        if self.on.is(Fault::WaitsAfterBroadcast) {
            return self.one(sent, BROADCAST, 0);
        }
        if self.on.is(Fault::WaitsForeverAfterBroadcast) {
            self.port.receive(None)?;
        }
        Ok(Vec::new())
    }

    /// The answer of one device.
    fn one(&mut self, sent: &[u8], id: u8, length: usize) -> Devices {
        let on = self.on;
        let mut answer = None;
        if on.is(Fault::AsksWhileListening) {
            self.port.sleep(self.limit / 4);
            let end = self.port.now() + self.limit;
            self.port.send(sent, end)?;
        }
        self.listen(|inbox, packet| {
            let status = inbox.status(&packet, sent);
            answer = status.filter(|status| status.id == id || on.is(Fault::AnyId));
            answer.is_some()
        })?;
        let Some(status) = answer else {
            if length > 0 && on.is(Fault::ZeroOnTimeout) {
                let data = Some(HexBytes(vec![0; length]));
                return Ok(vec![Device { id, data, ..Device::default() }]);
            }
            if length == 0 && on.is(Fault::SilenceIsSuccess) {
                return Ok(vec![Device { id, ..Device::default() }]);
            }
            return Err(self.no_answer());
        };
        // With `any-id` it may be another's.
        let device = judge(on, Status { id, ..status }, length)?;
        if let Some(error) = device.error {
            return Err(Failure::new("status", format!("error number {error}")));
        }
        Ok(vec![device])
    }

    /// The answers of several devices, in the order of the request.
    fn each(&mut self, sent: &[u8], asked: &[(u8, usize)], by_position: bool) -> Devices {
        let on = self.on;
        let mut found: Vec<Status> = Vec::new();
        self.listen(|inbox, packet| {
            let Some(mut status) = inbox.status(&packet, sent) else { return false };
            let next = asked.get(found.len()).map_or(BROADCAST, |(id, _)| *id);
            if by_position {
                status.id = next;
            }
            if status.id != next && on.is(Fault::StopsAtMissing) {
                return true;
            }
            let is_asked = asked.iter().any(|(id, _)| *id == status.id);
            let is_new = found.iter().all(|other| other.id != status.id);
            if (is_asked || on.is(Fault::SyncAnyId)) && is_new {
                found.push(status);
            }
            asked.iter().all(|(id, _)| found.iter().any(|status| status.id == *id))
        })?;
        if found.is_empty() {
            return Err(self.no_answer());
        }
        let place = |status: &Status| asked.iter().position(|(id, _)| *id == status.id);
        found.sort_by_key(|status| place(status).unwrap_or(asked.len()));
        let mut devices = Vec::new();
        for status in found {
            let length = place(&status).and_then(|place| asked.get(place)).unwrap_or(&asked[0]).1;
            // What is corrupt is as if it had not come.
            devices.extend(judge(on, status, length));
        }
        for (id, length) in asked {
            let missing = devices.iter().all(|device| device.id != *id);
            if missing && on.is(Fault::MissingIsZero) {
                let data = Some(HexBytes(vec![0; *length]));
                devices.push(Device { id: *id, data, ..Device::default() });
            } else if missing && on.is(Fault::MissingIsStale) {
                let last = self.last.iter().flatten().find(|device| device.id == *id);
                devices.extend(last.cloned());
            }
        }
        if on.is(Fault::SyncDropsError) {
            devices.retain(|device| device.error.is_none());
        }
        if on.is(Fault::SyncErrorFailsAll) && devices.iter().any(|device| device.error.is_some()) {
            return Err(Failure::new("status", "a device tells an error"));
        }
        if on.is(Fault::SyncAliasesLast) {
            let last = devices.last().and_then(|device| device.data.clone());
            for device in &mut devices {
                device.data.clone_from(&last);
            }
        }
        if devices.is_empty() {
            Err(Failure::new("corrupt", "no answer is right"))
        } else {
            Ok(devices)
        }
    }

    /// The answers to a Ping of all devices.
    fn all(&mut self, sent: &[u8], length: usize) -> Devices {
        let on = self.on;
        let mut devices: Vec<Device> = Vec::new();
        self.listen(|inbox, packet| {
            let status = inbox.status(&packet, sent);
            let device = status.and_then(|status| judge(on, status, length).ok());
            let is_new = |device: &Device| devices.iter().all(|other| other.id != device.id);
            if let Some(device) = device.filter(is_new) {
                devices.push(device);
            }
            !devices.is_empty() && on.is(Fault::PingFirstOnly)
        })?;
        if devices.is_empty() { Err(self.no_answer()) } else { Ok(devices) }
    }

    /// The one packet in which several devices answer.
    fn fast(&mut self, sent: &[u8], ids: &[u8], length: usize) -> Devices {
        let on = self.on;
        let mut answer = None;
        self.listen(|_, packet| {
            let is_status = packet.id == BROADCAST && packet.body.first() == Some(&STATUS);
            if is_status && packet.bytes != sent {
                answer = Some(blocks(on, &packet, ids, length));
            }
            answer.is_some()
        })?;
        answer.unwrap_or_else(|| Err(self.no_answer()))
    }

    fn no_answer(&self) -> Failure {
        if self.inbox.was_corrupt || self.inbox.has_begun() {
            Failure::new("corrupt", "no right packet came")
        } else {
            Failure::new("timeout", "nothing came")
        }
    }
}
