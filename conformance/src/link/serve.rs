//! The loop.

use std::iter;
use std::ops::ControlFlow;
use std::os::fd::{AsFd, BorrowedFd};
use std::time::{Duration, Instant};

use actucheck_spec::wire::Direction;
use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::io::Errno;

use super::port::{Host, Links};
use super::turn::Turn;
use super::{LinkError, Watch};
use crate::bus::VirtualBus;

/// How long nobody is let in after the system had no room for another host.
const FULL: Duration = Duration::from_millis(100);

/// The largest datagram. Streams are read in pieces that are no longer.
const LONGEST: usize = 64 << 10;

impl Links {
    /// Carries bytes between the hosts and the bus until `stop` can be read, standard input has ended and
    /// is answered, or who watches has seen enough. Returns how many bytes of devices were lost, as no
    /// host took them.
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
        let (full, lost) = (Duration::ZERO, 0);
        let mut line = Line { links: self, bus, watch, start, turn, full, buffer, lost };
        while let ControlFlow::Continue(look) = line.settle() {
            let ready = line.wait(stop, look)?;
            if ready.stop {
                break;
            }
            line.hear(ready.hosts);
            if !line.part() {
                break;
            }
            for listener in ready.listeners {
                if line.links.accept(listener).is_err() {
                    line.full = line.start.elapsed() + FULL;
                }
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
    /// Nobody is let in until then.
    full: Duration,
    buffer: Vec<u8>,
    lost: u64,
}

/// What there is to do.
#[derive(Default)]
struct Ready {
    stop: bool,
    listeners: Vec<usize>,
    hosts: Vec<u64>,
}

impl Line<'_> {
    /// Lets who watches look, after all that was written has come through.
    fn settle(&mut self) -> ControlFlow<(), Option<Duration>> {
        self.links.hosts.iter().for_each(|host| host.channel.carry());
        self.watch.settled(self.bus, self.start.elapsed())
    }

    /// Waits until a host that may be heard sends something, or it is time for something.
    fn wait(&mut self, stop: BorrowedFd<'_>, look: Option<Duration>) -> Result<Ready, LinkError> {
        let now = self.start.elapsed();
        let free = Some(self.bus.free()).filter(|free| *free > now);
        let full = Some(self.full).filter(|full| *full > now);
        let Links { listeners, hosts, .. } = &self.links;
        let listeners = if full.is_none() { listeners.as_slice() } else { &[] };
        let is_heard =
            |host: &&Host| free.is_none() && !host.has_ended && self.turn.admits(host.number, now);
        let heard: Vec<_> = hosts.iter().filter(is_heard).collect();
        let waits = |host: &&Host| !host.waiting().is_empty();
        let at_once = heard.iter().any(waits).then_some(now);
        let times = [at_once, free, full, look, self.bus.next(), self.turn.next(now)];
        let wake = times.into_iter().flatten().min();
        let limit = wake.and_then(|wake| Timespec::try_from(wake.saturating_sub(now)).ok());
        let sources = heard.iter().map(|host| host.channel.source());
        let sources = listeners.iter().map(AsFd::as_fd).chain(sources);
        let mut polled: Vec<_> = iter::once(stop)
            .chain(sources)
            .map(|it| PollFd::from_borrowed_fd(it, PollFlags::IN))
            .collect();
        match poll(&mut polled, limit.as_ref()) {
            Ok(_) | Err(Errno::INTR) => {}
            Err(error) => return Err(LinkError::Wait(error.into())),
        }
        let mut polled = polled.iter().map(|polled| !polled.revents().is_empty());
        let mut is_ready = || polled.next() == Some(true);
        Ok(Ready {
            stop: is_ready(),
            listeners: (0..listeners.len()).filter(|_| is_ready()).collect(),
            hosts: heard
                .iter()
                .filter(|host| is_ready() || waits(host))
                .map(|host| host.number)
                .collect(),
        })
    }

    /// Lets the bus hear hosts, and hands on what it has to say.
    fn hear(&mut self, mut ready: Vec<u64>) {
        self.answer(&[], Duration::ZERO);
        if self.turn.expire(self.start.elapsed()) {
            self.quiet();
        }
        // Who comes after the host that was heard last is first: so each comes to its turn.
        let last = self.turn.sender.map(|sender| sender.host);
        ready.sort_by_key(|number| Some(*number) <= last);
        for number in ready {
            let now = self.start.elapsed();
            if self.bus.free() > now || !self.turn.admits(number, now) {
                continue;
            }
            if let Some(host) = self.links.host(number) {
                host.fill(&mut self.buffer);
                self.hear_host(number);
            }
        }
    }

    /// Lets hosts go whose input has ended, as soon as it is not their turn and nothing is on its way to
    /// them. Returns whether the bus goes on.
    fn part(&mut self) -> bool {
        let (bus, turn) = (&*self.bus, &self.turn);
        let goes = |host: &Host| {
            host.has_ended && !turn.is_of(host.number) && !bus.is_awaited(host.number)
        };
        let ends = |host: &Host| host.channel.ends_the_bus() && goes(host);
        let goes_on = !self.links.hosts.iter().any(ends);
        self.links.hosts.retain(|host| !goes(host));
        goes_on
    }

    /// Lets no packet go on after what was heard.
    fn quiet(&mut self) {
        self.bus.quiet(self.turn.sender.unwrap_or_default(), self.start.elapsed());
        self.watch.quiet();
        self.answer(&[], Duration::ZERO);
    }

    /// Lets the bus hear what a host has sent, packet by packet while the line is free. If others wait for
    /// the end of a packet, what comes after it waits for them.
    fn hear_host(&mut self, number: u64) {
        let was_within_packet = self.turn.lasts();
        while let Some(sender) = self.links.host(number).and_then(|host| host.sender()) {
            if self.turn.sender != Some(sender) && self.bus.is_within_packet() {
                self.quiet();
            }
            let now = self.start.elapsed();
            let Some(host) = self.links.host(number).filter(|_| self.bus.free() <= now) else {
                return;
            };
            let count = self.bus.first(host.waiting());
            let (bytes, may_split) = (host.next(count).to_vec(), host.channel.may_split());
            let heard = self.bus.send_from(sender, &bytes, now);
            self.turn.heard(sender, may_split, heard);
            self.answer(&bytes, heard);
            if was_within_packet && !self.turn.lasts() {
                return;
            }
        }
    }

    /// Hands on what devices have sent by now. Only then is told what passed: what was `asked`, and the
    /// answer.
    fn answer(&mut self, asked: &[u8], heard: Duration) {
        let mut answers = Vec::new();
        while let Some((sender, bytes)) = self.bus.receive_for(self.start.elapsed()) {
            let host = self.links.host(sender.host);
            let taken = host.map_or(0, |host| host.channel.write(&bytes, sender.peer));
            self.lost += bytes.len().saturating_sub(taken) as u64;
            answers.push((bytes, self.start.elapsed()));
        }
        if !asked.is_empty() {
            self.watch.passed(Direction::Request, asked, heard);
        }
        for (bytes, at) in answers {
            self.watch.passed(Direction::Reply, &bytes, at);
        }
        self.turn.settle(self.bus);
    }
}
