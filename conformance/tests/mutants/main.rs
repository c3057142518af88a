//! Implementations that are wrong in one way each, and the check that finds each of them. Several
//! are bugs of published libraries; most pass every packet that the documents print.

#![allow(clippy::unwrap_used, clippy::indexing_slicing)] // tests may stop at a surprise

mod blame;
mod dynamixel2;
mod fuzzed;
mod innfos;
mod killing;
mod stubs;

use actucheck::adapter::{Hello, Limits, Output, Question, Rejection, Wire};
use actucheck::subject::{Answer, Builtin, Subject};
use actucheck::suite;
use actucheck::suite::check::Check;
use actucheck_spec::Spec;
use actucheck_spec::model::{Fault, HexBytes};

/// An implementation that is wrong in one way.
struct Mutant {
    name: &'static str,
    /// The id of the requirement that it breaks. Empty if it breaks many.
    blames: &'static str,
    wrong: Wrong,
    /// A check that finds it.
    found_by: &'static str,
    /// Whether the packets that the documents print find it too.
    found_by_documents: bool,
}

/// What it does wrong.
enum Wrong {
    /// It gives this answer instead, if there is one.
    Answers(fn(&Question) -> Option<Output>),
    /// It rejects what it should accept.
    Rejects(fn(&Question) -> bool),
    /// It rejects everything after such a request.
    RejectsAfter(fn(&Question) -> bool),
}

impl Wrong {
    /// Its own answer to a question after the last one; `None` if it answers as the codec does.
    fn answer(&self, op: &Question, last: Option<&Question>) -> Option<Answer> {
        let rejection = || Answer::Rejected(Rejection { class: Fault::Crc, detail: String::new() });
        match self {
            Self::Answers(answer) => answer(op).map(Answer::Ok),
            Self::Rejects(rejects) => rejects(op).then(rejection),
            Self::RejectsAfter(after) => last.is_some_and(after).then(rejection),
        }
    }
}

fn bytes(bytes: Vec<u8>) -> Output {
    Output::Bytes(HexBytes(bytes))
}

/// The built-in codec with a mutant's answers where it has any.
struct Mutated {
    codec: Builtin,
    mutant: &'static Mutant,
    last: Option<Question>,
}

impl Mutated {
    fn new(mutant: &'static Mutant) -> Self {
        Self { codec: Builtin::default(), mutant, last: None }
    }
}

impl Subject for Mutated {
    fn hello(&self) -> &Hello {
        self.codec.hello()
    }

    fn ask(&mut self, op: &Question) -> Answer {
        let last = self.last.replace(op.clone());
        let own = self.mutant.wrong.answer(op, last.as_ref());
        own.unwrap_or_else(|| self.codec.ask(op))
    }

    fn restart(&mut self) {
        self.last = None;
    }
}

/// The limits that the checks are made for.
const LIMITS: Limits = Limits { max_packet: None, max_send: Some(3000), max_receive: Some(2000) };

fn checks(wire: Wire) -> Vec<Check> {
    let options = suite::Options { cases: 50, limits: LIMITS, ..suite::Options::new() };
    suite::plan(&Spec::embedded().unwrap(), &[wire], &options).checks().collect()
}
