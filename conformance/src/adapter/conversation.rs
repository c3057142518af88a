//! A conversation with an adapter: numbered requests, and the replies to them in any order.

use std::collections::BTreeSet;
use std::io;
use std::process::ExitStatus;
use std::time::Duration;

use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::value::RawValue;
use thiserror::Error;

use super::process::{Line, Running};
use super::{Rejection, Request, Settings, VERSION};
use crate::legible::{LONGEST_TEXT, legible};

/// A conversation with a running adapter. Dropping it kills the process.
#[derive(Debug)]
pub(crate) struct Conversation {
    running: Running,
    /// The version of the adapter protocol that is spoken.
    version: u32,
    next_id: u64,
    /// Requests without a reply so far.
    outstanding: BTreeSet<u64>,
    /// The lines exchanged since they were last taken, if they are kept.
    said: Option<Vec<Said>>,
}

/// A line that was exchanged.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Said {
    /// Whether the adapter wrote the line, not the suite.
    pub by_adapter: bool,
    /// The beginning of the line, without its end, as [`legible`] writes it.
    pub line: String,
}

/// The content of a reply. Its texts are legible and short, whatever the adapter wrote.
#[derive(Clone, Debug)]
pub(crate) enum Reply {
    /// The result: an object that is not read yet. So nothing of it that is not asked for takes
    /// memory.
    Ok(Box<RawValue>),
    /// What is asked is rejected, or failed: an object that [`rejection`] or [`error`] reads.
    Err(Box<RawValue>),
    /// The request was skipped, with the reason.
    Skip(String),
}

/// What is wrong with the content of a reply whose request is known.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub(crate) enum Malformed {
    /// `ok` is not an object.
    #[error("`ok` is no object")]
    Ok,
    /// `err` is not an object with a known class.
    #[error("`err` is wrong: {0}")]
    Err(String),
    /// `skip` is not an object with a reason.
    #[error("`skip` has no `reason`")]
    Skip,
    /// It has no content.
    #[error("the reply has none of `ok`, `err` and `skip`")]
    Nothing,
    /// It has several contents.
    #[error("the reply has more than one of `ok`, `err` and `skip`")]
    Several,
}

/// Why no later reply can be trusted.
#[derive(Debug, Error)]
pub(crate) enum Lost {
    /// Nothing came in time.
    #[error("no answer within {} s", .0.as_secs_f32())]
    Silent(Duration),
    /// The adapter ended, or closed its output.
    #[error("the adapter {}", ended(*.0))]
    Ended(Option<ExitStatus>),
    /// The program is to end.
    #[error("interrupted")]
    Interrupted,
    /// A line is longer than allowed.
    #[error("a line longer than 16 MiB")]
    TooLong,
    /// A line is not a JSON object.
    #[error("{error}: {line}")]
    NoObject {
        /// What is wrong with it.
        error: String,
        /// Its beginning.
        line: String,
    },
    /// A reply has no id.
    #[error("a reply without an id: {0}")]
    NoId(String),
    /// A request is replied to a second time.
    #[error("a reply to request {0}, not the first one")]
    Again(u64),
    /// The id is of no request.
    #[error("a reply to request {0}, which was not sent")]
    NotSent(u64),
}

impl Conversation {
    /// Starts `command`, a program and its arguments.
    pub(crate) fn start(command: &[String], settings: &Settings) -> io::Result<Self> {
        let running = Running::start(command, settings)?;
        let outstanding = BTreeSet::new();
        Ok(Self { running, version: VERSION, next_id: 0, outstanding, said: None })
    }

    /// Speaks this version of the adapter protocol from now on.
    pub(crate) const fn speak(&mut self, version: u32) {
        self.version = version;
    }

    /// Keeps the lines that are exchanged from now on.
    pub(crate) fn keep_lines(&mut self) {
        self.said.get_or_insert_default();
    }

    /// Takes the lines that were exchanged and kept.
    pub(crate) fn take_lines(&mut self) -> Vec<Said> {
        self.said.as_mut().map(std::mem::take).unwrap_or_default()
    }

    /// Sends a request. Returns its id.
    pub(crate) fn send(&mut self, request: &Request<'_>) -> u64 {
        self.send_text(&request.in_version(self.version))
    }

    /// Adds an id to a request, which is a JSON object, and sends it. Returns the id.
    pub(crate) fn send_text(&mut self, request: &str) -> u64 {
        let id = self.next_id;
        self.next_id += 1;
        self.outstanding.insert(id);
        let fields = request.strip_prefix('{').unwrap_or(request);
        let line = format!("{{\"id\":{id},{fields}");
        self.running.send(line.as_bytes());
        if let Some(said) = &mut self.said {
            said.push(Said { by_adapter: false, line: legible(&line, LONGEST_TEXT) });
        }
        id
    }

    /// Waits for a reply to any outstanding request. Returns the request's id and the reply.
    pub(crate) fn receive(
        &mut self,
        limit: Duration,
    ) -> Result<(u64, Result<Reply, Malformed>), Lost> {
        self.receive_in(limit, &Duration::default)
    }

