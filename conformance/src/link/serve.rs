//! The loop.

use std::os::fd::BorrowedFd;
use std::time::Instant;

use actucheck_spec::wire::Direction;
use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::io::Errno;

use super::channel::Read;
use super::port::Links;
use super::turn::Turn;
use super::{LinkError, Watch};
use crate::bus::VirtualBus;

/// The largest datagram. Streams are read in pieces that are no longer.
const LONGEST: usize = 64 << 10;

impl Links {
    /// Carries bytes between the hosts and the bus until `stop` can be read, standard input ends, or who
    /// watches has seen enough. Returns how many bytes of devices were lost, as no host took them.
    ///
    /// # Errors
    /// If the system can't wait for the ports.
    pub fn serve(
        self,
        bus: &mut VirtualBus,
        stop: BorrowedFd<'_>,
        watch: &mut dyn Watch,
    ) -> Result<u64, LinkError> {
        let (start, turn, buffer) = (Instant::now(), Turn::default(), vec![0; LONGEST]);
        let mut line = Line { links: self, bus, watch, start, turn, buffer, lost: 0 };
        while line.watch.settled() {
            let ready = line.wait(stop)?;
            if ready.stop || !line.hear(ready.hosts) {
                break;
            }
            for listener in ready.listeners {
                line.links.accept(listener);
            }
        }
        Ok(line.lost)
    }
}

struct Line<'a> {
    links: Links,
    bus: &'a mut VirtualBus,
    watch: &'a mut dyn Watch,
    start: Instant,
    turn: Turn,
    buffer: Vec<u8>,
    lost: u64,
}

/// What there is to do.
#[derive(Default)]
struct Ready {
    stop: bool,
    listeners: Vec<usize>,
    /// Their places.
    hosts: Vec<usize>,
}

impl Line<'_> {
    /// Waits until a host that may be heard sends something, or it is time for something.
    fn wait(&mut self, stop: BorrowedFd<'_>) -> Result<Ready, LinkError> {
        let now = self.start.elapsed();
        let free = Some(self.bus.free()).filter(|free| *free > now);
        let wake = [free, self.bus.next(), self.turn.end].into_iter().flatten().min();
        let limit = wake.and_then(|wake| Timespec::try_from(wake.saturating_sub(now)).ok());
        let Links { listeners, hosts, .. } = &self.links;
        let is_heard = |place: &usize| {
            let host = hosts.get(*place);
            free.is_none() && host.is_some_and(|host| self.turn.admits(host.number))
        };
        let heard: Vec<_> = (0..hosts.len()).filter(is_heard).collect();
        let sources = heard.iter().filter_map(|place| hosts.get(*place));
        let mut polled: Vec<_> = [PollFd::from_borrowed_fd(stop, PollFlags::IN)]
            .into_iter()
            .chain(listeners.iter().map(|listener| PollFd::new(listener, PollFlags::IN)))
            .chain(
                sources.map(|host| PollFd::from_borrowed_fd(host.channel.source(), PollFlags::IN)),
            )
            .collect();
        match poll(&mut polled, limit.as_ref()) {
            Ok(0) | Err(Errno::INTR) => return Ok(Ready::default()),
            Ok(_) => {}
            Err(error) => return Err(LinkError::Wait(error.into())),
        }
        let mut is_ready = polled.iter().map(|polled| !polled.revents().is_empty());
        Ok(Ready {
            stop: is_ready.next().unwrap_or_default(),
            listeners: (0..listeners.len()).filter(|_| is_ready.next() == Some(true)).collect(),
            hosts: heard.into_iter().filter(|_| is_ready.next() == Some(true)).collect(),
        })
    }

    /// Lets the bus hear hosts, and hands on what it has to say. Returns whether the bus goes on.
    fn hear(&mut self, mut ready: Vec<usize>) -> bool {
        self.answer();
        if self.turn.expire(self.start.elapsed()) {
            self.watch.quiet();
        }
        // Who comes after the host that was heard last is first: so each comes to its turn.
        let last = self.turn.host;
        ready.sort_by_key(|place| self.links.hosts.get(*place).map(|host| host.number) <= last);
        let mut gone = Vec::new();
        for place in ready {
            let others = self.links.hosts.len() > 1;
            let Some(host) = self.links.hosts.get_mut(place) else { continue };
            let now = self.start.elapsed();
            if self.bus.free() > now || !self.turn.admits(host.number) {
                continue;
            }
            let may_split = host.channel.may_split();
            // Others wait for the end of this packet, so nothing is read that comes after it.
            let is_last = may_split && others && self.turn.end.is_some();
            let length = if is_last { 1 } else { LONGEST };
            let buffer = self.buffer.get_mut(..length).unwrap_or_default();
            match host.channel.read(buffer) {
                Read::Bytes(count) => {
                    self.turn.heard(host.number, may_split, now);
                    let bytes = self.buffer.get(..count).unwrap_or_default();
                    self.bus.send(bytes, now);
                    self.watch.passed(Direction::Request, bytes, now);
                    self.answer();
                }
                Read::Nothing => {}
                Read::End if host.channel.ends_the_bus() => return false,
                Read::End => gone.push(host.number),
            }
        }
        self.links.hosts.retain(|host| !gone.contains(&host.number));
        true
    }

    /// Hands on what devices have sent by now.
    fn answer(&mut self) {
        let bytes = self.bus.receive(self.start.elapsed());
        if !bytes.is_empty() {
            self.lost += self.links.write(self.turn.host, &bytes);
            self.watch.passed(Direction::Reply, &bytes, self.start.elapsed());
        }
        self.turn.settle(self.bus);
    }
}
