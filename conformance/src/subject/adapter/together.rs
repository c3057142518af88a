//! Several outstanding questions, for an adapter that takes more than one.

use std::time::Instant;

use super::{Process, answer, line, read_reply};
use crate::adapter::{Output, Question, Reply, Request};
use crate::subject::{Answer, Questions, Subject};

/// A question that was sent and is not yet answered.
struct Outstanding {
    id: u64,
    number: usize,
}

impl Process {
    /// Keeps as many questions outstanding as the adapter takes, until none is left or the adapter
    /// fails. If it fails, the outstanding questions are asked again one by one, so that the one to
    /// blame is known; the caller continues with the rest.
    pub(super) fn ask_together(&mut self, questions: &mut dyn Questions) {
        let mut outstanding: Vec<Outstanding> = Vec::new();
        loop {
            while outstanding.len() < self.at_once
                && let Some(number) = questions.next()
            {
                let Some(op) = questions.question(number) else { continue };
                match self.send_next(op) {
                    Ok(id) => outstanding.push(Outstanding { id, number }),
                    Err(reason) => questions.answered(number, Answer::NotAsked(reason)),
                }
            }
            if outstanding.is_empty() {
                return;
            }
            let Some((number, reply)) = self.next_reply(&mut outstanding) else { break };
            let Some(op) = questions.question(number) else { continue };
            let answer = answer(reply, |ok| Output::read(op, ok));
            let faulty = matches!(answer, Answer::Faulty(_));
            questions.answered(number, answer);
            if faulty {
                break;
            }
        }
        self.end();
        self.at_once = 1;
        for Outstanding { number, .. } in outstanding {
            let Some(op) = questions.question(number) else { continue };
            let answer = self.ask(op);
            questions.answered(number, answer);
        }
    }

    fn send_next(&mut self, op: &Question) -> Result<u64, String> {
        let id = self.next_id;
        self.next_id += 1;
        self.running()?.send(&line(id, &Request::Ask(op)));
        Ok(id)
    }

    /// Removes one answered question from the outstanding ones, with its reply; `None` if the
    /// adapter failed. The time limit restarts with each reply.
    fn next_reply(&mut self, outstanding: &mut Vec<Outstanding>) -> Option<(usize, Reply)> {
        let limit = self.settings.timeouts.request;
        let running = self.running.as_mut()?;
        let reply = read_reply(running, Instant::now() + limit, limit).ok()?;
        let place = outstanding.iter().position(|question| Some(question.id) == reply.id)?;
        Some((outstanding.remove(place).number, reply))
    }
}