    /// The same, with so much `more` time as the adapter may take by then.
    pub(crate) fn receive_in(
        &mut self,
        limit: Duration,
        more: &dyn Fn() -> Duration,
    ) -> Result<(u64, Result<Reply, Malformed>), Lost> {
        match self.hear_in(&|| limit.saturating_add(more())) {
            Some(Line::Text(line)) => self.read(&line),
            Some(Line::TooLong) => Err(Lost::TooLong),
            Some(Line::End) => Err(Lost::Ended(self.running.exit_status())),
            Some(Line::Interrupt) => Err(Lost::Interrupted),
            None => Err(Lost::Silent(limit)),
        }
    }

    /// Waits for a line; `None` if there is none in time.
    pub(crate) fn hear(&mut self, limit: Duration) -> Option<Line> {
        self.hear_in(&|| limit)
    }

    /// The same with a limit that may grow meanwhile.
    fn hear_in(&mut self, limit: &dyn Fn() -> Duration) -> Option<Line> {
        let heard = self.running.receive(limit);
        if let (Some(Line::Text(line)), Some(said)) = (&heard, &mut self.said) {
            let line = legible(&String::from_utf8_lossy(line), LONGEST_TEXT);
            said.push(Said { by_adapter: true, line });
        }
        heard
    }

    /// How the adapter ended, if it ends within a moment.
    pub(crate) fn exit_status(&mut self) -> Option<ExitStatus> {
        self.running.exit_status()
    }

    /// The last lines that the adapter logged.
    pub(crate) fn log(&self) -> String {
        self.running.log()
    }

    /// Sends `bye` and gives the adapter a moment to end by itself.
    pub(crate) fn farewell(&mut self) {
        self.send(&Request::Bye);
        self.running.farewell();
    }

    /// Reads a reply, and removes its request from the outstanding ones.
    fn read(&mut self, line: &[u8]) -> Result<(u64, Result<Reply, Malformed>), Lost> {
        /// Fields that the adapter protocol does not have are ignored.
        #[derive(Deserialize)]
        struct Fields<'a> {
            #[serde(borrow)]
            id: Option<&'a RawValue>,
            #[serde(borrow)]
            ok: Option<&'a RawValue>,
            #[serde(borrow)]
            err: Option<&'a RawValue>,
            #[serde(borrow)]
            skip: Option<&'a RawValue>,
        }
        let no_object = |error| Lost::NoObject { error, line: shown(line) };
        match line.trim_ascii_start().first() {
            None => return Err(no_object("an empty line".to_owned())),
            // Serde would also read the fields from a list.
            Some(b'[') => return Err(no_object("a list".to_owned())),
            Some(_) => {}
        }
        let fields: Fields<'_> =
            serde_json::from_slice(line).map_err(|error| no_object(error.to_string()))?;
        let id = fields.id.and_then(|id| id.get().parse().ok());
        let id = id.ok_or_else(|| Lost::NoId(shown(line)))?;
        if !self.outstanding.remove(&id) {
            return Err(if id < self.next_id { Lost::Again(id) } else { Lost::NotSent(id) });
        }
        let reply = match (fields.ok, fields.err, fields.skip) {
            (Some(ok), None, None) => {
                object(ok).map(|ok| Reply::Ok(ok.to_owned())).ok_or(Malformed::Ok)
            }
            (None, Some(err), None) => Ok(Reply::Err(err.to_owned())),
            (None, None, Some(skip)) => skipped(skip).ok_or(Malformed::Skip),
            (None, None, None) => Err(Malformed::Nothing),
            _ => Err(Malformed::Several),
        };
        Ok((id, reply))
    }
}

/// The value if it is an object: serde would also read the fields from a list.
fn object(value: &RawValue) -> Option<&RawValue> {
    value.get().starts_with('{').then_some(value)
}

/// Why bytes or a packet are rejected.
pub(crate) fn rejection(err: &RawValue) -> Result<Rejection, Malformed> {
    let rejection: Rejection = error(err)?;
    Ok(Rejection { detail: legible(&rejection.detail, LONGEST_TEXT), ..rejection })
}

/// Reads the `err` of a reply.
pub(crate) fn error<T: DeserializeOwned>(err: &RawValue) -> Result<T, Malformed> {
    let err = object(err).ok_or_else(|| Malformed::Err("it is no object".to_owned()))?;
    serde_json::from_str(err.get())
        .map_err(|error| Malformed::Err(legible(&error.to_string(), LONGEST_TEXT)))
}

fn skipped(skip: &RawValue) -> Option<Reply> {
    #[derive(Deserialize)]
    struct Skip {
        reason: String,
    }
    let Skip { reason } = serde_json::from_str(object(skip)?.get()).ok()?;
    Some(Reply::Skip(legible(&reason, LONGEST_TEXT)))
}

/// How an adapter ended.
pub(crate) fn ended(status: Option<ExitStatus>) -> String {
    status.map_or_else(
        || "closed its standard output".to_owned(),
        |status| format!("ended with {status}"),
    )
}

/// The beginning of a line, for a message.
fn shown(line: &[u8]) -> String {
    const SHOWN: usize = 100;
    format!("`{}`", legible(&String::from_utf8_lossy(line), SHOWN))
}
