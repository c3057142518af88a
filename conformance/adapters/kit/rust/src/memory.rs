//! A port in memory, for libraries whose port is a trait or a few functions.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use serde::Deserialize;
use serde_json::{Value, json};

use crate::Hex;

/// How long a read without a time-out takes on a line that is silent: longer than any call may.
const FOR_EVER: Duration = Duration::from_hours(1);
/// The most bytes of a call that are told. A library may send without an end.
const TOLD: usize = 64 * 1024;

/// A port in memory. Its clones are one port: the library has one, and the loop over requests has another.
///
/// Time is counted, not waited: a read that finds nothing lets the clock go on until the next bytes are
/// there, or until its time-out.
#[derive(Clone, Debug, Default)]
pub struct Memory(Arc<Mutex<Line>>);

/// What the line does in a call: fields of the op `exchange`.
#[derive(Debug, Default, Deserialize)]
pub(crate) struct Play {
    frame: Hex,
    answers: VecDeque<Vec<Burst>>,
    late: Hex,
    hurries: bool,
}

#[derive(Debug, Deserialize)]
struct Burst {
    after_ms: u64,
    bytes: Hex,
}

#[derive(Debug, Default)]
struct Line {
    /// The time since the port was opened.
    now: Duration,
    /// Bytes that come, and when they are there.
    coming: Vec<(Duration, Vec<u8>)>,
    /// Bytes that are there.
    input: VecDeque<u8>,
    play: Play,
    /// When the call began.
    begun: Duration,
    /// What was sent in the call, and at which time it was how many bytes.
    sent: Vec<u8>,
    counts: Vec<(Duration, usize)>,
}

impl Memory {
    /// A port on which these bytes answer whatever is sent first.
    #[must_use]
    pub fn answering(bytes: &[u8]) -> Self {
        let memory = Self::default();
        let answer = vec![Burst { after_ms: 0, bytes: Hex(bytes.to_vec()) }];
        // Every byte ends an empty frame.
        memory.begin(Play { answers: [answer].into(), ..Play::default() });
        memory
    }

    /// What was sent since the call began.
    #[must_use]
    pub fn sent(&self) -> Vec<u8> {
        self.line().sent.clone()
    }

    /// The time since the port was opened.
    #[must_use]
    pub fn now(&self) -> Duration {
        self.line().now
    }

    /// Lets the clock go on.
    pub fn sleep(&self, time: Duration) {
        let mut line = self.line();
        let time = line.now.saturating_add(time);
        line.wait_until(time);
    }

    /// Sends bytes.
    pub fn write(&self, bytes: &[u8]) {
        let mut line = self.line();
        for byte in bytes.iter().take(TOLD.saturating_sub(line.sent.len())) {
            line.sent.push(*byte);
            if line.sent.ends_with(&line.play.frame) {
                let now = line.now;
                let answer = line.play.answers.pop_front().unwrap_or_default();
                let timed = answer.into_iter().map(|Burst { after_ms, bytes: Hex(bytes) }| {
                    (now.saturating_add(Duration::from_millis(after_ms)), bytes)
                });
                line.coming.extend(timed);
            }
        }
        let (now, count) = (line.now, line.sent.len());
        if line.counts.last().is_none_or(|(_, told)| *told < count) {
            line.counts.push((now, count));
        }
    }

    /// Reads what is there. Returns the number of bytes; 0 when nothing came until the time-out. Without
    /// one, that is after an hour.
    pub fn read(&self, buffer: &mut [u8], timeout: Option<Duration>) -> usize {
        let mut line = self.line();
        let now = line.now;
        line.wait_until(now);
        if line.input.is_empty() {
            let end = now.saturating_add(timeout.unwrap_or(FOR_EVER));
            let next = line.coming.iter().map(|(at, _)| *at).min();
            line.wait_until(next.map_or(end, |next| next.min(end)));
        }
        let count = buffer.len().min(line.input.len());
        for (place, byte) in buffer.iter_mut().zip(line.input.drain(..count)) {
            *place = byte;
        }
        count
    }

    /// The number of bytes that are there.
    #[must_use]
    pub fn waiting(&self) -> usize {
        let mut line = self.line();
        let now = line.now;
        line.wait_until(now);
        line.input.len()
    }

