//! The points of the check, in order.

use std::io;
use std::ops::ControlFlow;
use std::time::Duration;

#[cfg(unix)]
use actucheck_spec::model::HexBytes;
#[cfg(unix)]
use serde_json::Value;

use super::example::Example;
use super::talk::{Answer, ONLY_REPLIES, TOO_LONG, Talk, interrupted};
use super::{Point, Problem, Report, hosts, shape};
use crate::adapter::conversation::ended;
use crate::adapter::process::Line;
use crate::adapter::{Contradiction, Greeting, Hello, Request, Settings, VERSIONS};
#[cfg(unix)]
use crate::adapter::{VERSION, Wire};
use crate::run::not_offered;
#[cfg(unix)]
use crate::subject::device::plays;
use crate::suite::check::Check;
#[cfg(unix)]
use crate::suite::device::hello_all;

/// Size of a line, in bytes, that overflows any usual fixed buffer.
const LONG: usize = 70_000;
/// The maximum number of outstanding requests.
const MAX_AT_ONCE: usize = 64;
/// How long to wait for an unrequested line.
const QUIET: Duration = Duration::from_millis(100);

/// A remark, which may be empty; or the problem.
pub(super) type Found = Result<String, Problem>;

/// A question and its answer.
type Answered<'a> = (&'a Example, Answer);

/// Checks an adapter from its start to its end.
pub(super) fn look(
    command: &[String],
    settings: &Settings,
    examples: &[Example],
    calls: &[Check],
) -> io::Result<Report> {
    let mut points = Points { talk: Talk::start(command, settings)?, points: Vec::new() };
    let greeting = greet(&mut points.talk, settings);
    let told = greeting.as_ref().ok().cloned().map(Greeting::meant);
    points.note("starts and says who it is", greeting.map(|greeting| introduction(&greeting)));
    let said = points.points.last().map(|point| point.said.clone()).unwrap_or_default();
    let (hello, contradictions) = told.unzip();
    if let Some(hello) = &hello {
        let result = without(contradictions.unwrap_or_default());
        points.points.push(Point { name: "says what makes sense".to_owned(), result, said });
        // The last point reports an early end of the conversation.
        let in_version = |example: &Example| example.in_version(hello.protocol);
        let examples: Vec<_> = examples.iter().map(in_version).collect();
        let _ = points.look_on(hello, &examples, calls, || another(command, settings, hello));
    }
    Ok(Report { hello, points: points.points, log: points.talk.log() })
}

/// The conversation, and the results so far.
pub(super) struct Points {
    talk: Talk,
    points: Vec<Point>,
}

impl Points {
    fn look_on(
        &mut self,
        hello: &Hello,
        examples: &[Example],
        calls: &[Check],
        another: impl FnOnce() -> Found,
    ) -> ControlFlow<()> {
        self.point("skips an op that it does not know", invented_op)?;
        self.point("skips a wire that it does not know", invented_wire)?;
        let (offered, others): (Vec<_>, Vec<_>) =
            examples.iter().partition(|example| example.is_offered(hello));
        self.point("skips what it does not offer", |talk| others_skipped(talk, &others))?;
        let (offered, of_other_role): (Vec<_>, Vec<_>) =
            offered.into_iter().partition(|example| example.fits_role(hello));
        if !of_other_role.is_empty() {
            self.point("skips what only the other role does", |talk| {
                other_role(talk, &of_other_role)
            })?;
        }

        let mut answered = Vec::new();
        for example in offered {
            self.point(format!("answers {}", example.name), |talk| {
                let answer = talk.ask(&example.request)?;
                let remark = example.remark(&answer)?;
                answered.push((example, answer));
                Ok(remark)
            })?;
        }
        self.point("takes what is valid", |talk| valid(talk, &answered))?;
        self.point("answers the same when asked again", |talk| again(talk, &answered))?;
        self.point("passes over a field that it does not know", |talk| {
            further_field(talk, &answered)
        })?;
        self.point("outlives requests that lack a field", |talk| lacking_fields(talk, &answered))?;
        self.point("answers as many at once as it says", |talk| {
            at_once(talk, hello.max_in_flight.min(MAX_AT_ONCE), &answered)
        })?;
        if let Some(check) = calls.iter().find(|check| not_offered(hello, check).is_none()) {
            hosts::look(self, hello, check)?;
        }
        #[cfg(unix)]
        for wire in Wire::ALL.into_iter().filter(|wire| plays(hello, *wire)) {
            self.point(format!("answers bytes as a device on {wire}"), |talk| device(talk, wire))?;
        }
        self.point("reads a long line", long_line)?;
        self.point("runs beside another of its kind", |_| another())?;
        self.point("writes nothing but replies", silence)?;
        self.point("ends at bye", bye)
    }

