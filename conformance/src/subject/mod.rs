//! The subject that is judged: the built-in codec, or a library behind an adapter.

mod adapter;
mod builtin;
#[cfg(unix)]
mod host;

#[cfg(not(unix))]
use crate::adapter::conversation::{Conversation, Lost};
use crate::adapter::{Hello, Output, Question, Rejection};

pub use adapter::{Process, StartError};
pub use builtin::Builtin;
#[cfg(unix)]
pub(crate) use host::converse;

/// An implementation that can be asked.
pub trait Subject {
    /// What it says of itself.
    fn hello(&self) -> &Hello;

    /// Asks one question. Blocks no longer than the time limits.
    fn ask(&mut self, op: &Question) -> Answer;

    /// Asks for an op that no version of the adapter protocol has.
    fn ask_invented(&mut self) -> Answer {
        Answer::Skipped("there is no such op".to_owned())
    }

    /// Asks all `questions`, several at once if the subject takes them, and answers them in any
    /// order.
    fn ask_all(&mut self, questions: &mut dyn Questions) {
        while let Some(number) = questions.next() {
            let Some(op) = questions.question(number) else { continue };
            let answer = self.ask(op);
            questions.answered(number, answer);
        }
    }

    /// Another process of the same subject, which starts when it is asked; `None` if there are none,
    /// as its answers can't depend on what was asked before.
    fn another(&self) -> Option<Box<dyn Subject + Send>> {
        None
    }

    /// Begins anew, so that nothing that was asked before affects later answers.
    fn restart(&mut self) {}

    /// The last lines that it logged; may be empty.
    fn log(&self) -> String {
        String::new()
    }
}

/// A source of questions, which takes the answers.
pub trait Questions {
    /// The number of the next question; `None` if there is none, or if an outstanding question must
    /// be answered first.
    fn next(&mut self) -> Option<usize>;

    /// The question with this number; `None` if there is no such question without an answer.
    fn question(&self, number: usize) -> Option<&Question>;

    /// Takes the answer to the question with this number.
    fn answered(&mut self, number: usize, answer: Answer);

    /// The subject is asked the question with this number. Only subjects with
    /// [`Subject::another`] process say so.
    fn asked(&mut self, _number: usize) {}

    /// The subject ended, or was ended, and begins anew with the next question; `log` is the end of
    /// its error output. If an answer comes before that, its question is to blame.
    fn lost(&mut self, _log: String) {}
}

/// The answer to a question.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Answer {
    /// The result.
    Ok(Output),
    /// The bytes or the packet are rejected.
    Rejected(Rejection),
    /// The subject does not offer it, with the reason.
    Skipped(String),
    /// There was no answer in time.
    TimedOut(String),
    /// The adapter ended instead of answering.
    Crashed(String),
    /// The answer violates the adapter protocol.
    Faulty(String),
    /// The adapter could not be restarted to ask it, or the program was interrupted.
    NotAsked(String),
}

/// This system has no pseudo-terminals.
#[cfg(not(unix))]
pub(crate) fn converse(
    _: &mut Conversation,
    _: std::time::Duration,
    _: crate::adapter::Wire,
    _: &[crate::adapter::Step],
) -> Result<Answer, Lost> {
    Ok(Answer::Skipped("this system has no pseudo-terminals".to_owned()))
}
