//! A library behind an adapter, which is a child process. Every question ends within its time
//! limit, and an adapter that fails is restarted.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::io;
use std::sync::atomic::Ordering;
use std::time::Duration;

use thiserror::Error;

use super::{Answer, Line, Questions, Subject};
use crate::adapter::conversation::{Conversation, Lost, Malformed, Reply, rejection};
use crate::adapter::{
    Contradiction, Greeting, Hello, Misfit, Output, Question, Request, Settings, VERSIONS,
};

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
    contradictions: Vec<Contradiction>,
    /// How many questions may be outstanding.
    at_once: usize,
    conversation: Option<Conversation>,
    restarts: u32,
    /// Why it can't be asked any more.
    gone: Option<String>,
    /// The last lines of the previous process' log.
    last_log: String,
}

impl Process {
    /// Starts `command`, a program and its arguments, and waits for its `hello`.
    ///
    /// # Errors
    /// If it can't be run, or does not answer `hello` correctly and in time.
    pub fn start(command: &[String], settings: Settings) -> Result<Self, StartError> {
        let (conversation, greeting) = start(command, &settings)?;
        let (hello, contradictions) = greeting.meant();
        Ok(Self {
            command: command.to_vec(),
            settings,
            at_once: hello.max_in_flight.min(MAX_IN_FLIGHT),
            hello,
            contradictions,
            conversation: Some(conversation),
            restarts: 0,
            gone: None,
            last_log: String::new(),
        })
    }

    /// What its answer to `hello` says that makes no sense.
    #[must_use]
    pub fn contradictions(&self) -> &[Contradiction] {
        &self.contradictions
    }

    /// The conversation with the adapter, which is restarted if necessary and allowed.
    fn conversation(&mut self) -> Result<&mut Conversation, String> {
        if let Some(gone) = &self.gone {
            return Err(gone.clone());
        }
        if self.conversation.is_none() {
            if self.settings.interrupted.load(Ordering::Relaxed) {
                return Err(Lost::Interrupted.to_string());
            }
            let begun = match self.settings.restarts.filter(|most| self.restarts >= *most) {
                Some(most) => Err(format!("the adapter failed {} times", most.saturating_add(1))),
                None => start(&self.command, &self.settings)
                    .map_err(|error| format!("the adapter could not be restarted: {error}")),
            };
            self.restarts = self.restarts.saturating_add(1);
            match begun {
                Ok((conversation, _)) => self.conversation = Some(conversation),
                Err(reason) => return Err(self.gone.insert(reason).clone()),
            }
        }
        self.conversation.as_mut().ok_or_else(|| "the adapter is not running".to_owned())
    }

    /// Sends a request and waits for the answer, whose `ok` is read with `read`.
    fn say(
        &mut self,
        request: &Request<'_>,
        read: impl FnOnce(&str) -> Result<Output, Misfit>,
    ) -> Answer {
        self.talk(|conversation, limit| {
            conversation.send(request);
            conversation.receive(limit).map(|(_, reply)| answer(reply, read))
        })
    }

    /// Talks with the adapter, which has so long for each request. Ends it if it fails.
    fn talk<E: Into<Answer>>(
        &mut self,
        talk: impl FnOnce(&mut Conversation, Duration) -> Result<Answer, E>,
    ) -> Answer {
        let limit = self.settings.timeouts.request;
        let conversation = match self.conversation() {
            Ok(conversation) => conversation,
            Err(reason) => return Answer::NotAsked(reason),
        };
        talk(conversation, limit).unwrap_or_else(|lost| {
            self.end();
            lost.into()
        })
    }