    pub(super) fn point(
        &mut self,
        name: impl Into<String>,
        look: impl FnOnce(&mut Talk) -> Found,
    ) -> ControlFlow<()> {
        let result = look(&mut self.talk);
        let ends = result.as_ref().is_err_and(|problem| problem.ends);
        self.note(name, result);
        if ends { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    fn note(&mut self, name: impl Into<String>, result: Found) {
        self.points.push(Point { name: name.into(), result, said: self.talk.take_said() });
    }
}

/// No bytes, a byte of no packet, and a greeting of any device: whatever it sends, it sends it as bytes.
#[cfg(unix)]
fn device(talk: &mut Talk, wire: Wire) -> Found {
    let hello = hello_all(wire).and_then(|packet| wire.encode(&packet)).unwrap_or_default();
    let mut count = 0;
    for (after_ms, bytes) in [(0, Vec::new()), (0, vec![0]), (1000, hello)] {
        let request = Request::Device { wire, after_ms, bytes: &bytes.into() }.in_version(VERSION);
        let Answer::Ok(ok) = talk.ask(&request)? else {
            return Err(Problem::new(DEVICE, DEVICE_MEND));
        };
        let bytes = ok.get("bytes").and_then(Value::as_str);
        let bytes = bytes.and_then(|bytes| HexBytes::parse(bytes).ok());
        count += bytes.ok_or_else(|| Problem::new(DEVICE, DEVICE_MEND))?.len();
    }
    // Who may be asked for by nobody but a host that knows its ID need not answer here.
    Ok(if count == 0 { "it sends nothing to a packet for all".to_owned() } else { String::new() })
}

#[cfg(unix)]
const DEVICE: &str = "the reply to `device` has no `bytes`";
#[cfg(unix)]
const DEVICE_MEND: &str =
    "answer with what the device sends, {\"ok\": {\"bytes\": \"fffffd…\"}}; nothing is \"\"";

/// Whether there is no contradiction.
fn without(contradictions: Vec<Contradiction>) -> Found {
    let (what, mend): (Vec<_>, Vec<_>) =
        contradictions.into_iter().map(|found| (found.what, found.mend)).unzip();
    if what.is_empty() {
        return Ok(String::new());
    }
    Err(Problem::new(what.join("; "), mend.join("; ")))
}

fn greet(talk: &mut Talk, settings: &Settings) -> Result<Greeting, Problem> {
    let hello = Request::Hello { protocol: &VERSIONS };
    // Every request has string keys only, so it can be written as JSON.
    talk.send(&serde_json::to_string(&hello).unwrap_or_default());
    match talk.receive(settings.timeouts.start)? {
        (_, Answer::Ok(ok)) => shape::hello(&ok),
        _ => Err(Problem::ending(
            "the reply is no `ok`",
            "answer `hello` with `ok` and what the adapter is and offers",
        )),
    }
}

fn introduction(greeting: &Greeting) -> String {
    let who = &greeting.implementation;
    let offered = |names: &[String]| {
        if names.is_empty() { "nothing".to_owned() } else { names.join(", ") }
    };
    let (wires, ops) = (offered(&greeting.wires), offered(&greeting.ops));
    let roles = greeting
        .roles
        .as_deref()
        .map_or_else(String::new, |roles| format!("{} on ", roles.join(" and ")));
    format!("{} {} ({}), {roles}{wires}: {ops}", who.name, who.version, who.language)
}

fn invented_op(talk: &mut Talk) -> Found {
    let mend = "skip every op that you do not know: a later suite asks more";
    must_skip(talk, r#"{"op":"no-such-op"}"#, mend)
}

fn invented_wire(talk: &mut Talk) -> Found {
    let mend = "look at `wire` first, and skip those that you do not speak";
    must_skip(talk, r#"{"op":"crc","wire":"no-such-wire","bytes":"00"}"#, mend)
}

fn others_skipped(talk: &mut Talk, others: &[&Example]) -> Found {
    let mend = "name the op and the wire in your answer to `hello`, or skip it";
    others.iter().try_fold(String::new(), |_, example| must_skip(talk, &example.request, mend))
}

fn other_role(talk: &mut Talk, others: &[&Example]) -> Found {
    let mend = "name the role in `roles` if the library plays it, or skip what only it does";
    others.iter().try_fold(String::new(), |_, example| must_skip(talk, &example.request, mend))
}

fn must_skip(talk: &mut Talk, request: &str, mend: &'static str) -> Found {
    match talk.ask(request)? {
        Answer::Skip(_) => Ok(String::new()),
        Answer::Ok(_) | Answer::Err(_) => Err(Problem::new("the reply is no `skip`", mend)),
    }
}

/// Whether some valid packet or bytes were taken with each op of each wire, and some packet was built
/// right.
fn valid(talk: &mut Talk, answered: &[Answered<'_>]) -> Found {
    let kind = |example: &Example| (example.op(), example.question().wire());
    let mut kinds: Vec<_> = answered.iter().map(|(example, _)| kind(example)).collect();
    kinds.dedup();
    for (op, wire) in kinds {
        let of_op = answered.iter().filter(|(example, _)| kind(example) == (op, wire));
        let done: Vec<_> = of_op.filter(|(_, answer)| !matches!(answer, Answer::Skip(_))).collect();
        let Some((example, _)) = done.first() else { continue };
        let rejected = |(_, answer): &&Answered<'_>| matches!(answer, Answer::Err(_));
        let wrong = |(example, answer): &&Answered<'_>| !example.is_right(answer);
        let what = if done.iter().all(rejected) {
            format!("each {op} on {wire} is rejected, though it is valid")
        } else if op == "encode" && done.iter().all(wrong) {
            format!("no packet is built right on {wire}")
        } else {
            continue;
        };
        // The lines of the first answer are shown once more.
        talk.ask(&example.request)?;
        let mend = "see what the library got and what it gave: more likely the adapter is wrong; \
                    what the library can't do is skipped";
        return Err(example.shown(Problem::new(what, mend)));
    }
    Ok(String::new())
}

/// Asks the same questions in reverse order, after bytes that leave a parser in the middle of a
/// packet.
fn again(talk: &mut Talk, answered: &[Answered<'_>]) -> Found {
    for request in answered.iter().filter_map(|(example, _)| example.cut_short()) {
        talk.ask(&request)?;
    }
    for (example, first) in answered.iter().rev() {
        let answer = talk.ask(&example.request)?;
        let mend = "begin each request afresh: keep no parser and no buffer for the next one";
        same(&answer, first, example, mend)?;
    }
    Ok(String::new())
}

fn further_field(talk: &mut Talk, answered: &[Answered<'_>]) -> Found {
    for (example, first) in answered {
        let answer = talk.ask(&example.with_another_field())?;
        let mend = "take the fields that you need out of the request, whatever else it has";
        same(&answer, first, example, mend)?;
    }
    Ok(String::new())
}

/// Any answer is right, but there must be one.
fn lacking_fields(talk: &mut Talk, answered: &[Answered<'_>]) -> Found {
    for request in answered.iter().flat_map(|(example, _)| example.lacking_fields()) {
        talk.ask(&request)?;
    }
    Ok(String::new())
}

fn at_once(talk: &mut Talk, count: usize, answered: &[Answered<'_>]) -> Found {
    if count == 1 {
        return Ok("max_in_flight is 1".to_owned());
    }
    let asked: Vec<_> = answered
        .iter()
        .cycle()
        .take(count)
        .map(|(example, first)| (talk.send(&example.request), *example, first))
        .collect();
    // After a malformed reply, other replies are still outstanding.
    let answers: Result<Vec<_>, _> = asked
        .iter()
        .map(|_| talk.receive(talk.limit).map_err(|problem| Problem { ends: true, ..problem }))
        .collect();
    for (id, answer) in answers? {
        if let Some((_, example, first)) = asked.iter().find(|(asked, ..)| *asked == id) {
            let mend = "keep requests apart, or leave `max_in_flight` out";
            same(&answer, first, example, mend)?;
        }
    }
    Ok(format!("{count} of them"))
}

/// The library's own texts may differ from run to run.
fn same(
    answer: &Answer,
    first: &Answer,
    example: &Example,
    mend: &'static str,
) -> Result<(), Problem> {
    let same = match (answer, first) {
        (Answer::Ok(answer), Answer::Ok(first)) => answer == first,
        (Answer::Err(answer), Answer::Err(first)) => answer.class == first.class,
        (Answer::Skip(_), Answer::Skip(_)) => true,
        _ => false,
    };
    if same {
        return Ok(());
    }
    Err(Problem::new(format!("{} is answered another way than before", example.name), mend))
}

fn long_line(talk: &mut Talk) -> Found {
    let request = format!(r#"{{"op":"no-such-op","padding":"{}"}}"#, "0".repeat(LONG));
    must_skip(talk, &request, "read whole lines, however long they are")
}

/// Starts a second process, as `--jobs` does.
fn another(command: &[String], settings: &Settings, hello: &Hello) -> Found {
    let mend = "let processes share no file, port or device: `--jobs` starts several";
    let told = Talk::start(command, settings)
        .map_err(|error| Problem::new(error, mend))
        .and_then(|mut talk| greet(&mut talk, settings))
        .map_err(|problem| Problem::new(format!("the other one: {}", problem.what), mend))?;
    if told.meant().0 == *hello {
        Ok(String::new())
    } else {
        Err(Problem::new("the other one says other things of itself", mend))
    }
}

fn silence(talk: &mut Talk) -> Found {
    match talk.hear(QUIET) {
        None => Ok(String::new()),
        Some(Line::Text(_)) => Err(Problem::ending(
            "it wrote a line that nobody asked for",
            "write nothing but replies to standard output; messages go to standard error",
        )),
        Some(Line::TooLong) => Err(Problem::ending(TOO_LONG, ONLY_REPLIES)),
        Some(Line::Interrupt) => Err(interrupted()),
        Some(Line::End) => {
            Err(Problem::ending(format!("it {}", ended(talk.end())), "end at `bye` only"))
        }
    }
}

fn bye(talk: &mut Talk) -> Found {
    talk.send(r#"{"op":"bye"}"#);
    let mend = "end the program at `bye`, without a reply";
    match talk.hear(talk.limit) {
        Some(Line::End) => match talk.end() {
            Some(status) if status.success() => Ok(String::new()),
            Some(status) => Ok(format!("with {status}")),
            None => Err(Problem::new("it closed its output, but runs on", mend)),
        },
        Some(Line::Text(_) | Line::TooLong) => Err(Problem::new("it replied", mend)),
        Some(Line::Interrupt) => Err(interrupted()),
        None => Err(Problem::new("it runs on", mend)),
    }
}
