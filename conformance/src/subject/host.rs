//! A host behind an adapter: it is asked for calls, on a line that plays a script.

use std::ops::ControlFlow;
use std::os::fd::AsFd as _;
use std::os::unix::net::UnixStream;
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use actucheck_spec::wire::{Direction, Wire};

use super::heard::{Heard, hear, own};
use super::passing::{Passing, milliseconds};
use super::served::Served;
use super::{Answer, BAUD, Interrupted, bursts, port};
use crate::adapter::conversation::{Conversation, Lost};
use crate::adapter::{
    CallError, CallTo, Course, HostPort, Output, Request, Returned, Step, Trouble, devices, passed,
};
use crate::bus::{Script, VirtualBus};
use crate::link::{Links, Watch};

/// How often the line is looked at for the packet of a call that has returned.
const WRITTEN: u32 = 50;
/// How often a conversation is tried for which the machine is too busy, and one in which a packet is never
/// heard.
const TRIES: usize = 5;
const UNHEARD_TRIES: usize = 2;
/// How often it is looked whether something is to be played, or has passed.
const LOOK: Duration = Duration::from_millis(1);

/// What passes in a step.
#[derive(Clone, Default)]
struct Record(Arc<Mutex<Recorded>>);

#[derive(Default)]
struct Recorded {
    /// When the call was asked.
    begun: Option<Instant>,
    passing: Passing,
}

impl Record {
    /// Ends a step. Returns what passed in it.
    fn turn(&self) -> Passing {
        let new = Recorded { begun: Some(Instant::now()), passing: Passing::default() };
        let old =
            std::mem::replace(&mut *self.0.lock().unwrap_or_else(PoisonError::into_inner), new);
        old.passing
    }

    /// What has passed in the last call, in words.
    fn told(&self) -> String {
        let recorded = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let words = passed(&recorded.passing.line, recorded.passing.more);
        if words.is_empty() { "nothing passed".to_owned() } else { words.join(", ") }
    }

    fn add(&self, direction: Direction, bytes: &[u8]) {
        let mut recorded = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let at_ms = recorded.begun.map_or(0, |begun| milliseconds(begun.elapsed()));
        recorded.passing.add(at_ms, direction, bytes);
    }
}

/// Watches the line: it plays what nobody asks for, and records what passes.
struct Watcher {
    script: Script,
    record: Record,
    served: Served,
}

impl Watch for Watcher {
    fn passed(&mut self, direction: Direction, bytes: &[u8], _: Duration) {
        self.record.add(direction, bytes);
        match direction {
            Direction::Request => self.script.recorded(),
            Direction::Reply => self.script.arrived(bytes.len()),
        }
    }

    fn quiet(&mut self) {}

    fn settled(
        &mut self,
        bus: &mut VirtualBus,
        now: Duration,
    ) -> ControlFlow<(), Option<Duration>> {
        self.served.look();
        if self.script.is_waiting() {
            bus.send(&[], now);
        }
        ControlFlow::Continue(Some(now + LOOK))
    }
}

/// Lets a host make calls, on a line of its own. Returns what became of them, or what else the adapter
/// answers. A machine that is too busy tries it again unless the answer `is_right`.
///
/// # Errors
/// If no later reply of the adapter can be trusted.
pub(crate) fn converse(
    conversation: &mut Conversation,
    limit: Duration,
    wire: Wire,
    kind: HostPort,
    steps: &[Step],
    is_right: &dyn Fn(&Answer) -> bool,
) -> Result<Answer, Interrupted> {
    let mut count = 0;
    loop {
        let (answer, seen) = once(conversation, limit, wire, kind, steps)?;
        count += 1;
        let most = match seen {
            Seen::Right => count,
            Seen::Late | Seen::HeardLate => TRIES,
            Seen::Unheard => UNHEARD_TRIES,
        };
        if count >= most || is_right(&answer) {
            return Ok(answer);
        }
    }
}

/// How the line saw a conversation.
enum Seen {
    Right,
    /// The machine was too busy for the line.
    Late,
    /// A call returned before its packet was heard.
    HeardLate,
    /// A packet was never heard.
    Unheard,
}

