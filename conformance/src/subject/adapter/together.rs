//! Several questions at once, for an adapter that takes more than one.

use std::time::Instant;

use super::{Process, answer, read_reply, request};
use crate::adapter::Op;
use crate::subject::{Answer, Subject};

/// A question that was sent and is not yet answered.
struct Outstanding<'a> {
    id: u64,
    number: usize,
    op: &'a Op,
}

impl Process {
    /// Keeps as many questions outstanding as the adapter takes, until none is left or the adapter
    /// fails. Which question made it fail can't be told among several: those are asked again one
    /// by one then, and the caller goes on so with the rest.
    pub(super) fn ask_together<'a>(
        &mut self,
        questions: &mut dyn Iterator<Item = (usize, &'a Op)>,
        answered: &mut dyn FnMut(usize, Answer),
    ) {
        let mut outstanding: Vec<Outstanding<'a>> = Vec::new();
        loop {
            while outstanding.len() < self.at_once
                && let Some((number, op)) = questions.next()
            {
                match self.send_next(op) {
                    Ok(id) => outstanding.push(Outstanding { id, number, op }),
                    Err(reason) => answered(number, Answer::NotAsked(reason)),
                }
            }
            if outstanding.is_empty() {
                return;
            }
            let Some((question, answer)) = self.next_answer(&mut outstanding) else { break };
            let faulty = matches!(answer, Answer::Faulty(_));
            answered(question.number, answer);
            if faulty {
                break;
            }
        }
        self.end();
        self.at_once = 1;
        for question in outstanding {
            answered(question.number, self.ask(question.op));
        }
    }

    fn send_next(&mut self, op: &Op) -> Result<u64, String> {
        let id = self.next_id;
        self.next_id += 1;
        self.running()?.send(&request(id, op));
        Ok(id)
    }

    /// Takes one question out of those outstanding, with its answer; `None` if the adapter failed
    /// at one of them. The time limit begins anew with each reply: it is for the question that
    /// the adapter has in hand.
    fn next_answer<'a>(
        &mut self,
        outstanding: &mut Vec<Outstanding<'a>>,
    ) -> Option<(Outstanding<'a>, Answer)> {
        let limit = self.settings.timeouts.request;
        let running = self.running.as_mut()?;
        let reply = read_reply(running, Instant::now() + limit, limit).ok()?;
        let place = outstanding.iter().position(|question| Some(question.id) == reply.id)?;
        let question = outstanding.remove(place);
        let answer = answer(question.op, reply);
        Some((question, answer))
    }
}