    /// Keeps as many questions outstanding as the adapter takes, until none is left or the adapter
    /// fails. If it fails among several, it is unknown which one is to blame: they are asked again
    /// one by one. Returns whether none is left.
    fn ask_together(&mut self, questions: &mut dyn Questions) -> bool {
        let limit = self.settings.timeouts.request;
        // The number of each outstanding question by the id of its request.
        let mut outstanding = BTreeMap::new();
        // A conversation has the adapter to itself.
        let mut alone = None;
        let lost = loop {
            while outstanding.len() < self.at_once
                && alone.is_none()
                && let Some(number) = questions.next()
            {
                let Some(question) = questions.question(number) else { continue };
                if matches!(question, Question::Converse { .. }) {
                    alone = Some(number);
                    break;
                }
                match self.conversation() {
                    Ok(conversation) => {
                        let id = conversation.send(&Request::Ask(question));
                        outstanding.insert(id, number);
                        questions.asked(number);
                    }
                    Err(reason) => questions.answered(number, Answer::NotAsked(reason)),
                }
            }
            if outstanding.is_empty() {
                let Some(number) = alone.take() else { return true };
                self.ask_one(questions, number);
                continue;
            }
            // The time limit starts again with each reply: it is for the question that the adapter
            // works on.
            let Some(conversation) = &mut self.conversation else { return false };
            let (id, reply) = match conversation.receive(limit) {
                Ok(heard) => heard,
                Err(lost) => break lost,
            };
            let Some(number) = outstanding.remove(&id) else { continue };
            let Some(question) = questions.question(number) else { continue };
            let answer = answer(reply, |ok| Output::read(question, ok));
            questions.answered(number, answer);
        };
        self.end();
        let outstanding: Vec<_> = outstanding.into_values().chain(alone).collect();
        self.ask_apart(questions, &outstanding, lost.into());
        false
    }

    /// Asks questions one by one, after the adapter failed while all of them were outstanding. If it
    /// does not fail again, `failure` is the answer to the first one: an adapter that works through
    /// its requests in order was at that one. Fewer are asked together then.
    fn ask_apart(&mut self, questions: &mut dyn Questions, numbers: &[usize], failure: Answer) {
        let log = self.last_log.clone();
        questions.lost(log.clone());
        let mut held = None;
        for (place, number) in numbers.iter().enumerate() {
            if place > 0 {
                questions.asked(*number);
            }
            let Some(question) = questions.question(*number) else { continue };
            let answer = self.ask(question);
            let failed = self.conversation.is_none();
            if place == 0 && !failed {
                held = Some(answer);
                continue;
            }
            if failed {
                if let (Some(answer), Some(first)) = (held.take(), numbers.first()) {
                    questions.answered(*first, answer);
                }
                questions.lost(self.last_log.clone());
            }
            questions.answered(*number, answer);
        }
        if let (Some(_), Some(first)) = (held, numbers.first()) {
            self.end();
            questions.lost(log);
            questions.answered(*first, failure);
            if numbers.len() > 1 {
                self.at_once = (self.at_once / 2).max(1);
            }
        }
    }

    /// Asks the question with this number alone.
    fn ask_one(&mut self, questions: &mut dyn Questions, number: usize) {
        questions.asked(number);
        let Some(question) = questions.question(number) else { return };
        let answer = self.ask_until(question, &|answer| questions.is_right(number, answer));
        if self.conversation.is_none() {
            questions.lost(self.last_log.clone());
        }
        questions.answered(number, answer);
    }

    fn end(&mut self) {
        if let Some(conversation) = self.conversation.take() {
            self.last_log = conversation.log();
        }
    }
}

impl Subject for Process {
    fn hello(&self) -> &Hello {
        &self.hello
    }

    fn ask(&mut self, question: &Question) -> Answer {
        self.ask_until(question, &|_| false)
    }

    fn ask_until(&mut self, question: &Question, is_right: &dyn Fn(&Answer) -> bool) -> Answer {
        if let Question::Converse { wire, steps } = question {
            let line = Line::of(&self.hello, self.settings.port);
            return self.talk(|conversation, limit| {
                line.converse(conversation, limit, *wire, steps, is_right)
            });
        }
        self.say(&Request::Ask(question), |ok| Output::read(question, ok))
    }

    fn ask_invented(&mut self) -> Answer {
        self.say(&Request::Invented, |_| Ok(Output::Packets(Vec::new())))
    }

