//! A host behind an adapter: it is asked for calls, on a line that plays a script.

use std::ops::ControlFlow;
use std::os::fd::AsFd as _;
use std::os::unix::net::UnixStream;
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use actucheck_spec::model::Fault;
use actucheck_spec::wire::{Direction, Wire};

use super::Answer;
use crate::adapter::conversation::{Conversation, Lost, Reply, error};
use crate::adapter::{
    Burst, CallError, CallTo, Course, Output, Passed, Rejection, Request, Returned, Step, Trouble,
    devices,
};
use crate::bus::{Bursts, Script, VirtualBus};
use crate::legible::{LONGEST_TEXT, legible};
use crate::link::{Links, Watch};

/// The rate that the host is told. Bytes on the line take no time.
const BAUD: u32 = 1_000_000;
/// How often the line is looked at for the packet of a call that has returned.
const WRITTEN: u32 = 50;
/// How often a conversation is tried for which the machine is too busy.
const TRIES: usize = 5;
/// How often it is looked whether something is to be played, or has passed.
const LOOK: Duration = Duration::from_millis(1);
/// How long what was written last takes through the terminal, on a busy machine.
const THROUGH: Duration = Duration::from_millis(20);
/// The most bytes of a step that are kept, and in how many pieces.
const KEPT: (usize, usize) = (1024, 48);

/// What passes in a step.
#[derive(Clone, Default)]
struct Record(Arc<Mutex<Recorded>>);

#[derive(Default)]
struct Recorded {
    /// When the call was asked.
    begun: Option<Instant>,
    line: Vec<Passed>,
    more: usize,
}

impl Record {
    /// Ends a step. Returns what passed in it.
    fn turn(&self) -> (Vec<Passed>, usize) {
        let new = Recorded { begun: Some(Instant::now()), ..Recorded::default() };
        let old =
            std::mem::replace(&mut *self.0.lock().unwrap_or_else(PoisonError::into_inner), new);
        (old.line, old.more)
    }

    fn add(&self, direction: Direction, bytes: &[u8]) {
        let mut recorded = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let size: usize = recorded.line.iter().map(|passed| passed.bytes.len()).sum();
        let (bytes_left, pieces_left) = (KEPT.0.saturating_sub(size), recorded.line.len() < KEPT.1);
        let kept = bytes.get(..bytes_left).unwrap_or(bytes);
        let kept = if pieces_left { kept } else { &[] };
        recorded.more += bytes.len() - kept.len();
        let at_ms = recorded.begun.map_or(0, |begun| milliseconds(begun.elapsed()));
        if kept.is_empty() {
            return;
        }
        recorded.line.push(Passed { at_ms, direction, bytes: kept.to_vec().into() });
    }
}

/// Watches the line: it plays what nobody asks for, and records what passes.
struct Watcher {
    script: Script,
    record: Record,
}

impl Watch for Watcher {
    fn passed(&mut self, direction: Direction, bytes: &[u8], _: Duration) {
        self.record.add(direction, bytes);
        if direction == Direction::Reply {
            self.script.arrived(bytes.len());
        }
    }

    fn quiet(&mut self) {}

    fn settled(
        &mut self,
        bus: &mut VirtualBus,
        now: Duration,
    ) -> ControlFlow<(), Option<Duration>> {
        self.script.look(now);
        if self.script.is_waiting() {
            bus.send(&[], now);
        }
        ControlFlow::Continue(Some(now + LOOK))
    }
}

/// Lets a host make calls, on a line of its own. Returns what became of them, or what else the adapter
/// answers.
///
/// # Errors
/// If no later reply of the adapter can be trusted.
pub(crate) fn converse(
    conversation: &mut Conversation,
    limit: Duration,
    wire: Wire,
    steps: &[Step],
) -> Result<Answer, Lost> {
    let mut tries = 1..TRIES;
    loop {
        let (answer, was_late) = once(conversation, limit, wire, steps)?;
        if tries.next().is_none() || !was_late {
            return Ok(answer);
        }
    }
}

/// The same, and whether the machine was too busy for the line.
fn once(
    conversation: &mut Conversation,
    limit: Duration,
    wire: Wire,
    steps: &[Step],
) -> Result<(Answer, bool), Lost> {
    let (script, record) = (Script::default(), Record::default());
    let mut links = Links::default();
    let opened = links.pty(None).map_err(|error| error.to_string());
    let ends = UnixStream::pair().map_err(|error| error.to_string());
    let (port, (stop, stopped)) = match (opened, ends) {
        (Ok(port), Ok(ends)) => (port.address, ends),
        (Err(error), _) | (_, Err(error)) => return Ok((Answer::NotAsked(error), false)),
    };
    let Some(mut bus) = VirtualBus::scripted(wire, script.clone()) else {
        return Ok((Answer::NotAsked(format!("there is no line for {wire}")), false));
    };
    let mut watcher = Watcher { script: script.clone(), record: record.clone() };
    thread::scope(|scope| {
        let line = scope.spawn(move || links.serve(&mut bus, stopped.as_fd(), &mut watcher));
        let mut host = Host { conversation, limit, wire, script: script.clone(), record };
        let answer = host.converse(&port, steps);
        drop(stop);
        let answer = match line.join() {
            Ok(Ok(_)) => answer?,
            Ok(Err(error)) => Answer::NotAsked(error.to_string()),
            Err(_) => Answer::NotAsked("the line broke down".to_owned()),
        };
        Ok((answer, script.was_late()))
    })
}

