//! A port in memory: what the line plays is known, and time is counted.

use std::collections::VecDeque;
use std::time::Duration;

use actucheck_spec::model::HexBytes;
use serde::Deserialize;
use serde_json::{Value, json};

/// How long a wait without a limit takes on a line that is silent: longer than any call may.
const FOR_EVER: Duration = Duration::from_hours(1);
/// Bytes sent in a call that are told. A host may send without an end.
const TOLD: usize = 64 * 1024;

/// What the line does in a call.
#[derive(Deserialize)]
pub(crate) struct Play {
    frame: HexBytes,
    answers: VecDeque<Vec<Burst>>,
    late: HexBytes,
    hurries: bool,
}

#[derive(Deserialize)]
struct Burst {
    after_ms: u64,
    bytes: HexBytes,
}

#[derive(Default)]
pub(crate) struct Memory {
    now: Duration,
    /// What comes, and when it is there.
    coming: Vec<(Duration, Vec<u8>)>,
    /// What is there.
    input: Vec<u8>,
    play: Option<Play>,
    /// When the call began.
    begun: Duration,
    /// What was sent in the call: all of it, and when it was how many bytes.
    sent: Vec<u8>,
    counts: Vec<(Duration, usize)>,
}

impl Memory {
    /// A call begins.
    pub(crate) fn begin(&mut self, play: Play) {
        self.play = Some(play);
        self.begun = self.now;
        self.sent.clear();
        self.counts.clear();
    }

    /// A call has ended. What was sent in it, and how long it took.
    pub(crate) fn end(&mut self) -> Value {
        let millis = |time: Duration| time.saturating_sub(self.begun).as_millis();
        let mut told = 0;
        let sent = self.counts.iter().map(|(at, count)| {
            let bytes = HexBytes(self.sent[told..*count].to_vec());
            told = *count;
            json!({"at_ms": millis(*at), "bytes": bytes})
        });
        let told = json!({"sent": sent.collect::<Vec<_>>(), "ms": millis(self.now)});
        if let Some(play) = self.play.take() {
            let last = self.coming.iter().map(|(at, _)| *at).max().filter(|_| !play.hurries);
            self.wait_until(last.unwrap_or_default());
            self.input.extend(play.late.0);
        }
        told
    }

    pub(crate) fn now(&self) -> Duration {
        self.now
    }

    /// Lets the time pass.
    pub(crate) fn wait_until(&mut self, time: Duration) {
        self.now = self.now.max(time);
        self.coming.sort_by_key(|(at, _)| *at);
        for (_, bytes) in self.coming.extract_if(.., |(at, _)| *at <= self.now) {
            self.input.extend(bytes);
        }
    }

    /// What there is; nothing at the end of the time.
    pub(crate) fn receive(&mut self, end: Option<Duration>) -> Vec<u8> {
        self.wait_until(self.now);
        let end = end.unwrap_or(self.now + FOR_EVER);
        if self.input.is_empty() {
            let next = self.coming.iter().map(|(at, _)| *at).min();
            self.wait_until(next.map_or(end, |next| next.min(end)));
        }
        std::mem::take(&mut self.input)
    }

    pub(crate) fn send(&mut self, bytes: &[u8]) {
        let Some(play) = &mut self.play else { return };
        for byte in bytes.iter().take(TOLD.saturating_sub(self.sent.len())) {
            self.sent.push(*byte);
            if self.sent.ends_with(&play.frame) {
                let bursts = play.answers.pop_front().unwrap_or_default();
                let at = |burst: &Burst| self.now + Duration::from_millis(burst.after_ms);
                self.coming.extend(bursts.into_iter().map(|burst| (at(&burst), burst.bytes.0)));
            }
        }
        if self.counts.last().is_none_or(|(_, count)| *count < self.sent.len()) {
            self.counts.push((self.now, self.sent.len()));
        }
    }
}
