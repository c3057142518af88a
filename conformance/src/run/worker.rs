//! A worker: takes batches of checks, asks its subject, and returns the outcomes.

use std::collections::VecDeque;
use std::num::NonZeroU32;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use super::again::{Doubt, Lost};
use super::batch::{Batch, Past, REQUIRED_SKIPPED, Slot, State};
use super::history::History;
use super::merge::Judged;
use super::repeat::Heard;
use super::{Work, lock};
use crate::adapter::{Hello, Question};
use crate::legible::excerpt;
use crate::subject::{Answer, Questions, Subject};
use crate::suite::check::Check;
use crate::verdict::Verdict;

/// How long outcomes may be held back while more arrive.
const PATIENCE: Duration = Duration::from_millis(50);

/// The questions of one subject.
pub(super) struct Worker<'r, 's, 'a> {
    work: &'r Work<'s, 'a>,
    hello: Hello,
    /// How often each question is asked.
    times: NonZeroU32,
    /// What the subject was asked, if there is a second process to ask again.
    history: Option<Arc<Mutex<History>>>,
    /// When the last question was asked.
    asked: Instant,
    /// What the last loss of the subject cost; `None` if a question was asked since then.
    lost: Option<Lost>,
    /// Batches with unanswered questions.
    batches: VecDeque<Batch>,
    /// The number of the next question. Each place has as many numbers as it is asked.
    next: usize,
    /// The first place that is not loaded yet.
    end: usize,
    flushed: Instant,
}

