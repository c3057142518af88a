//! What the adapter of a host does with calls, and with ports.

use std::ops::ControlFlow;

use actucheck_spec::wire::Wire;
use serde_json::{Value, json};

use super::Problem;
use super::points::{Found, Points};
use super::talk::Talk;
use crate::adapter::{CallError, CallTo, Course, Hello, HostPort, Output, Question, Trouble};
use crate::subject::heard::Heard;
use crate::subject::{Answer, Line, QuietPort};
use crate::suite::check::Check;

/// How often a call is made for which the machine is too busy.
const TRIES: usize = 5;

/// A way to make calls.
#[derive(Clone, Copy)]
struct Way {
    op: &'static str,
    line: Line,
    /// The port, for the names of points.
    port: &'static str,
    /// An `ok`, for who has another one.
    ok: &'static str,
}

const WAYS: [Way; 2] = [
    Way {
        op: "call",
        line: Line::System(HostPort::Pty),
        port: "a port",
        ok: r#"{"devices": [{"id": 1, "data": "a6000000"}]}"#,
    },
    Way {
        op: "exchange",
        line: Line::Memory,
        port: "a port in memory",
        ok: r#"{"sent": [{"at_ms": 0, "bytes": "fffffd…"}], "ms": 1, "devices": [{"id": 1, "data": "a6000000"}]}"#,
    },
];

/// Looks at each way that the adapter offers.
pub(super) fn look(points: &mut Points, hello: &Hello, check: &Check) -> ControlFlow<()> {
    let Some(call) = call(check) else { return ControlFlow::Continue(()) };
    for way in WAYS.iter().filter(|way| hello.offers(way.op)) {
        let (port, wire) = (way.port, check.question.wire());
        points.point(format!("makes a call through {port}"), |talk| way.makes(talk, check))?;
        points.point(format!("skips a call that it does not know through {port}"), |talk| {
            way.skips_a_name(talk, wire, call.clone())
        })?;
        points.point(format!("opens and closes {port} as it is told"), |talk| {
            way.opens_and_closes(talk, wire, &call)
        })?;
        // A port in memory has no other.
        if matches!(way.line, Line::System(_)) {
            points.point("makes its calls through the port that it opened last", |talk| {
                way.replaces_a_port(talk, check)
            })?;
        }
    }
    ControlFlow::Continue(())
}

impl Way {
    /// The line, with the port that the user chose.
    const fn line(&self, talk: &Talk) -> Line {
        match self.line {
            Line::System(_) => Line::System(talk.port),
            Line::Memory => Line::Memory,
        }
    }

    /// What the library makes of the call is its own matter.
    fn makes(&self, talk: &mut Talk, check: &Check) -> Found {
        let Question::Converse { wire, steps } = &check.question else { return Ok(String::new()) };
        match talk.converse(self.line(talk), *wire, steps, &|_| false)? {
            Answer::Faulty(what) => {
                let Self { op, ok, .. } = self;
                let mend = format!(
                    "answer `open` and `close` with {{\"ok\": {{}}}}, and `{op}` with what the library's \
                     user gets: {{\"ok\": {ok}}}"
                );
                Err(Problem::new(what, mend))
            }
            Answer::Skipped(reason) => Ok(format!("skipped: {reason}")),
            answer => Ok(check.clone().judge(answer).detail),
        }
    }

    fn skips_a_name(&self, talk: &mut Talk, wire: Wire, mut call: Value) -> Found {
        if let Some(name) = call.get_mut("name") {
            *name = json!("no-such-call");
        }
        let port = QuietPort::of(self.line(talk), wire).map_err(closed)?;
        done(talk, &open(wire, &port.address), "open")?;
        let heard = talk.hear_host(&self.request(wire, &call))?;
        done(talk, &json!({"op": "close", "wire": wire}), "close")?;
        match heard {
            Heard::Other(Answer::Skipped(_)) => Ok(String::new()),
            _ => Err(Problem::new(
                "the reply to a call that there is not is no `skip`",
                "look at the call's `name` first, and skip those that the library does not have",
            )),
        }
    }

