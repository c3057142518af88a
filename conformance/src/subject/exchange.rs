//! A host behind an adapter that has a port in memory: each call is one request with what the line plays,
//! and the adapter's clock counts the time that nobody waits.

use std::time::Duration;

use actucheck_spec::wire::{Direction, Wire};

use super::heard::{Heard, ask, own};
use super::passing::{Passing, milliseconds};
use super::{Answer, BAUD, bursts};
use crate::adapter::conversation::{Conversation, Lost};
use crate::adapter::{
    CallError, CallTo, Course, Exchange, Exchanged, Output, Request, Returned, Step, exchanged,
};
use crate::bus::{Answers, Chunk};

/// The name of the port in memory.
pub(super) const PORT: &str = "memory";

/// Lets a host make calls on a port in memory. Returns what became of them, or what else the adapter
/// answers.
///
/// # Errors
/// If no later reply of the adapter can be trusted.
pub(super) fn converse(
    conversation: &mut Conversation,
    limit: Duration,
    wire: Wire,
    steps: &[Step],
) -> Result<Answer, Lost> {
    let open = Request::Open { wire, port: PORT, baud: BAUD };
    if let Some(problem) = ask(conversation, limit, &open)?.problem("open the port in memory") {
        return Ok(problem);
    }
    let (mut line, mut courses) = (Line::default(), Vec::new());
    for step in steps {
        let packet = &step.packet.packet;
        let Some(call) = &step.packet.call else {
            return Ok(Answer::NotAsked("no call sends this packet".to_owned()));
        };
        let frame = wire.encode(packet);
        let Step { answers, late, hurries, .. } = step;
        // Nothing answers what no packet has the length for.
        let answers = if frame.is_some() { answers.as_slice() } else { &[] };
        let frame = frame.unwrap_or_default().into();
        let call = CallTo { call: call.clone(), device: wire.device(packet) };
        let exchange = Exchange { wire, call, frame, answers, late, hurries: *hurries };
        let course = match ask(conversation, limit, &Request::Exchange(&exchange))? {
            Heard::Ok(ok) => match exchanged(&ok) {
                Ok(exchanged) => line.course(&exchange, exchanged, limit),
                Err(misfit) => Err(Answer::Faulty(misfit.what)),
            },
            Heard::Err(error) => Err(own(error).map_or_else(|answer| answer, misplaced)),
            Heard::Other(answer) => Err(answer),
        };
        match course {
            Ok(course) => courses.push(course),
            Err(problem) => return Ok(problem),
        }
    }
    let close = Request::Close { wire };
    if let Some(problem) = ask(conversation, limit, &close)?.problem("close the port") {
        return Ok(problem);
    }
    Ok(Answer::Ok(Output::Conversation(courses)))
}

/// Without what was sent, an error tells too little.
fn misplaced(error: CallError) -> Answer {
    let what = format!("{} is no `ok` with `sent`, `ms` and `err`", Returned::Err(error));
    Answer::Faulty(what)
}

/// What is known of the adapter's line, by its own clock.
#[derive(Default)]
struct Line {
    /// The time since the port was opened.
    now: Duration,
    /// What is on its way.
    coming: Vec<Chunk>,
}

impl Line {
    /// What became of a call.
    fn course(
        &mut self,
        exchange: &Exchange<'_>,
        exchanged: Exchanged,
        limit: Duration,
    ) -> Result<Course, Answer> {
        let Exchanged { sent, ms, returned } = exchanged;
        let returned = match returned {
            Returned::Err(error) => Returned::Err(own(error.legible())?),
            devices @ Returned::Devices(_) => devices,
        };
        if ms > milliseconds(limit) {
            return Err(Answer::TimedOut(format!("the call took {ms} ms by the adapter's clock")));
        }
        if !sent.is_sorted_by_key(|sent| sent.at_ms) || sent.iter().any(|sent| sent.at_ms > ms) {
            let what = "`sent` is not in the order of time, or later than `ms`";
            return Err(Answer::Faulty(what.to_owned()));
        }
        let begun = self.now;
        let mut answers = Answers::to(exchange.frame.0.clone(), bursts(exchange.answers));
        let mut passed = Vec::new();
        for sent in sent {
            let now = begun + Duration::from_millis(sent.at_ms);
            let heard = sent.bytes.iter().filter_map(|byte| answers.hear(*byte)).flatten();
            let chunk = |(after, bytes)| Chunk { at: now + after, bytes };
            self.coming.extend(heard.map(chunk));
            passed.push((sent.at_ms, Direction::Request, sent.bytes.0));
        }
        self.now += Duration::from_millis(ms);
        if !exchange.hurries {
            let last = self.coming.iter().map(|chunk| chunk.at).max();
            self.now = self.now.max(last.unwrap_or_default());
        }
        let there = self.coming.extract_if(.., |chunk| chunk.at <= self.now);
        passed.extend(there.map(|Chunk { at, bytes }| {
            (milliseconds(at.saturating_sub(begun)), Direction::Reply, bytes)
        }));
        passed.sort_by_key(|(at_ms, ..)| *at_ms);
        let mut passing = Passing::default();
        for (at_ms, direction, bytes) in passed {
            passing.add(at_ms, direction, &bytes);
        }
        let Passing { line, more } = passing;
        Ok(Course { line, more, ms, late: false, returned })
    }
}
