//! A library behind an adapter, which is a child process. Every question ends within its time
//! limit, and an adapter that fails is restarted.

mod together;

use std::fmt::Write as _;
use std::io;
use std::time::{Duration, Instant};

use serde::Serialize;
use serde_json::Value;
use thiserror::Error;

use super::{Answer, Questions, Subject};
use crate::adapter::{Hello, Line, Output, Question, Reply, Request, Running, Settings, VERSION};

/// The maximum number of outstanding questions, even if the adapter offers more.
const MAX_IN_FLIGHT: usize = 256;

/// Why an adapter could not be started.
#[derive(Debug, Error)]
pub enum StartError {
    /// There is no such program, or it may not be run.
    #[error("cannot run `{command}`: {error}; give the adapter's command after `--`")]
    Spawn {
        /// The program.
        command: String,
        /// What the system says.
        error: io::Error,
    },
    /// It does not answer `hello` correctly.
    #[error("the adapter `{command}` {problem}{log}")]
    Hello {
        /// The program.
        command: String,
        /// What it did.
        problem: String,
        /// The lines that it logged.
        log: String,
    },
}

/// A library behind an adapter.
#[derive(Debug)]
pub struct Process {
    command: Vec<String>,
    settings: Settings,
    hello: Hello,
    /// How many questions may be outstanding.
    at_once: usize,
    running: Option<Running>,
    restarts: u32,
    next_id: u64,
    /// The last lines of the previous process' log.
    last_log: String,
}

impl Process {
    /// Starts `command`, a program and its arguments, and waits for its `hello`.
    ///
    /// # Errors
    /// If it can't be run, or does not answer `hello` correctly and in time.
    pub fn start(command: &[String], settings: Settings) -> Result<Self, StartError> {
        let (running, hello) = start(command, &settings)?;
        Ok(Self {
            command: command.to_vec(),
            settings,
            at_once: hello.max_in_flight.clamp(1, MAX_IN_FLIGHT),
            hello,
            running: Some(running),
            restarts: 0,
            next_id: 1,
            last_log: String::new(),
        })
    }

    /// The running adapter, restarted if necessary and allowed.
    fn running(&mut self) -> Result<&mut Running, String> {
        if self.running.is_none() {
            let most = self.settings.restarts;
            if self.restarts >= most {
                return Err(format!("the adapter failed {} times", most.saturating_add(1)));
            }
            self.restarts += 1;
            match start(&self.command, &self.settings) {
                Ok((running, _)) => self.running = Some(running),
                Err(error) => {
                    self.restarts = most;
                    return Err(format!("the adapter could not be restarted: {error}"));
                }
            }
        }
        self.running.as_mut().ok_or_else(|| "the adapter is not running".to_owned())
    }

    /// Sends a request and waits for the answer, whose `ok` is read with `read`.
    fn say(
        &mut self,
        request: &Request<'_>,
        read: impl FnOnce(Value) -> Result<Output, serde_json::Error>,
    ) -> Answer {
        let id = self.next_id;
        self.next_id += 1;
        let limit = self.settings.timeouts.request;
        let running = match self.running() {
            Ok(running) => running,
            Err(reason) => return Answer::NotAsked(reason),
        };
        let answer = match exchange(running, id, request, limit) {
            Ok(reply) => answer(reply, read),
            Err(failure) => failure,
        };
        // After such an answer, nothing that follows can be trusted.
        if matches!(answer, Answer::TimedOut(_) | Answer::Crashed(_) | Answer::Faulty(_)) {
            self.end();
        }
        answer
    }

    fn end(&mut self) {
        if let Some(running) = self.running.take() {
            self.last_log = running.log();
        }
    }
}

impl Subject for Process {
    fn hello(&self) -> &Hello {
        &self.hello
    }

    fn ask(&mut self, op: &Question) -> Answer {
        self.say(&Request::Ask(op), |ok| Output::read(op, ok))
    }

    fn ask_invented(&mut self) -> Answer {
        self.say(&Request::Invented, |_| Ok(Output::Packets(Vec::new())))
    }

    fn ask_all(&mut self, questions: &mut dyn Questions) {
        if self.at_once > 1 {
            self.ask_together(questions);
        }
        while let Some(number) = questions.next() {
            let Some(op) = questions.question(number) else { continue };
            let answer = self.ask(op);
            questions.answered(number, answer);
        }
    }

    fn log(&self) -> String {
        self.running.as_ref().map_or_else(|| self.last_log.clone(), Running::log)
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        if let Some(running) = &mut self.running {
            running.farewell(&line(self.next_id, &Request::Bye));
        }
    }
}