    /// Opens a port twice, closes it twice, and makes a call then.
    fn opens_and_closes(&self, talk: &mut Talk, wire: Wire, call: &Value) -> Found {
        let port = QuietPort::of(self.line(talk), wire).map_err(closed)?;
        for op in ["open", "open", "close", "close"] {
            let request = match op {
                "open" => open(wire, &port.address),
                _ => json!({"op": op, "wire": wire}),
            };
            done(talk, &request, op)?;
        }
        match talk.hear_host(&self.request(wire, call))? {
            Heard::Err(CallError { class: Trouble::Port, .. })
            | Heard::Other(Answer::Skipped(_)) => Ok(String::new()),
            _ => Err(Problem::new(
                "a call without an open port is no `err` of the class `port`",
                "answer {\"err\": {\"class\": \"port\", \"detail\": \"no port is open\"}} before `open` and \
                 after `close`",
            )),
        }
    }

    /// Opens a port while another is open, and makes a call.
    fn replaces_a_port(&self, talk: &mut Talk, check: &Check) -> Found {
        let Question::Converse { wire, steps } = &check.question else { return Ok(String::new()) };
        let (line, mend) =
            (self.line(talk), "close the port that is open when `open` names another");
        if !sends(&talk.converse(line, *wire, steps, &sends)?) {
            return Ok("the call sends nothing".to_owned());
        }
        let first = QuietPort::of(line, *wire).map_err(closed)?;
        for _ in 0..TRIES {
            done(talk, &open(*wire, &first.address), "open")?;
            // Each try closes the port.
            match talk.converse(line, *wire, steps, &|_| true)? {
                Answer::Faulty(what) => return Err(Problem::new(what, mend)),
                answer if sends(&answer) => return Ok(String::new()),
                answer if !is_late(&answer) => break,
                _ => {}
            }
        }
        Err(Problem::new("after a second `open` a call does not go to its port", mend))
    }

    /// The request for a call that nothing answers.
    fn request(&self, wire: Wire, call: &Value) -> Value {
        match self.line {
            Line::System(_) => json!({"op": self.op, "wire": wire, "call": call}),
            Line::Memory => json!({
                "op": self.op, "wire": wire, "call": call, "frame": "00", "answers": [], "late": "",
                "hurries": false,
            }),
        }
    }
}

/// Whether something was sent on the line.
fn sends(answer: &Answer) -> bool {
    is_any(answer, |course| !course.sent().is_empty())
}

/// Whether the machine was too busy for the line.
fn is_late(answer: &Answer) -> bool {
    is_any(answer, |course| course.late)
}

fn is_any(answer: &Answer, is_so: impl Fn(&Course) -> bool) -> bool {
    matches!(answer, Answer::Ok(Output::Conversation(courses)) if courses.iter().any(is_so))
}

/// The call of a check.
fn call(check: &Check) -> Option<Value> {
    let Question::Converse { wire, steps } = &check.question else { return None };
    let step = steps.first()?;
    let device = wire.device(&step.packet.packet);
    serde_json::to_value(CallTo { call: step.packet.call.clone()?, device }).ok()
}

fn open(wire: Wire, port: &str) -> Value {
    json!({"op": "open", "wire": wire, "port": port, "baud": 1_000_000})
}

/// Asks for what has no result.
fn done(talk: &mut Talk, request: &Value, what: &str) -> Result<(), Problem> {
    match talk.hear_host(request)? {
        Heard::Ok(_) => Ok(()),
        _ => Err(Problem::new(
            format!("the reply to `{what}` is no `ok`"),
            "answer `open` with {\"ok\": {}} when it has closed the port that was open and opened the one \
             that it names, and `close` whether a port is open or not",
        )),
    }
}

fn closed(error: String) -> Problem {
    Problem::new(error, "the system gives no port; check the adapter on another machine")
}
