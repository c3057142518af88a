//! A conversation for the check of an adapter.

use std::io;
use std::process::ExitStatus;
use std::time::Duration;

use serde_json::Value;

use super::{Problem, Said};
use crate::adapter::conversation::{Conversation, Lost, Malformed, Reply, ended, rejection};
use crate::adapter::process;
use crate::adapter::{HostPort, Misfit, Rejection, Settings, Step, Wire, reading};
use crate::subject::heard::{Heard, hear};
use crate::subject::{self, Line};

pub(super) const ONLY_REPLIES: &str = "write nothing but replies to standard output, a JSON object a line; \
    messages go to standard error";
const COPY_ID: &str = "copy `id` from the request into the one reply to it";

/// The content of a reply whose form is right.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Answer {
    Ok(Value),
    Err(Rejection),
    Skip(String),
}

/// A conversation with an adapter whose form is checked.
pub(super) struct Talk {
    conversation: Conversation,
    /// The time limit for a request.
    pub(super) limit: Duration,
    /// The port that a host gets.
    pub(super) port: HostPort,
}

impl Talk {
    pub(super) fn start(command: &[String], settings: &Settings) -> io::Result<Self> {
        let mut conversation = Conversation::start(command, settings)?;
        conversation.keep_lines();
        let (limit, port) = (settings.timeouts.request, settings.port.unwrap_or_default());
        Ok(Self { conversation, limit, port })
    }

    /// Lets the adapter make calls on a line. It is tried again on a busy machine unless it `is_right`.
    pub(super) fn converse(
        &mut self,
        line: Line,
        wire: Wire,
        steps: &[Step],
        is_right: &dyn Fn(&subject::Answer) -> bool,
    ) -> Result<subject::Answer, Problem> {
        let answer = line.converse(&mut self.conversation, self.limit, wire, steps, is_right);
        answer.map_err(|interrupted| without_reply(&interrupted.lost))
    }

    /// Sends a request for an op of a host and waits for its reply.
    pub(super) fn hear_host(&mut self, request: &Value) -> Result<Heard, Problem> {
        self.conversation.send_text(&request.to_string());
        hear(&mut self.conversation, self.limit, &Duration::default)
            .map_err(|lost| without_reply(&lost))
    }

    /// Sends a request and waits for its reply.
    pub(super) fn ask(&mut self, request: &str) -> Result<Answer, Problem> {
        self.send(request);
        self.receive(self.limit).map(|(_, answer)| answer)
    }

    /// Adds an id to a request, which is a JSON object, and sends it. Returns the id.
    pub(super) fn send(&mut self, request: &str) -> u64 {
        self.conversation.send_text(request)
    }

    /// Waits for a reply to any outstanding request. Returns the request's id and the answer.
    pub(super) fn receive(&mut self, limit: Duration) -> Result<(u64, Answer), Problem> {
        let (id, reply) = self.conversation.receive(limit).map_err(|lost| without_reply(&lost))?;
        answer(reply).map(|answer| (id, answer))
    }

    /// Waits for anything that the adapter does without a request.
    pub(super) fn hear(&mut self, limit: Duration) -> Option<process::Line> {
        self.conversation.hear(limit)
    }

    /// How the adapter ended.
    pub(super) fn end(&mut self) -> Option<ExitStatus> {
        self.conversation.exit_status()
    }

    pub(super) fn take_said(&mut self) -> Vec<Said> {
        self.conversation.take_lines()
    }

    /// The last lines that the adapter logged.
    pub(super) fn log(&self) -> String {
        self.conversation.log()
    }
}

/// How to mend a missing reply.
fn without_reply(lost: &Lost) -> Problem {
    match lost {
        Lost::Ended(status) => Problem::ending(
            format!("it {} instead of a reply", ended(*status)),
            "answer with `err` whatever goes wrong, and end at `bye` only; the end of its \
             standard error is shown below",
        ),
        Lost::Silent(limit) => Problem::ending(
            format!("there was no reply within {} s", limit.as_secs_f32()),
            "write a line for each request, end it with a line feed and flush it; \
             --timeout, and --start-timeout at the start, give it more time",
        ),
        Lost::Interrupted => interrupted(),
        Lost::TooLong => Problem::ending(TOO_LONG, ONLY_REPLIES),
        Lost::NoObject { error, .. } => {
            Problem::ending(format!("the reply is no JSON object: {error}"), ONLY_REPLIES)
        }
        Lost::NoId(_) => Problem::ending("the reply has no `id`", COPY_ID),
        Lost::Again(id) => {
            Problem::ending(format!("this is another reply to request {id}"), COPY_ID)
        }
        Lost::NotSent(id) => {
            let what = format!("this is a reply to request {id}, which was not sent");
            Problem::ending(what, COPY_ID)
        }
    }
}

/// Nothing is wrong, but the rest is not checked.
pub(super) fn interrupted() -> Problem {
    Problem::ending("interrupted", "check it again")
}

pub(super) const TOO_LONG: &str = "a line is longer than 16 MiB";

/// The answer in a reply, or how to mend a reply that is not an answer.
fn answer(reply: Result<Reply, Malformed>) -> Result<Answer, Problem> {
    match reply {
        Ok(Reply::Ok(ok)) => {
            let ok = reading::object(ok.get());
            ok.map(Answer::Ok).map_err(|Misfit { what, mend }| Problem::new(what, mend))
        }
        Ok(Reply::Err(err)) => {
            rejection(&err).map(Answer::Err).or_else(|malformed| answer(Err(malformed)))
        }
        Ok(Reply::Skip(reason)) => Ok(Answer::Skip(reason)),
        Err(malformed @ Malformed::Ok) => Err(Problem::new(
            malformed,
            "put the result under its name into `ok`, such as {\"crc\": 1}",
        )),
        Err(malformed @ Malformed::Skip) => Err(Problem::new(
            malformed,
            "`skip` is an object with `reason`, a text that reports show",
        )),
        Err(malformed @ Malformed::Err(_)) => Err(Problem::new(
            malformed,
            "`err` is an object with `class`, one of the error classes, and `detail`, a text",
        )),
        Err(malformed @ (Malformed::Nothing | Malformed::Several)) => {
            Err(Problem::new(malformed, "give each reply one of them"))
        }
    }
}