fn start(command: &[String], settings: &Settings) -> Result<(Running, Hello), StartError> {
    let name = command.join(" ");
    let mut running = Running::start(command, settings)
        .map_err(|error| StartError::Spawn { command: name.clone(), error })?;
    match greet(&mut running, settings.timeouts.start) {
        Ok(hello) => Ok((running, hello)),
        Err(problem) => {
            let mut log = String::new();
            for line in running.log().lines() {
                // Writing to a string can't fail.
                let _ = write!(log, "\n  {line}");
            }
            Err(StartError::Hello { command: name, problem, log })
        }
    }
}

/// Sends `hello`. The error says what the adapter did wrong.
fn greet(running: &mut Running, limit: Duration) -> Result<Hello, String> {
    let hello = Request::Hello { protocol: &[VERSION] };
    let reply = exchange(running, 0, &hello, limit).map_err(|failure| match failure {
        Answer::TimedOut(_) => format!(
            "did not say hello within {} s; --start-timeout gives it more time",
            limit.as_secs_f32()
        ),
        Answer::Crashed(detail) => format!("ended before it said hello: {detail}"),
        Answer::Faulty(detail) => format!("answered hello wrongly: {detail}"),
        _ => "did not say hello".to_owned(),
    })?;
    let object = reply.ok.ok_or("did not answer hello with `ok`")?;
    let hello: Hello = serde_json::from_value(object)
        .map_err(|error| format!("answered hello wrongly: {error}"))?;
    if hello.protocol != VERSION {
        return Err(format!(
            "speaks version {} of the adapter protocol, not {VERSION}",
            hello.protocol
        ));
    }
    Ok(hello)
}

/// Sends a request and waits for its reply.
fn exchange(
    running: &mut Running,
    id: u64,
    request: &Request<'_>,
    limit: Duration,
) -> Result<Reply, Answer> {
    let deadline = Instant::now() + limit;
    running.send(&line(id, request));
    let reply = read_reply(running, deadline, limit)?;
    match reply.id {
        Some(other) if other != id => {
            Err(Answer::Faulty(format!("a reply to request {other}, not {id}")))
        }
        _ => Ok(reply),
    }
}

/// Waits for a reply to any request.
fn read_reply(running: &mut Running, deadline: Instant, limit: Duration) -> Result<Reply, Answer> {
    let left = deadline.saturating_duration_since(Instant::now());
    let line = match running.receive(left) {
        Some(Line::Text(line)) => line,
        Some(Line::TooLong) => {
            return Err(Answer::Faulty("a line longer than 16 MiB".to_owned()));
        }
        Some(Line::End) => {
            let end = running.exit_status().map_or_else(
                || "closed its output".to_owned(),
                |status| format!("ended with {status}"),
            );
            return Err(Answer::Crashed(format!("the adapter {end}")));
        }
        None => {
            let seconds = limit.as_secs_f32();
            return Err(Answer::TimedOut(format!("no answer within {seconds} s")));
        }
    };
    let reply: Reply = serde_json::from_slice(&line)
        .map_err(|error| Answer::Faulty(format!("{error}: {}", shown(&line))))?;
    if reply.id.is_none() {
        return Err(Answer::Faulty(format!("a reply without an id: {}", shown(&line))));
    }
    Ok(reply)
}

/// A request as a line.
fn line(id: u64, request: &Request<'_>) -> Vec<u8> {
    #[derive(Serialize)]
    struct Line<'a> {
        id: u64,
        #[serde(flatten)]
        request: &'a Request<'a>,
    }
    // Every request has string keys only, so it can be written as JSON.
    serde_json::to_vec(&Line { id, request }).unwrap_or_default()
}

fn answer(reply: Reply, read: impl FnOnce(Value) -> Result<Output, serde_json::Error>) -> Answer {
    match (reply.ok, reply.err, reply.skip) {
        (Some(ok), None, None) => read(ok)
            .map_or_else(|error| Answer::Faulty(format!("a wrong `ok`: {error}")), Answer::Ok),
        (None, Some(rejection), None) => Answer::Rejected(rejection),
        (None, None, Some(skip)) => Answer::Skipped(skip.reason),
        _ => Answer::Faulty("a reply has one of `ok`, `err` and `skip`".to_owned()),
    }
}

/// The beginning of a line, for a message.
fn shown(line: &[u8]) -> String {
    const SHOWN: usize = 60;
    let text: String = String::from_utf8_lossy(line).chars().take(SHOWN).collect();
    let dots = if line.len() > SHOWN { "…" } else { "" };
    format!("`{text}{dots}`")
}