    /// Takes away the bytes that are there.
    pub fn clear(&self) {
        let mut line = self.line();
        let now = line.now;
        line.wait_until(now);
        line.input.clear();
    }

    /// A call begins, in which the line plays this.
    pub(crate) fn begin(&self, play: Play) {
        let mut line = self.line();
        line.play = play;
        line.begun = line.now;
        line.sent.clear();
        line.counts.clear();
    }

    /// The call has ended: what was sent in it, and how long it took.
    pub(crate) fn end(&self) -> Value {
        let mut line = self.line();
        let told = line.told();
        let Play { late, hurries, .. } = std::mem::take(&mut line.play);
        if !hurries {
            let last = line.coming.iter().map(|(at, _)| *at).max();
            line.wait_until(last.unwrap_or_default());
        }
        line.input.extend(late.0);
        told
    }

    fn line(&self) -> MutexGuard<'_, Line> {
        // A library that panics in a call leaves a line that is whole.
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Line {
    /// Lets the clock go on to a time, if it is not past it.
    fn wait_until(&mut self, time: Duration) {
        self.now = self.now.max(time);
        self.coming.sort_by_key(|(at, _)| *at);
        for (_, bytes) in self.coming.extract_if(.., |(at, _)| *at <= self.now) {
            self.input.extend(bytes);
        }
    }

    /// What was sent in the call, and how long it took so far.
    fn told(&self) -> Value {
        let ms = |time: Duration| {
            u64::try_from(time.saturating_sub(self.begun).as_millis()).unwrap_or(u64::MAX)
        };
        let mut told = 0;
        let sent = self.counts.iter().map(|(at, count)| {
            let bytes = Hex(self.sent.get(told..*count).unwrap_or_default().to_vec());
            told = *count;
            json!({ "at_ms": ms(*at), "bytes": bytes })
        });
        json!({ "sent": sent.collect::<Vec<_>>(), "ms": ms(self.now) })
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // tests may stop at a surprise

    use super::*;

    const SHORT: Option<Duration> = Some(Duration::from_millis(10));

    fn begun(play: &Value) -> Memory {
        let memory = Memory::default();
        memory.begin(serde_json::from_value(play.clone()).unwrap());
        memory
    }

    fn read(memory: &Memory, timeout: Option<Duration>) -> Vec<u8> {
        let mut buffer = [0; 16];
        let count = memory.read(&mut buffer, timeout);
        buffer.into_iter().take(count).collect()
    }

    #[test]
    fn what_answers_is_there_at_its_time() {
        let play = json!({
            "frame": "0102", "late": "ff", "hurries": false,
            "answers": [[{"after_ms": 4, "bytes": "0a"}, {"after_ms": 30, "bytes": "0b"}]],
        });
        let memory = begun(&play);
        memory.write(&[1]);
        assert_eq!((read(&memory, SHORT), memory.now().as_millis()), (vec![], 10));
        memory.write(&[2]);
        assert_eq!(memory.waiting(), 0);
        assert_eq!((read(&memory, SHORT), memory.now().as_millis()), (vec![10], 14));
        assert_eq!((read(&memory, SHORT), memory.now().as_millis()), (vec![], 24));
        let sent = json!([{"at_ms": 0, "bytes": "01"}, {"at_ms": 10, "bytes": "02"}]);
        assert_eq!(memory.end(), json!({"sent": sent, "ms": 24}));
        // The rest of the answer came after the call, and then what is late.
        assert_eq!((memory.now().as_millis(), memory.waiting()), (40, 2));
    }

    #[test]
    fn a_packet_has_an_answer_for_each_time_and_then_none() {
        let play = json!({
            "frame": "01", "late": "", "hurries": true,
            "answers": [[{"after_ms": 0, "bytes": "0a"}], [{"after_ms": 9, "bytes": "0b"}]],
        });
        let memory = begun(&play);
        memory.write(&[1, 1, 1]);
        assert_eq!(read(&memory, SHORT), [10]);
        // The next call finds what was on its way.
        memory.end();
        assert_eq!((memory.now().as_millis(), memory.waiting()), (0, 0));
        assert_eq!(read(&memory, None), [11]);
        assert_eq!((read(&memory, None), memory.now().as_secs()), (vec![], 3600));
    }
}