impl<'r, 's, 'a> Worker<'r, 's, 'a> {
    /// A worker that asks each question so many `times` and remembers what it asked if `is_doubted`.
    pub(super) fn new(
        work: &'r Work<'s, 'a>,
        hello: Hello,
        times: NonZeroU32,
        is_doubted: bool,
    ) -> Self {
        let now = Instant::now();
        Self {
            work,
            hello,
            times,
            history: is_doubted.then(Arc::default),
            asked: now,
            lost: None,
            batches: VecDeque::new(),
            next: 0,
            end: 0,
            flushed: now,
        }
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
        let groups = groups.into_iter().map(|group| self.work.plan.build(group));
        let batch = Batch::new(number, self.end, groups, self.times);
        self.end += batch.slots.len();
        self.batches.push_back(batch);
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

    /// The place of the question with this number.
    fn place(&self, number: usize) -> usize {
        number / usize::try_from(self.times.get()).unwrap_or(usize::MAX)
    }

    fn batch(&self, place: usize) -> Option<&Batch> {
        self.batches.iter().rev().find(|batch| batch.first <= place)
    }

    fn slot(&self, place: usize) -> Option<&Slot> {
        let batch = self.batch(place)?;
        batch.slots.get(place - batch.first)
    }

    fn slot_mut(&mut self, place: usize) -> Option<&mut Slot> {
        let batch = self.batches.iter_mut().rev().find(|batch| batch.first <= place)?;
        batch.slots.get_mut(place - batch.first)
    }

    /// Whether the check must be asked; if not, its answer is set.
    fn is_asked(&mut self, place: usize) -> bool {
        let Some(Slot { state: State::Open(check, _), .. }) = self.slot(place) else {
            return false;
        };
        let not_offered = not_offered(&self.hello, check);
        let offered = not_offered.is_none();
        let skipped = || self.is_required_skipped(place).then(|| REQUIRED_SKIPPED.to_owned());
        let given_up = || self.work.merge.given_up(check).map(Answer::NotAsked);
        let answer = not_offered.or_else(skipped).map(Answer::Skipped).or_else(given_up);
        let Some(answer) = answer else { return true };
        if let Some(slot) = self.slot_mut(place) {
            slot.not_offered = !offered;
        }
        if let Some(check) = self.close(place) {
            let outcome = Arc::unwrap_or_clone(check).judge(answer);
            self.set(place, Judged { outcome, doubt: None });
        }
        false
    }

    /// Whether the subject skipped the check that this one requires, as far as is known.
    fn is_required_skipped(&self, place: usize) -> bool {
        let required = self.batch(place).and_then(|batch| {
            let required = batch.slots.get(place - batch.first)?.requires?;
            batch.slots.get(required)
        });
        required.is_some_and(Slot::is_skipped)
    }

    /// Takes an open check out of its slot.
    fn close(&mut self, place: usize) -> Option<Arc<Check>> {
        let slot = self.slot_mut(place)?;
        match std::mem::replace(&mut slot.state, State::Given(Past::Other)) {
            State::Open(check, _) => Some(check),
            other => {
                slot.state = other;
                None
            }
        }
    }

    /// Sets the outcome of a check. A failure is passed on at once. If it cost the subject, it is
    /// awaited that it was asked again, so that it is known what to give up.
    fn set(&mut self, place: usize, judged: Judged) {
        let failed = judged.outcome.verdict.is_failure();
        let lost = judged.doubt.as_ref().is_some_and(|doubt| doubt.lost.is_some());
        let batch = self.batch(place).map(|batch| batch.number);
        if let Some(slot) = self.slot_mut(place) {
            slot.state = State::Answered(Box::new(judged));
        }
        if failed || self.flushed.elapsed() > PATIENCE {
            self.flush();
        }
        if let Some(batch) = batch.filter(|_| lost) {
            self.work.merge.wait_for_turn(batch);
        }
    }

    /// What is needed to ask a question again that failed.
    fn doubt(&mut self, number: usize, check: Arc<Check>, lost: Option<Lost>) -> Doubt {
        let asked = self.history.as_ref().and_then(|history| {
            let mark = lock(history).mark(number)?;
            Some((Arc::clone(history), mark))
        });
        Doubt { check, asked, lost }
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

impl Questions for Worker<'_, '_, '_> {
    fn next(&mut self) -> Option<usize> {
        while !self.work.merge.is_over() {
            let place = self.place(self.next);
            if place < self.end {
                let number = self.next;
                self.next += 1;
                if self.is_asked(place) {
                    return Some(number);
                }
            } else if !self.load() {
                return None;
            }
        }
        None
    }

    fn is_right(&self, number: usize, answer: &Answer) -> bool {
        let state = self.slot(self.place(number)).map(|slot| &slot.state);
        matches!(state, Some(State::Open(check, _)) if check.is_met(answer))
    }

    fn question(&self, number: usize) -> Option<&Question> {
        match &self.slot(self.place(number))?.state {
            State::Open(check, _) => Some(&check.question),
            _ => None,
        }
    }

    fn answered(&mut self, number: usize, answer: Answer) {
        let place = self.place(number);
        let mut lost = self.lost.take();
        let is_process = self.history.is_some();
        let is_over = self.work.merge.is_over();
        let slot = self.slot_mut(place);
        let Some(Slot { state: State::Open(_, repeated), .. }) = slot else { return };
        let heard = match answer {
            // It was not awaited to the end: the check is left.
            Answer::NotAsked(_) if is_over => return,
            Answer::NotAsked(ref reason) => {
                lost = None;
                // The other processes would not start again either.
                if is_process {
                    self.work.merge.give_up(reason);
                }
                Heard::One(answer)
            }
            answer if lost.is_some() => Heard::One(answer),
            answer => match repeated.hear(answer) {
                Some(heard) => heard,
                None => return,
            },
        };
        let Some(check) = self.close(place) else { return };
        if lost.is_none() {
            self.work.merge.note_answer(&check);
        }
        let kept = (self.history.is_some() || lost.is_some()).then(|| Arc::clone(&check));
        let mut outcome = heard.judge(Arc::unwrap_or_clone(check));
        let is_doubtful = outcome.verdict.is_failure() && outcome.verdict != Verdict::Flaky;
        let log = lost.as_ref().map(|lost| excerpt(&lost.log));
        outcome.log = log.filter(|log| !log.is_empty() && is_doubtful);
        let doubt = kept.filter(|_| is_doubtful).map(|check| self.doubt(number, check, lost));
        self.set(place, Judged { outcome, doubt: doubt.map(Box::new) });
    }

    fn asked(&mut self, number: usize) {
        self.lost = None;
        self.asked = Instant::now();
        if let Some(history) = &self.history
            && let Some(Slot { state: State::Open(check, _), .. }) = self.slot(self.place(number))
        {
            lock(history).add(number, Arc::clone(check));
        }
    }

    fn lost(&mut self, log: String) {
        self.lost = Some(Lost { log, took: self.asked.elapsed() });
        if let Some(history) = &self.history {
            lock(history).begin_anew();
        }
    }
}

/// Why a check is not asked, according to the adapter's answer to `hello`.
pub(crate) fn not_offered(hello: &Hello, check: &Check) -> Option<String> {
    let name = check.question.name();
    // A call may be made in either way.
    let is_offered = hello.offers(name) || name == "call" && hello.offers("exchange");
    if !is_offered {
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
    if let (Question::Converse { steps, .. }, Some(offered)) = (&check.question, &hello.calls) {
        // A general call has no name of its own that `hello` could state.
        let calls = steps.iter().filter_map(|step| step.packet.call.as_ref());
        let mut calls = calls.filter(|call| !call.is_general).map(|call| call.name);
        let missing = calls.find(|name| !offered.iter().any(|call| call == name));
        return missing.map(|name| format!("the library has no {name}"));
    }
    let limit = match check.question {
        Question::Encode { .. } | Question::Converse { .. } => hello.limits.send(),
        _ => hello.limits.receive(),
    };
    let limit = limit?;
    check.packet_over(limit).map(|size| format!("{size} bytes, the adapter's limit is {limit}"))
}