/// A host with an open line.
struct Host<'a> {
    conversation: &'a mut Conversation,
    limit: Duration,
    wire: Wire,
    script: Script,
    record: Record,
}

impl Host<'_> {
    fn converse(&mut self, port: &str, steps: &[Step]) -> Result<Answer, Lost> {
        wait(self.limit, || self.script.is_served());
        let open = Request::Open { wire: self.wire, port, baud: BAUD };
        if let Some(problem) = other_than_ok(self.ask(&open)?, "open the port") {
            return Ok(problem);
        }
        let mut courses = Vec::new();
        for step in steps {
            match self.step(step)? {
                Ok(course) => courses.push(course),
                Err(problem) => return Ok(problem),
            }
        }
        if let Some(problem) =
            other_than_ok(self.ask(&Request::Close { wire: self.wire })?, "close the port")
        {
            return Ok(problem);
        }
        Ok(Answer::Ok(Output::Conversation(courses)))
    }

    /// What becomes of a step, or why its call has no result that can be judged.
    fn step(&mut self, step: &Step) -> Result<Result<Course, Answer>, Lost> {
        let packet = &step.packet.packet;
        let (Some(frame), Some(call)) = (self.wire.encode(packet), &step.packet.call) else {
            return Ok(Err(Answer::NotAsked("no call sends this packet".to_owned())));
        };
        self.script.begin(frame, step.answers.iter().map(|bursts| timed(bursts)));
        self.record.turn();
        let call = CallTo { call: call.clone(), device: self.wire.device(packet) };
        let asked = Instant::now();
        let reply = self.ask(&Request::Call { wire: self.wire, call: &call })?;
        let ms = milliseconds(asked.elapsed());
        let is_refused = matches!(
            &reply,
            Heard::Other(_) | Heard::Err(CallError { class: Trouble::Refused, .. })
        );
        if !is_refused && !self.script.is_heard() && !step.answers.is_empty() {
            // Either the host did not send it, or gave up before it was heard.
            self.script.be_late();
        }
        // The host may have written without waiting for what becomes of it.
        let looks = self.script.looks();
        wait(self.limit, || {
            is_refused || self.script.is_heard() || self.script.looks() > looks + WRITTEN
        });
        if !step.hurries {
            wait(self.limit, || self.script.is_over());
        }
        let (line, more) = self.record.turn();
        let returned = match reply {
            Heard::Ok(ok) => match devices(&ok) {
                Ok(devices) => Returned::Devices(devices),
                Err(misfit) => return Ok(Err(Answer::Faulty(misfit.what))),
            },
            Heard::Err(CallError { class: Trouble::Internal, detail }) => {
                return Ok(Err(Answer::Rejected(Rejection { class: Fault::Internal, detail })));
            }
            Heard::Err(error) => Returned::Err(error),
            Heard::Other(answer) => return Ok(Err(answer)),
        };
        if !step.late.is_empty() {
            self.script.play(&step.late);
            wait(self.limit, || self.script.is_over());
            thread::sleep(THROUGH);
        }
        Ok(Ok(Course { line, more, ms, returned }))
    }

    fn ask(&mut self, request: &Request<'_>) -> Result<Heard, Lost> {
        self.conversation.send(request);
        let (_, reply) = self.conversation.receive(self.limit)?;
        Ok(match reply {
            Ok(Reply::Ok(ok)) => Heard::Ok(ok.get().to_owned()),
            Ok(Reply::Err(raw)) => match error::<CallError>(&raw) {
                Ok(CallError { class, detail }) => {
                    Heard::Err(CallError { class, detail: legible(&detail, LONGEST_TEXT) })
                }
                Err(malformed) => Heard::Other(Answer::Faulty(malformed.to_string())),
            },
            Ok(Reply::Skip(reason)) => Heard::Other(Answer::Skipped(reason)),
            Err(malformed) => Heard::Other(Answer::Faulty(malformed.to_string())),
        })
    }
}

/// A reply of an adapter for a host.
enum Heard {
    Ok(String),
    Err(CallError),
    Other(Answer),
}

/// Why a port is not open, or not closed.
fn other_than_ok(heard: Heard, what: &str) -> Option<Answer> {
    match heard {
        Heard::Ok(_) => None,
        Heard::Err(CallError { class, detail }) => {
            Some(Answer::Faulty(format!("it did not {what} ({class}: {detail})")))
        }
        Heard::Other(answer) => Some(answer),
    }
}

fn timed(bursts: &[Burst]) -> Bursts {
    let timed =
        |burst: &Burst| (Duration::from_millis(burst.after_ms.into()), burst.bytes.0.clone());
    bursts.iter().map(timed).collect()
}

/// Waits until something is done, so long at most.
fn wait(limit: Duration, is_done: impl Fn() -> bool) {
    let begun = Instant::now();
    while !is_done() && begun.elapsed() < limit {
        thread::sleep(LOOK);
    }
}

fn milliseconds(time: Duration) -> u64 {
    u64::try_from(time.as_millis()).unwrap_or(u64::MAX)
}
