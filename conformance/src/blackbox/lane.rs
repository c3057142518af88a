//! One process of the subject, with the probes that it is asked.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use super::finding::{Failure, refusal};
use super::source::Drawn;
use crate::adapter::Question;
use crate::subject::{Answer, Questions, Subject};

/// How many earlier probes are remembered, in case a failure depends on them.
const MEMORY: usize = 256;

/// A process of the subject.
pub(super) struct Lane<'s> {
    pub(super) subject: &'s mut (dyn Subject + Send),
    /// What it was asked before this batch, since it was started.
    before: Vec<Drawn>,
    /// Its part of the batch.
    dealt: Vec<Drawn>,
    answers: Vec<(usize, Heard)>,
    /// Whether it was asked something else since the batch, to examine a failure.
    pub(super) is_examined: bool,
}

/// What an answer means.
pub(super) enum Heard {
    /// It is right.
    Right,
    /// It is wrong, in this part of the probe.
    Wrong(Box<(Drawn, Failure)>),
    /// The question was skipped, for this reason.
    Skipped(String),
    /// The subject can't be asked any more, for this reason.
    Lost(String),
}

/// What all lanes share while a batch is asked.
pub(super) struct Shared<'a> {
    /// How many probes were asked.
    pub(super) asked: AtomicU64,
    /// Whether the time is over.
    pub(super) over: AtomicBool,
    /// Is told the number of probes asked; it says if the time is over.
    pub(super) watch: &'a (dyn Fn(u64) -> ControlFlow<()> + Sync),
}

impl<'s> Lane<'s> {
    pub(super) fn new(subject: &'s mut (dyn Subject + Send)) -> Self {
        let (before, dealt, answers) = (Vec::new(), Vec::new(), Vec::new());
        Self { subject, before, dealt, answers, is_examined: false }
    }

    /// Adds probes to its part of the batch.
    pub(super) fn deal(&mut self, probes: Vec<Drawn>) {
        self.dealt.extend(probes);
    }

    /// Asks its part of the batch.
    pub(super) fn ask(&mut self, shared: &Shared<'_>) {
        let mut asking = Asking { dealt: &self.dealt, next: 0, answers: Vec::new(), shared };
        self.subject.ask_all(&mut asking);
        self.answers = asking.answers;
    }

    /// Takes what the answers to the batch mean, each with its probe's place.
    pub(super) fn take_answers(&mut self) -> Vec<(usize, Heard)> {
        std::mem::take(&mut self.answers)
    }

    /// The probe at a place of the batch.
    pub(super) fn probe(&self, place: usize) -> Option<&Drawn> {
        self.dealt.get(place)
    }

    /// What was asked before that place, as far as it is remembered.
    pub(super) fn before(&self, place: usize) -> Vec<Drawn> {
        let asked = self.before.iter().chain(self.dealt.iter().take(place));
        let forgotten = (self.before.len() + place).saturating_sub(MEMORY);
        asked.skip(forgotten).map(Drawn::whole).collect()
    }

    /// Ends the batch, on a fresh process if a failure was examined.
    pub(super) fn end_batch(&mut self) {
        self.before = if std::mem::take(&mut self.is_examined) {
            self.subject.restart();
            Vec::new()
        } else {
            self.before(self.dealt.len())
        };
        self.dealt.clear();
    }
}

/// A part of a batch that is being asked.
struct Asking<'a> {
    dealt: &'a [Drawn],
    next: usize,
    answers: Vec<(usize, Heard)>,
    shared: &'a Shared<'a>,
}

impl Questions for Asking<'_> {
    fn next(&mut self) -> Option<usize> {
        let place = self.next;
        self.next += 1;
        let goes_on = !self.shared.over.load(Ordering::Relaxed);
        (place < self.dealt.len() && goes_on).then_some(place)
    }

    fn question(&self, place: usize) -> Option<&Question> {
        self.dealt.get(place).map(|drawn| &drawn.check.question)
    }

    fn is_right(&self, place: usize, answer: &Answer) -> bool {
        self.dealt.get(place).is_some_and(|drawn| drawn.check.is_met(answer))
    }

    fn answered(&mut self, place: usize, answer: Answer) {
        let one = u64::from(!matches!(answer, Answer::NotAsked(_)));
        let asked = self.shared.asked.fetch_add(one, Ordering::Relaxed) + one;
        if (self.shared.watch)(asked).is_break() {
            self.shared.over.store(true, Ordering::Relaxed);
        }
        let Some(drawn) = self.dealt.get(place) else { return };
        let heard = match answer {
            // It was not awaited to the end.
            Answer::NotAsked(_) if self.shared.over.load(Ordering::Relaxed) => return,
            Answer::NotAsked(reason) => Heard::Lost(reason),
            Answer::Skipped(reason) => Heard::Skipped(reason),
            answer => {
                let refusal = refusal(&answer);
                let right = refusal.map_or(Heard::Right, Heard::Skipped);
                drawn.failure(answer).map_or(right, |failed| Heard::Wrong(Box::new(failed)))
            }
        };
        self.answers.push((place, heard));
    }
}
