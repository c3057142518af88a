//! What a run is going to send, and about how long that takes.

use std::time::Duration;

use actucheck::adapter::{Asked, Pause, Permissions, Question};
use actucheck::journal::Layout;
use actucheck::subject::device::SHORTEST_PAUSE;
use actucheck::suite::plan::Plan;

use super::super::shared::table;

/// Bits of a byte on a serial line, with start and stop.
const BITS: u64 = 10;
/// Bytes of an answer without data, and of a request for registers.
const ANSWER: usize = 11;
const REQUEST: usize = 14;
/// About how long an answer takes to begin, if none was timed: a device waits 0.5 ms when it leaves the
/// factory, and a port is not faster than that either.
pub(super) const BEGINS: Duration = Duration::from_millis(1);

/// How much some checks send, and what they wait for.
#[derive(Debug, Default)]
pub(super) struct Effort {
    checks: usize,
    packets: usize,
    sent: usize,
    /// Answers that are awaited, and about how many bytes they have.
    answers: usize,
    received: usize,
    pauses: Duration,
}

impl Effort {
    /// The checks of a plan that this is allowed for, and the looks at all registers of the device and its neighbour
    /// that come with writing.
    pub(super) fn of(
        plan: &Plan<'_>,
        allowed: &Permissions,
        layout: Option<&Layout>,
        beside: Option<&Layout>,
    ) -> Self {
        let mut effort = Self::default();
        for check in plan.checks() {
            let Question::Device { needs, neighbour, steps, .. } = &check.question else {
                continue;
            };
            if !needs.without(allowed).only_read() {
                continue;
            }
            effort.checks += 1;
            for step in steps {
                effort.step(step);
            }
            if let Some(layout) = layout.filter(|_| !needs.only_read()) {
                // One shows what differs from before, another that nothing does any more.
                effort.looks(layout, 2);
            }
            if let Some(layout) = beside.filter(|_| neighbour.is_some()) {
                effort.looks(layout, 2);
            }
        }
        effort
    }

    fn step(&mut self, step: &Asked) {
        self.packets += step.send.len();
        for piece in &step.send {
            self.sent += piece.bytes.len();
            self.pauses += match piece.after {
                Pause::None | Pause::Moment => Duration::ZERO,
                Pause::Answer => SHORTEST_PAUSE,
                Pause::Ms(ms) => Duration::from_millis(ms.into()),
            };
        }
        let call = step.packet.as_ref().and_then(|packet| packet.call.as_ref());
        let data = call.and_then(|call| call.length).unwrap_or_default();
        self.answers += step.awaits;
        self.received += step.awaits * (ANSWER + usize::from(data));
    }

    fn looks(&mut self, layout: &Layout, times: usize) {
        for (_, length) in &layout.read {
            self.packets += times;
            self.sent += times * REQUEST;
            self.answers += times;
            self.received += times * (ANSWER + usize::from(*length));
        }
    }

    /// About how long it takes at a rate in bit/s, if answers begin after such a time.
    fn takes(&self, baud: u32, begins: Duration) -> Duration {
        let bytes = u64::try_from(self.sent + self.received).unwrap_or(u64::MAX);
        let line = bytes.saturating_mul(BITS * 1_000_000) / u64::from(baud).max(1);
        let answers = u32::try_from(self.answers).unwrap_or(u32::MAX);
        Duration::from_micros(line) + begins.saturating_mul(answers) + self.pauses
    }

    /// What is sent, in a sentence.
    pub(super) fn sentence(&self) -> String {
        let Self { checks, packets, sent, .. } = self;
        format!(
            "checks that are asked: {checks}; packets and parts of packets: {packets}, with {sent} bytes"
        )
    }

    /// The same, and about how long it takes at a rate, if answers begin after such a time.
    pub(super) fn timed(&self, baud: u32, begins: Duration) -> String {
        let what = self.sentence();
        let seconds = self.takes(baud, begins).as_secs_f64();
        let ms = begins.as_secs_f64() * 1e3;
        format!("{what}; about {seconds:.1} s at {baud} bit/s, if answers begin after {ms:.1} ms")
    }
}

/// A line for each check, with what it needs and how much it sends.
pub(super) fn table(plan: &Plan<'_>) -> String {
    let mut rows = vec![["check", "needs", "packets", "bytes"].map(str::to_owned)];
    for check in plan.checks() {
        let Question::Device { needs, steps, .. } = &check.question else { continue };
        let pieces = steps.iter().flat_map(|step| &step.send);
        let size: usize = pieces.clone().map(|piece| piece.bytes.len()).sum();
        rows.push([check.id, needs.to_string(), pieces.count().to_string(), size.to_string()]);
    }
    table::lines("", &rows).join("\n")
}