    fn ask_all(&mut self, questions: &mut dyn Questions) {
        loop {
            if self.at_once > 1 {
                if self.ask_together(questions) {
                    return;
                }
            } else if let Some(number) = questions.next() {
                self.ask_one(questions, number);
            } else {
                return;
            }
        }
    }

    fn another(&self) -> Option<Box<dyn Subject + Send>> {
        Some(Box::new(Self {
            command: self.command.clone(),
            // In a trace it is number 0.
            settings: Settings { number: 0, ..self.settings.clone() },
            hello: self.hello.clone(),
            contradictions: Vec::new(),
            at_once: 1,
            conversation: None,
            restarts: 0,
            gone: None,
            last_log: String::new(),
        }))
    }

    /// Counts as no failure of the adapter, unless it does not start.
    fn restart(&mut self) {
        self.end();
        if self.settings.interrupted.load(Ordering::Relaxed) {
            return;
        }
        // The next question says why it does not start.
        self.conversation = start(&self.command, &self.settings).ok().map(|(started, _)| started);
    }

    fn log(&self) -> String {
        self.conversation.as_ref().map_or_else(|| self.last_log.clone(), Conversation::log)
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        if let Some(conversation) = &mut self.conversation {
            conversation.farewell();
        }
    }
}

pub(super) fn start(
    command: &[String],
    settings: &Settings,
) -> Result<(Conversation, Greeting), StartError> {
    let name = command.join(" ");
    let mut conversation = Conversation::start(command, settings)
        .map_err(|error| StartError::Spawn { command: name.clone(), error })?;
    match greet(&mut conversation, settings.timeouts.start) {
        Ok(greeting) => Ok((conversation, greeting)),
        Err(problem) => {
            let mut log = String::new();
            for line in conversation.log().lines() {
                // Writing to a string can't fail.
                let _ = write!(log, "\n  {line}");
            }
            Err(StartError::Hello { command: name, problem, log })
        }
    }
}

/// Sends `hello`. The error says what the adapter did wrong.
fn greet(conversation: &mut Conversation, limit: Duration) -> Result<Greeting, String> {
    conversation.send(&Request::Hello { protocol: &VERSIONS });
    let (_, reply) = conversation.receive(limit).map_err(|lost| match lost {
        Lost::Silent(_) => format!(
            "did not say hello within {} s; --start-timeout gives it more time",
            limit.as_secs_f32()
        ),
        Lost::Ended(_) => format!("ended before it said hello: {lost}"),
        Lost::Interrupted => "had not said hello when the program was interrupted".to_owned(),
        lost => format!("answered hello wrongly: {lost}"),
    })?;
    let Ok(Reply::Ok(object)) = reply else {
        return Err("did not answer hello with `ok`".to_owned());
    };
    let greeting = Greeting::read(object.get())
        .map_err(|misfit| format!("answered hello wrongly: {misfit}"))?;
    conversation.speak(greeting.protocol);
    Ok(greeting)
}

impl From<Lost> for Answer {
    fn from(lost: Lost) -> Self {
        let detail = lost.to_string();
        match lost {
            Lost::Silent(_) => Self::TimedOut(detail),
            Lost::Ended(_) => Self::Crashed(detail),
            Lost::Interrupted => Self::NotAsked(detail),
            _ => Self::Faulty(detail),
        }
    }
}

/// The answer that a reply is, whose `ok` is read with `read`.
fn answer(
    reply: Result<Reply, Malformed>,
    read: impl FnOnce(&str) -> Result<Output, Misfit>,
) -> Answer {
    match reply {
        Ok(Reply::Ok(ok)) => {
            read(ok.get()).map_or_else(|misfit| Answer::Faulty(misfit.what), Answer::Ok)
        }
        Ok(Reply::Err(err)) => rejection(&err)
            .map_or_else(|malformed| Answer::Faulty(malformed.to_string()), Answer::Rejected),
        Ok(Reply::Skip(reason)) => Answer::Skipped(reason),
        Err(malformed) => Answer::Faulty(malformed.to_string()),
    }
}
