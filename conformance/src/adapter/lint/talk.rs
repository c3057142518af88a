//! A conversation with an adapter, line by line.

use std::collections::BTreeSet;
use std::io;
use std::process::ExitStatus;
use std::time::Duration;

use serde_json::{Map, Value};

use super::{Problem, Said};
use crate::adapter::Rejection;
use crate::adapter::{Line, Running, Settings};

const ONLY_REPLIES: &str = "write nothing but replies to standard output, a JSON object a line; messages go to standard \
     error";

/// The content of a reply.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Answer {
    Ok(Value),
    Err(Rejection),
    Skip(String),
}

/// What happens while the suite waits for a line.
pub(super) enum Heard {
    Line(String),
    End(Option<ExitStatus>),
    Nothing,
}

/// A conversation with an adapter.
pub(super) struct Talk {
    running: Running,
    /// The time limit for a request.
    pub(super) limit: Duration,
    next_id: u64,
    /// Requests without a reply so far.
    outstanding: BTreeSet<u64>,
    /// The lines exchanged since they were last taken.
    said: Vec<Said>,
}

impl Talk {
    pub(super) fn start(command: &[String], settings: &Settings) -> io::Result<Self> {
        Ok(Self {
            running: Running::start(command, settings)?,
            limit: settings.timeouts.request,
            next_id: 0,
            outstanding: BTreeSet::new(),
            said: Vec::new(),
        })
    }

    /// Sends a request and waits for its reply.
    pub(super) fn ask(&mut self, request: &str) -> Result<Answer, Problem> {
        self.send(request);
        self.receive(self.limit).map(|(_, answer)| answer)
    }

    /// Adds an id to a request, which is a JSON object, and sends it. Returns the id.
    pub(super) fn send(&mut self, request: &str) -> u64 {
        let id = self.next_id;
        self.next_id += 1;
        let fields = request.strip_prefix('{').unwrap_or(request);
        let line = format!("{{\"id\":{id},{fields}");
        self.running.send(line.as_bytes());
        self.said.push(Said { by_adapter: false, line });
        self.outstanding.insert(id);
        id
    }

    /// Waits for a reply to any outstanding request. Returns the request's id and the answer.
    pub(super) fn receive(&mut self, limit: Duration) -> Result<(u64, Answer), Problem> {
        let line = match self.hear(limit)? {
            Heard::Line(line) => line,
            Heard::End(status) => {
                return Err(Problem::ending(
                    format!("it {} instead of a reply", ended(status)),
                    "answer with `err` whatever goes wrong, and end at `bye` only; the end of its \
                     standard error is shown below",
                ));
            }
            Heard::Nothing => {
                return Err(Problem::ending(
                    format!("there was no reply within {} s", limit.as_secs_f32()),
                    "write a line for each request, end it with a line feed and flush it; \
                     --timeout, and --start-timeout at the start, give it more time",
                ));
            }
        };
        let reply: Map<String, Value> = serde_json::from_str(&line).map_err(|error| {
            Problem::ending(format!("the reply is no JSON object: {error}"), ONLY_REPLIES)
        })?;
        let id = self.answered(&reply)?;
        answer(&reply).map(|answer| (id, answer))
    }

    /// Waits for a line, the end of the adapter, or the time limit.
    pub(super) fn hear(&mut self, limit: Duration) -> Result<Heard, Problem> {
        match self.running.receive(limit) {
            Some(Line::Text(line)) => {
                let line = String::from_utf8_lossy(&line).into_owned();
                self.said.push(Said { by_adapter: true, line: line.clone() });
                Ok(Heard::Line(line))
            }
            Some(Line::TooLong) => {
                Err(Problem::ending("a line is longer than 16 MiB", ONLY_REPLIES))
            }
            Some(Line::End) => Ok(Heard::End(self.running.exit_status())),
            None => Ok(Heard::Nothing),
        }
    }

    /// Finds the outstanding request that a reply answers, and removes it from the outstanding
    /// ones.
    fn answered(&mut self, reply: &Map<String, Value>) -> Result<u64, Problem> {
        const MEND: &str = "copy `id` from the request into the one reply to it";
        let Some(id) = reply.get("id").and_then(Value::as_u64) else {
            return Err(Problem::ending("the reply has no `id`", MEND));
        };
        if self.outstanding.remove(&id) {
            return Ok(id);
        }
        let what = if id < self.next_id {
            format!("this is another reply to request {id}")
        } else {
            format!("this is a reply to request {id}, which was not sent")
        };
        Err(Problem::ending(what, MEND))
    }

    pub(super) fn take_said(&mut self) -> Vec<Said> {
        std::mem::take(&mut self.said)
    }

    /// The last lines that the adapter logged.
    pub(super) fn log(&self) -> String {
        self.running.log()
    }
}

/// How an adapter ended.
pub(super) fn ended(status: Option<ExitStatus>) -> String {
    status.map_or_else(
        || "closed its standard output".to_owned(),
        |status| format!("ended with {status}"),
    )
}

/// The content of a reply, which has exactly one of `ok`, `err` and `skip`.
fn answer(reply: &Map<String, Value>) -> Result<Answer, Problem> {
    let given = |name| reply.get(name).filter(|value| !value.is_null());
    match (given("ok"), given("err"), given("skip")) {
        (Some(ok @ Value::Object(_)), None, None) => Ok(Answer::Ok(ok.clone())),
        (Some(_), None, None) => Err(Problem::new(
            "`ok` is no object",
            "put the result under its name into `ok`, such as {\"crc\": 1}",
        )),
        (None, Some(err), None) => serde_json::from_value(err.clone()).map(Answer::Err).map_err(|error| {
            Problem::new(
                format!("`err` is wrong: {error}"),
                "`err` is an object with `class`, one of the error classes, and `detail`, a text",
            )
        }),
        (None, None, Some(skip)) => skip
            .get("reason")
            .and_then(Value::as_str)
            .map(|reason| Answer::Skip(reason.to_owned()))
            .ok_or_else(|| {
                Problem::new(
                    "`skip` has no `reason`",
                    "`skip` is an object with `reason`, a text that reports show",
                )
            }),
        (None, None, None) => Err(Problem::new(
            "the reply has none of `ok`, `err` and `skip`",
            "give each reply one of them",
        )),
        _ => Err(Problem::new(
            "the reply has more than one of `ok`, `err` and `skip`",
            "give each reply one of them",
        )),
    }
}
