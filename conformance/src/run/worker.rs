//! A worker: takes batches of checks, asks its subject, and returns the outcomes.

use std::collections::{HashMap, VecDeque};
use std::time::{Duration, Instant};

use super::{Work, lock};
use crate::adapter::{Hello, Question};
use crate::subject::{Answer, Questions, Subject};
use crate::suite::check::Check;
use crate::verdict::{Because, Outcome, Verdict};

/// How long outcomes may be held back while more arrive.
const PATIENCE: Duration = Duration::from_millis(50);

/// The questions of one subject.
pub(super) struct Worker<'r, 's, 'a> {
    work: &'r Work<'s, 'a>,
    hello: Hello,
    /// Batches with unanswered questions.
    batches: VecDeque<Batch>,
    /// The number of the next question.
    next: usize,
    /// The number of the first question that is not loaded yet.
    end: usize,
    flushed: Instant,
}

/// Checks that were taken together: a batch.
struct Batch {
    number: u64,
    /// The number of its first question.
    first: usize,
    slots: Vec<Slot>,
    /// How many outcomes were returned.
    given: usize,
}

struct Slot {
    state: State,
    /// The place in the batch of the check that it requires.
    requires: Option<usize>,
    /// The adapter does not offer it, so it says nothing about the checks that require it.
    not_offered: bool,
}

enum State {
    Open(Check),
    Answered(Outcome),
    Given(Past),
}

/// What of an outcome matters to the checks that require it.
enum Past {
    /// The subject skipped it.
    Skipped,
    Failed(Verdict, Because),
    Other,
}

const REQUIRED_SKIPPED: &str = "the check that it requires is skipped too";

impl Slot {
    /// Whether the subject skipped it, as far as is known.
    const fn is_skipped(&self) -> bool {
        match &self.state {
            State::Open(_) => false,
            State::Answered(outcome) => {
                matches!(outcome.verdict, Verdict::Skip) && !self.not_offered
            }
            State::Given(past) => matches!(past, Past::Skipped),
        }
    }
}

impl Past {
    fn of(outcome: &Outcome, not_offered: bool) -> Self {
        match outcome.verdict {
            Verdict::Skip if !not_offered => Self::Skipped,
            verdict if verdict.is_fine() => Self::Other,
            verdict => Self::Failed(verdict, outcome.cause()),
        }
    }
}

impl<'r, 's, 'a> Worker<'r, 's, 'a> {
    pub(super) fn new(work: &'r Work<'s, 'a>, hello: Hello) -> Self {
        let (batches, flushed) = (VecDeque::new(), Instant::now());
        Self { work, hello, batches, next: 0, end: 0, flushed }
    }

    /// Asks until no check is left.
    pub(super) fn ask(mut self, subject: &mut dyn Subject) {
        subject.ask_all(&mut self);
        self.flush();
    }

    /// Takes and builds the next batch. Returns whether there was one.
    fn load(&mut self) -> bool {
        self.flush();
        let (number, groups) = loop {
            let mut source = lock(&self.work.source);
            let number = source.next;
            if self.work.merge.is_over() {
                return false;
            }
            if self.work.merge.has_room(number) {
                break (number, source.take());
            }
            drop(source);
            // The other workers may be waiting for this worker's answers.
            if !self.batches.is_empty() {
                return false;
            }
            self.work.merge.wait_for_room(number);
        };
        if groups.is_empty() {
            return false;
        }
        let mut slots = Vec::new();
        for group in groups {
            let checks = self.work.plan.build(group);
            let required = required(&checks, slots.len());
            let slot = |(check, requires)| Slot {
                state: State::Open(check),
                requires,
                not_offered: false,
            };
            slots.extend(checks.into_iter().zip(required).map(slot));
        }
        let first = self.end;
        self.end += slots.len();
        self.batches.push_back(Batch { number, first, slots, given: 0 });
        true
    }

    /// Returns the outcomes that have no unanswered question before them.
    fn flush(&mut self) {
        for batch in &mut self.batches {
            let outcomes = batch.take();
            let done = batch.given == batch.slots.len();
            if done || !outcomes.is_empty() {
                self.work.merge.put(batch.number, outcomes, done);
            }
        }
        self.batches.retain(|batch| batch.given < batch.slots.len());
        self.flushed = Instant::now();
    }

    fn slot(&self, number: usize) -> Option<&Slot> {
        let batch = self.batches.iter().rev().find(|batch| batch.first <= number)?;
        batch.slots.get(number - batch.first)
    }

    fn slot_mut(&mut self, number: usize) -> Option<&mut Slot> {
        let batch = self.batches.iter_mut().rev().find(|batch| batch.first <= number)?;
        batch.slots.get_mut(number - batch.first)
    }

    /// Whether the question must be asked; if not, its answer is set.
    fn is_asked(&mut self, number: usize) -> bool {
        let Some(Slot { state: State::Open(check), .. }) = self.slot(number) else { return false };
        let not_offered = not_offered(&self.hello, check);
        let offered = not_offered.is_none();
        let skipped = || self.is_required_skipped(number).then(|| REQUIRED_SKIPPED.to_owned());
        let Some(reason) = not_offered.or_else(skipped) else { return true };
        if let Some(slot) = self.slot_mut(number) {
            slot.not_offered = !offered;
        }
        self.answered(number, Answer::Skipped(reason));
        false
    }

