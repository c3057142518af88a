//! Black-box fuzzing of an implementation through its adapter, to find failures that no check
//! foresees.
//!
//! Probes are generated from a seed, and the reference model gives the right answers. Each failure
//! is shrunk to the smallest question of its kind. The same seed finds the same failures.

mod finding;
mod probe;
mod wire;

use std::cell::Cell;
use std::collections::BTreeMap;
use std::ops::ControlFlow;

use actucheck_spec::Spec;
use proptest::strategy::{BoxedStrategy, Strategy, ValueTree};
use proptest::test_runner::TestRunner;

use self::finding::Failure;
use self::probe::Probe;
use crate::adapter::{Question, Wire};
use crate::subject::{Answer, Questions, Subject};
use crate::suite::Author;
use crate::suite::check::Check;
use crate::suite::random::runner;

pub use finding::{Finding, Kind, Symptom};

/// The number of probes that are generated before they are asked.
const BATCH: usize = 256;
/// The maximum number of shrinking steps for a failing probe.
const SHRINK: usize = 2_000;
/// The same for an adapter that hangs or ends, as each step takes long.
const SHRINK_SLOWLY: usize = 40;

/// The result of fuzzing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Fuzzed {
    /// How many probes were asked.
    pub asked: u64,
    /// The kinds of failure found, in the order in which they were found.
    pub findings: Vec<Finding>,
    /// Why fuzzing was given up, if it was.
    pub given_up: Option<String>,
}

/// Asks `subject` the probes generated from `seed`. Fuzzing ends after `cases` probes or when
/// `watch` breaks; `watch` is called with the number of probes asked and of kinds of failure found.
pub fn fuzz(
    spec: &Spec,
    wire: Wire,
    seed: u64,
    cases: u64,
    subject: &mut dyn Subject,
    watch: impl Fn(u64, usize) -> ControlFlow<()>,
) -> Fuzzed {
    let mut result = Fuzzed::default();
    let Some(strategy) = probe::strategy(wire, subject.hello()) else {
        result.given_up = Some(format!("the adapter offers no op of {}", wire.id()));
        return result;
    };
    let author = Author { spec, wire };
    let mut fuzzer =
        Fuzzer { author, seed, strategy, runner: runner(seed), drawn: 0, found: BTreeMap::new() };
    let over = Cell::new(false);
    while fuzzer.drawn < cases && result.given_up.is_none() && !over.get() {
        let mut batch = fuzzer.draw(cases);
        let before = result.asked;
        let mut go_on = |answered| {
            result.asked = before + answered;
            over.set(watch(result.asked, result.findings.len()).is_break());
        };
        for (number, failure) in ask(subject, &batch, &over, &mut go_on) {
            let failure = match failure {
                Ok(failure) => failure,
                Err(reason) => {
                    result.given_up = Some(reason);
                    break;
                }
            };
            let Some(probe) = batch.get_mut(number) else { continue };
            if fuzzer.is_new(&failure) {
                result.findings.push(shrink(&fuzzer.author, subject, probe, failure, &|| {
                    watch(result.asked, result.findings.len()).is_continue()
                }));
            }
        }
    }
    for finding in &mut result.findings {
        finding.times = fuzzer.found.get(&finding.kind).copied().unwrap_or(1);
    }
    result
}

struct Fuzzer<'a> {
    author: Author<'a>,
    seed: u64,
    strategy: BoxedStrategy<Probe>,
    runner: TestRunner,
    drawn: u64,
    /// How often each kind of failure occurred.
    found: BTreeMap<Kind, u64>,
}

/// A probe that can be shrunk, and its current check.
struct Drawn {
    tree: Box<dyn ValueTree<Value = Probe>>,
    check: Check,
}

impl Fuzzer<'_> {
    /// Generates a batch of probes. Those whose right answer the documents leave unspecified are
    /// dropped.
    fn draw(&mut self, cases: u64) -> Vec<Drawn> {
        let mut batch = Vec::new();
        while batch.len() < BATCH && self.drawn < cases {
            let number = self.drawn;
            self.drawn += 1;
            // A strategy without filters always yields a value.
            let Ok(tree) = self.strategy.new_tree(&mut self.runner) else { continue };
            let id = format!("{}.fuzz-{}.{number}", self.author.wire.id(), self.seed);
            if let Some(check) = tree.current().check(&self.author, id) {
                batch.push(Drawn { tree, check });
            }
        }
        batch
    }

    /// Counts a failure. Returns whether it is the first of its kind.
    fn is_new(&mut self, failure: &Failure) -> bool {
        let times = self.found.entry(failure.kind.clone()).or_default();
        *times += 1;
        *times == 1
    }
}

/// Asks a batch. Returns its failures in order, or an error if the subject can't be asked any more.
/// `watch` is called with the number of answers until the time is `over`.
fn ask(
    subject: &mut dyn Subject,
    batch: &[Drawn],
    over: &Cell<bool>,
    watch: &mut dyn FnMut(u64),
) -> Vec<(usize, Result<Failure, String>)> {
    let mut asking = Asking { batch, next: 0, answered: 0, failures: Vec::new(), over, watch };
    subject.ask_all(&mut asking);
    let mut failures = asking.failures;
    failures.sort_by_key(|(number, _)| *number);
    failures
}

/// A batch that is being asked.
struct Asking<'a> {
    batch: &'a [Drawn],
    next: usize,
    answered: u64,
    failures: Vec<(usize, Result<Failure, String>)>,
    over: &'a Cell<bool>,
    watch: &'a mut dyn FnMut(u64),
}

impl Questions for Asking<'_> {
    fn next(&mut self) -> Option<usize> {
        let number = self.next;
        self.next += 1;
        (number < self.batch.len() && !self.over.get()).then_some(number)
    }

    fn question(&self, number: usize) -> Option<&Question> {
        self.batch.get(number).map(|drawn| &drawn.check.question)
    }

    fn answered(&mut self, number: usize, answer: Answer) {
        self.answered += 1;
        (self.watch)(self.answered);
        let Some(drawn) = self.batch.get(number) else { return };
        match answer {
            Answer::NotAsked(reason) => self.failures.push((number, Err(reason))),
            answer => {
                let failure = Failure::of(&drawn.check, answer);
                self.failures.extend(failure.map(|failure| (number, Ok(failure))));
            }
        }
    }
}

/// Shrinks a failing probe while it fails in the same way and there is time.
fn shrink(
    author: &Author<'_>,
    subject: &mut dyn Subject,
    drawn: &mut Drawn,
    failure: Failure,
    goes_on: &dyn Fn() -> bool,
) -> Finding {
    let patience = if failure.kind.is_slow() { SHRINK_SLOWLY } else { SHRINK };
    let id = drawn.check.id.clone();
    let mut smallest = Finding {
        kind: failure.kind,
        check: drawn.check.clone(),
        outcome: failure.outcome,
        times: 1,
    };
    let mut smaller = drawn.tree.simplify();
    for _ in 0..patience {
        if !smaller || !goes_on() {
            break;
        }
        let check = drawn.tree.current().check(author, id.clone());
        let failure =
            check.as_ref().and_then(|check| Failure::of(check, subject.ask(&check.question)));
        smaller = match (check, failure) {
            (Some(check), Some(failure)) if failure.kind == smallest.kind => {
                smallest = Finding { check, outcome: failure.outcome, ..smallest };
                drawn.tree.simplify()
            }
            _ => drawn.tree.complicate(),
        };
    }
    smallest
}
