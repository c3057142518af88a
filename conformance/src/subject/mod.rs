//! The implementation under test: the built-in codec, or a library behind an adapter.

mod adapter;
mod builtin;

use crate::adapter::{Hello, Op, Output, Rejection};

pub use adapter::{Process, StartError};
pub use builtin::Builtin;

/// Something that can be asked.
pub trait Subject {
    /// What it says of itself.
    fn hello(&self) -> &Hello;

    /// Asks it. Never blocks for longer than its time limits.
    fn ask(&mut self, op: &Op) -> Answer;

    /// Asks it all `questions`, several at once where it takes them, and hands on each answer with
    /// the number of its question, in any order.
    fn ask_all(
        &mut self,
        questions: &mut dyn Iterator<Item = (usize, &Op)>,
        answered: &mut dyn FnMut(usize, Answer),
    ) {
        for (number, op) in questions {
            answered(number, self.ask(op));
        }
    }

    /// The last lines that it logged; empty if there are none.
    fn log(&self) -> String {
        String::new()
    }
}

/// What came of a question.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Answer {
    /// What was asked for.
    Ok(Output),
    /// The bytes or the packet are rejected.
    Rejected(Rejection),
    /// It is not offered, with the reason.
    Skipped(String),
    /// There was no answer in time.
    TimedOut(String),
    /// The adapter ended instead of answering.
    Crashed(String),
    /// The answer is none of the adapter protocol.
    Faulty(String),
    /// The adapter could not be started again to ask it.
    NotAsked(String),
}