    /// Whether the subject skipped the check that this one requires, as far as is known.
    fn is_required_skipped(&self, number: usize) -> bool {
        let batch = self.batches.iter().rev().find(|batch| batch.first <= number);
        let required = batch.and_then(|batch| {
            let required = batch.slots.get(number - batch.first)?.requires?;
            batch.slots.get(required)
        });
        required.is_some_and(Slot::is_skipped)
    }
}

/// A panic is resumed in the thread that started the run, after the other workers ended.
impl Drop for Worker<'_, '_, '_> {
    fn drop(&mut self) {
        if std::thread::panicking() {
            self.work.merge.end();
        }
    }
}

impl Batch {
    /// Removes the outcomes that have no unanswered question before them.
    fn take(&mut self) -> Vec<Outcome> {
        let mut outcomes = Vec::new();
        while let Some((earlier, [slot, ..])) = self.slots.split_at_mut_checked(self.given)
            && matches!(slot.state, State::Answered(_))
        {
            let other = State::Given(Past::Other);
            if let State::Answered(mut outcome) = std::mem::replace(&mut slot.state, other) {
                let required = slot.requires.and_then(|place| earlier.get(place));
                if let Some(Slot { state: State::Given(past), .. }) = required {
                    follow(&mut outcome, past);
                }
                slot.state = State::Given(Past::of(&outcome, slot.not_offered));
                outcomes.push(outcome);
            }
            self.given += 1;
        }
        outcomes
    }
}

/// Lets an outcome follow from that of the check that it requires. While that one was outstanding,
/// this one was asked although the subject does not do such things.
fn follow(outcome: &mut Outcome, required: &Past) {
    match required {
        Past::Skipped if outcome.verdict != Verdict::Skip => {
            let Outcome { id, requirement, level, .. } = outcome;
            *outcome = Outcome {
                id: std::mem::take(id),
                requirement: std::mem::take(requirement),
                level: *level,
                verdict: Verdict::Skip,
                detail: REQUIRED_SKIPPED.to_owned(),
                because: None,
                reason: None,
                request: None,
                expected: None,
                actual: None,
                behaviour: None,
            };
        }
        Past::Failed(verdict, cause) if verdict.explains(outcome.verdict) => {
            outcome.because = Some(cause.clone());
        }
        _ => {}
    }
}

/// For each check of a group, the place in the batch of the check that it requires, if that comes
/// before it. `first` is the place of the first check.
fn required(checks: &[Check], first: usize) -> Vec<Option<usize>> {
    let mut places = HashMap::new();
    let requires = checks.iter().any(|check| check.requires.is_some());
    let place = |(place, check): (usize, &'_ Check)| {
        let earlier = check.requires.as_ref().and_then(|id| places.get(id.as_str()).copied());
        if requires {
            places.insert(check.id.clone(), first + place);
        }
        earlier
    };
    checks.iter().enumerate().map(place).collect()
}

impl Questions for Worker<'_, '_, '_> {
    fn next(&mut self) -> Option<usize> {
        while !self.work.merge.is_over() {
            if self.next < self.end {
                let number = self.next;
                self.next += 1;
                if self.is_asked(number) {
                    return Some(number);
                }
            } else if !self.load() {
                return None;
            }
        }
        None
    }

    fn question(&self, number: usize) -> Option<&Question> {
        match &self.slot(number)?.state {
            State::Open(check) => Some(&check.question),
            _ => None,
        }
    }

    fn answered(&mut self, number: usize, answer: Answer) {
        let Some(slot) = self.slot_mut(number) else { return };
        let State::Open(check) = std::mem::replace(&mut slot.state, State::Given(Past::Other))
        else {
            return;
        };
        let outcome = check.judge(answer);
        let failed = outcome.verdict.is_failure();
        slot.state = State::Answered(outcome);
        if failed || self.flushed.elapsed() > PATIENCE {
            self.flush();
        }
    }
}

/// Why a check is not asked, according to the adapter's answer to `hello`.
fn not_offered(hello: &Hello, check: &Check) -> Option<String> {
    let name = check.question.name();
    if !hello.ops.iter().any(|op| op == name) {
        return Some(format!("the adapter offers no {name}"));
    }
    let wire = check.question.wire();
    if !hello.wires.iter().any(|offered| offered == wire.id()) {
        return Some(format!("the adapter offers no {}", wire.id()));
    }
    if let Some(role) = check.question.role()
        && !hello.roles.contains(&role)
    {
        return Some(format!("only a {role} does this, and the adapter plays no {role}"));
    }
    let limit = match check.question {
        Question::Encode { .. } => hello.limits.send(),
        _ => hello.limits.receive(),
    };
    let limit = limit?;
    check.packet_over(limit).map(|size| format!("{size} bytes, the adapter's limit is {limit}"))
}