/// The same, and how the line saw it.
fn once(
    conversation: &mut Conversation,
    limit: Duration,
    wire: Wire,
    kind: HostPort,
    steps: &[Step],
) -> Result<(Answer, Seen), Interrupted> {
    let (script, record, served) = (Script::default(), Record::default(), Served::default());
    let Some(mut bus) = VirtualBus::scripted(wire, script.clone()) else {
        return Ok((Answer::NotAsked(format!("there is no line for {wire}")), Seen::Right));
    };
    let mut links = Links::default();
    let opened = port(&mut links, wire, kind).map_err(|error| error.to_string());
    let ends = UnixStream::pair().map_err(|error| error.to_string());
    let (address, (stop, stopped)) = match (opened, ends) {
        (Ok(port), Ok(ends)) => (port.name(), ends),
        (Err(error), _) | (_, Err(error)) => return Ok((Answer::NotAsked(error), Seen::Right)),
    };
    let mut watcher =
        Watcher { script: script.clone(), record: record.clone(), served: served.clone() };
    thread::scope(|scope| {
        let line = scope.spawn(move || links.serve(&mut bus, stopped.as_fd(), &mut watcher));
        let mut host = Host {
            conversation,
            limit,
            wire,
            script: script.clone(),
            record: record.clone(),
            served,
            gave_up: false,
            was_late: false,
        };
        let answer = host.converse(&address, steps);
        let answer = answer.map_err(|lost| Interrupted { lost, passed: Some(record.told()) });
        drop(stop);
        let answer = match line.join() {
            Ok(Ok(_)) => answer?,
            Ok(Err(error)) => Answer::NotAsked(error.to_string()),
            Err(_) => Answer::NotAsked("the line broke down".to_owned()),
        };
        let seen = match (host.was_late, host.gave_up, script.is_heard()) {
            (true, ..) => Seen::Late,
            (false, true, true) => Seen::HeardLate,
            (false, true, false) => Seen::Unheard,
            (false, false, _) => Seen::Right,
        };
        Ok((answer, seen))
    })
}

/// A host with an open line.
struct Host<'a> {
    conversation: &'a mut Conversation,
    limit: Duration,
    wire: Wire,
    script: Script,
    record: Record,
    served: Served,
    /// Whether a call returned before its packet was heard: it does not send it, or does not wait, or the
    /// machine was too busy.
    gave_up: bool,
    /// Whether the machine was too busy for the line in a call.
    was_late: bool,
}

impl Host<'_> {
    fn converse(&mut self, port: &str, steps: &[Step]) -> Result<Answer, Lost> {
        wait(self.limit, || self.served.has_begun());
        let open = Request::Open { wire: self.wire, port, baud: BAUD };
        if let Some(problem) = self.ask(&open)?.problem("open the port") {
            return Ok(problem);
        }
        let mut courses = Vec::new();
        for step in steps {
            match self.step(step)? {
                Ok(course) => courses.push(course),
                Err(problem) => return Ok(problem),
            }
        }
        let close = Request::Close { wire: self.wire };
        if let Some(problem) = self.ask(&close)?.problem("close the port") {
            return Ok(problem);
        }
        Ok(Answer::Ok(Output::Conversation(courses)))
    }

    /// What becomes of a step, or why its call has no result that can be judged.
    fn step(&mut self, step: &Step) -> Result<Result<Course, Answer>, Lost> {
        let packet = &step.packet.packet;
        let Some(call) = &step.packet.call else {
            return Ok(Err(Answer::NotAsked("no call sends this packet".to_owned())));
        };
        // Nothing is heard of a packet that no length can tell.
        let frame = self.wire.encode(packet).unwrap_or_default();
        self.script.begin(frame, bursts(&step.answers));
        self.record.turn();
        let call = CallTo { call: call.clone(), device: self.wire.device(packet) };
        let (asked, lost) = (Instant::now(), self.served.lost());
        let reply = self.ask(&Request::Call { wire: self.wire, call: &call })?;
        let ms = milliseconds(asked.elapsed());
        let is_refused = matches!(
            &reply,
            Heard::Other(_) | Heard::Err(CallError { class: Trouble::Refused, .. })
        );
        let gave_up = !self.script.is_heard() && !step.answers.is_empty();
        // The host may have written without waiting for what becomes of it.
        let looks = self.served.looks();
        wait(self.limit, || {
            is_refused || self.script.is_heard() || self.served.looks() > looks + WRITTEN
        });
        if !is_refused && (gave_up || !self.script.is_heard()) {
            self.gave_up = true;
        }
        if !step.hurries {
            wait(self.limit, || self.script.is_over());
        }
        let late = self.served.lost() > lost;
        self.was_late |= late;
        let Passing { line, more } = self.record.turn();
        let returned = match reply {
            Heard::Ok(ok) => match devices(&ok) {
                Ok(devices) => Returned::Devices(devices),
                Err(misfit) => return Ok(Err(Answer::Faulty(misfit.what))),
            },
            Heard::Err(error) => match own(error) {
                Ok(error) => Returned::Err(error),
                Err(answer) => return Ok(Err(answer)),
            },
            Heard::Other(answer) => return Ok(Err(answer)),
        };
        if !step.late.is_empty() {
            self.script.play(&step.late);
            wait(self.limit, || self.script.is_over());
            let looks = self.served.looks();
            wait(self.limit, || self.served.looks() > looks);
        }
        Ok(Ok(Course { line, more, ms, late, returned }))
    }

    fn ask(&mut self, request: &Request<'_>) -> Result<Heard, Lost> {
        let (limit, lost) = (self.limit, self.served.lost());
        self.conversation.send(request);
        hear(self.conversation, limit, &|| self.served.more(limit, lost))
    }
}

/// Waits until something is done, so long at most.
fn wait(limit: Duration, is_done: impl Fn() -> bool) {
    let begun = Instant::now();
    while !is_done() && begun.elapsed() < limit {
        thread::sleep(LOOK);
    }
}
