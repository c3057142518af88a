//! Whether the line of a host is served all the time.
//!
//! A machine may be so busy that the line gets no processor for a while, or that the kernel's thread gets
//! none that carries bytes through a terminal. No host can be blamed for what it misses then.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// The line is looked at each millisecond; a time-out that a machine may be too busy for is not much more
/// than so long.
const LATE: Duration = Duration::from_millis(5);
/// A host gets so many times its limit at most to make up for a line that is not served.
const MOST: u32 = 5;

/// When a line was looked at. Its clones are one: who asks need not be where the line is.
#[derive(Clone, Debug, Default)]
pub(super) struct Served(Arc<Mutex<Looks>>);

#[derive(Debug, Default)]
struct Looks {
    count: u32,
    last: Option<Instant>,
    /// All the time in which it was looked at too late.
    lost: Duration,
}

impl Looks {
    /// The time that is lost by now.
    fn lost(&self, now: Instant) -> Duration {
        let gap = self.last.map_or(Duration::ZERO, |last| now.saturating_duration_since(last));
        if gap > LATE { self.lost + gap } else { self.lost }
    }

    fn look(&mut self, now: Instant) {
        self.lost = self.lost(now);
        self.last = Some(now);
        self.count = self.count.saturating_add(1);
    }
}

impl Served {
    /// The line is looked at, and all that was written before has come through.
    pub(super) fn look(&self) {
        self.looked().look(Instant::now());
    }

    /// Whether the line is served.
    pub(super) fn has_begun(&self) -> bool {
        self.looked().last.is_some()
    }

    /// How often the line was looked at. A busy machine may look late, so that time tells less.
    pub(super) fn looks(&self) -> u32 {
        self.looked().count
    }

    /// For how long the line was not served so far. It grows while that lasts.
    pub(super) fn lost(&self) -> Duration {
        self.looked().lost(Instant::now())
    }

    /// How much longer than `limit` a host may take that was asked when so much was `lost`.
    pub(super) fn more(&self, limit: Duration, lost: Duration) -> Duration {
        self.lost().saturating_sub(lost).min(limit.saturating_mul(MOST))
    }

    fn looked(&self) -> MutexGuard<'_, Looks> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Looks so many milliseconds after the first one, and what is lost by a last time.
    fn lost(looks: &[u64], then: u64) -> Duration {
        let begin = Instant::now();
        let at = |ms: u64| begin + Duration::from_millis(ms);
        let mut looked = Looks::default();
        for ms in looks {
            looked.look(at(*ms));
        }
        looked.lost(at(then))
    }

    #[test]
    fn only_what_is_late_is_lost() {
        assert_eq!(lost(&[], 1000), Duration::ZERO);
        assert_eq!(lost(&[0, 1, 6, 7], 12), Duration::ZERO);
        assert_eq!(lost(&[0, 1, 31, 32], 33), Duration::from_millis(30));
        assert_eq!(lost(&[0, 20, 21, 41], 42), Duration::from_millis(40));
    }

    #[test]
    fn what_is_late_is_lost_while_it_lasts() {
        assert_eq!(lost(&[0, 1], 101), Duration::from_millis(100));
        assert_eq!(lost(&[0, 20], 40), Duration::from_millis(40));
    }

    #[test]
    fn a_host_gets_what_is_lost_and_no_more_than_that() {
        let (served, limit) = (Served::default(), Duration::from_millis(10));
        served.look();
        assert_eq!(served.more(limit, served.lost()), Duration::ZERO);
        served.looked().lost += Duration::from_millis(20);
        assert!(served.more(limit, Duration::ZERO) >= Duration::from_millis(20));
        served.looked().lost += Duration::from_hours(1);
        assert_eq!(served.more(limit, Duration::ZERO), limit * MOST);
    }
}
