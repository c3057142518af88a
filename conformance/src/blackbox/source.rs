//! Where probes come from, and what their answers are judged by.

use proptest::strategy::{BoxedStrategy, Strategy, ValueTree};
use proptest::test_runner::TestRunner;

use super::finding::Failure;
use super::probe::{self, Probe};
use super::{Asks, Options, Scope};
use crate::adapter::{Output, Question};
use crate::subject::Answer;
use crate::suite::Author;
use crate::suite::check::Check;
use crate::suite::random::runner;

/// Where probes come from.
pub(super) struct Source<'a> {
    scope: &'a Scope<'a>,
    strategy: BoxedStrategy<Vec<Probe>>,
    runner: TestRunner,
    seed: u64,
    drawn: u64,
}

impl<'a> Source<'a> {
    /// `None` if the subject offers nothing to ask.
    pub(super) fn new(scope: &'a Scope<'a>, options: &Options<'_>) -> Option<Self> {
        let (Author { spec, wire }, seed) = (scope.author, options.seed);
        let strategy = match options.asks {
            Asks::Codec => probe::strategy(spec, wire, scope.hello)?,
            Asks::Host => probe::conversations(spec, wire, scope.hello)?,
            Asks::Device(target, allowed) => probe::requests(scope.author, target, allowed)?,
        };
        Some(Self { scope, strategy, runner: runner(seed), seed, drawn: 0 })
    }

    /// The id of the next probe.
    pub(super) fn next_id(&self) -> String {
        self.id(self.drawn)
    }

    fn id(&self, number: u64) -> String {
        format!("{}.fuzz-{}.{number}", self.scope.author.wire, self.seed)
    }

    /// Draws probes that are best asked in a row. Those that are not `wanted` are dropped, and those
    /// whose right answer the documents leave unspecified.
    pub(super) fn draw(&mut self, wanted: impl Fn(&Probe) -> bool) -> Vec<Drawn> {
        // A strategy without filters always yields a value.
        let tree = self.strategy.new_tree(&mut self.runner);
        let probes = tree.map(|tree| tree.current()).unwrap_or_default();
        let mut row = Vec::new();
        for probe in probes {
            let number = self.drawn;
            self.drawn += 1;
            let id = self.id(number);
            if !wanted(&probe) {
                continue;
            }
            let check = |probe| Some((self.scope.check(&probe, id.clone())?, probe));
            let beginnings = probe.beginnings().into_iter().filter_map(check);
            let mut beginnings: Vec<_> =
                beginnings.map(|(check, probe)| Beginning { probe, check }).collect();
            // The last one is the whole, or as much of it as can be judged.
            if let Some(Beginning { probe, check }) = beginnings.pop() {
                row.push(Drawn { number, probe, check, beginnings });
            }
        }
        row
    }
}

/// A probe and its check.
#[derive(Clone, Debug)]
pub(super) struct Drawn {
    /// Its place among the probes drawn.
    pub(super) number: u64,
    pub(super) probe: Probe,
    pub(super) check: Check,
    /// The beginnings of a conversation, which are judged before the whole.
    pub(super) beginnings: Vec<Beginning>,
}

/// The beginning of a conversation, as a probe of its own.
#[derive(Clone, Debug)]
pub(super) struct Beginning {
    probe: Probe,
    check: Check,
}

impl Drawn {
    /// The same without its beginnings, which nobody needs once it is judged.
    pub(super) fn whole(&self) -> Self {
        let (probe, check) = (self.probe.clone(), self.check.clone());
        Self { probe, check, number: self.number, beginnings: Vec::new() }
    }

    /// The first failure that an answer shows, and what it is a failure of.
    pub(super) fn failure(&self, answer: Answer) -> Option<(Self, Failure)> {
        let failed = |Beginning { probe, check }: &Beginning| {
            let failure = Failure::of(check, beginning(&answer, check)?)?;
            let (probe, check) = (probe.clone(), check.clone());
            Some((Self { probe, check, beginnings: Vec::new(), ..*self }, failure))
        };
        let early = self.beginnings.iter().find_map(failed);
        early.or_else(|| Some((self.clone(), Failure::of(&self.check, answer)?)))
    }
}

/// What came of the first calls of a conversation.
fn beginning(answer: &Answer, check: &Check) -> Option<Answer> {
    let Answer::Ok(output) = answer else { return None };
    Some(Answer::Ok(match (output, &check.question) {
        (Output::Conversation(courses), Question::Converse { steps, .. }) => {
            Output::Conversation(courses.get(..steps.len())?.to_vec())
        }
        (Output::Line(heard), Question::Device { steps, .. }) => {
            Output::Line(heard.get(..steps.len())?.to_vec())
        }
        _ => return None,
    }))
}
