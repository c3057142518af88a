//! What passed on the line to a device, and how long its answers took.

use std::collections::BTreeMap;
use std::time::Duration;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What passed on a device's line until a run's last check, with what restored the device after checks.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Traffic {
    /// How many packets and parts of packets were sent.
    pub pieces: usize,
    /// How many bytes were sent.
    pub sent: usize,
    /// How many bytes came.
    pub received: usize,
    /// How many of them came when nothing had asked for them.
    pub unasked: usize,
    /// How long answers took; `null` if none was timed.
    pub response: Option<Spread>,
    /// The same by the instruction that was answered, in the order of their names.
    pub by_instruction: Vec<Response>,
}

/// How long answers to an instruction took.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Response {
    /// The instruction's name.
    pub instruction: String,
    /// The times.
    #[serde(flatten)]
    pub spread: Spread,
}

/// How times are spread, in microseconds. A time is from when a packet was handed to the port until the
/// first byte of its answer came.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Spread {
    /// How many times there are, at least 1.
    pub count: usize,
    /// The shortest.
    pub least_us: u64,
    /// Half of them are no longer; too large by at most a part in 32.
    pub median_us: u64,
    /// 99 of 100 are no longer; too large by at most a part in 32.
    pub p99_us: u64,
    /// The longest.
    pub most_us: u64,
}

impl Spread {
    /// Whether the times are in their order.
    #[must_use]
    pub const fn is_ordered(&self) -> bool {
        let Self { count, least_us, median_us, p99_us, most_us } = *self;
        count > 0 && least_us <= median_us && median_us <= p99_us && p99_us <= most_us
    }
}

/// Counts times. Its memory does not grow with their number: times that differ by less than a part in 32
/// are counted together.
#[derive(Clone, Debug, Default)]
pub struct Times {
    /// How many times there are, by the longest that is counted with them, in microseconds.
    counts: BTreeMap<u64, usize>,
    /// The shortest and the longest.
    ends: Option<(u64, u64)>,
}

impl Times {
    /// Counts a time.
    pub fn add(&mut self, time: Duration) {
        let time = u64::try_from(time.as_micros()).unwrap_or(u64::MAX);
        let (least, most) = self.ends.unwrap_or((time, time));
        self.ends = Some((least.min(time), most.max(time)));
        *self.counts.entry(counted_as(time)).or_default() += 1;
    }

    /// The longest time; none if there is none.
    #[must_use]
    pub fn most(&self) -> Duration {
        Duration::from_micros(self.ends.map_or(0, |(_, most)| most))
    }

    /// How the times are spread; `None` if there are none.
    #[must_use]
    pub fn spread(&self) -> Option<Spread> {
        let (least_us, most_us) = self.ends?;
        let count = self.counts.values().sum();
        let within = |percent| self.within(percent, count).clamp(least_us, most_us);
        Some(Spread { count, least_us, median_us: within(50), p99_us: within(99), most_us })
    }

    /// So many of 100 times are no longer than this.
    fn within(&self, percent: usize, count: usize) -> u64 {
        let mut left = (count * percent).div_ceil(100);
        for (time, count) in &self.counts {
            left = left.saturating_sub(*count);
            if left == 0 {
                return *time;
            }
        }
        u64::MAX
    }
}

/// The longest time that is counted with a time: all bits after the first six are set.
const fn counted_as(time: u64) -> u64 {
    let bits = u64::BITS - time.leading_zeros();
    time | ((1 << bits.saturating_sub(6)) - 1)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::indexing_slicing)] // tests may stop at a surprise

    use proptest::prelude::*;

    use super::*;

    #[test]
    fn the_middle_and_the_end_of_a_hundred_times() {
        let mut times = Times::default();
        for time in 1..=60 {
            times.add(Duration::from_micros(time));
        }
        let spread = |count, median_us, p99_us, most_us| {
            Some(Spread { count, least_us: 1, median_us, p99_us, most_us })
        };
        assert_eq!(times.spread(), spread(60, 30, 60, 60));
        for _ in 0..40 {
            times.add(Duration::from_millis(1));
        }
        // 1,000 is 0b11_1110_1000; the longest of its six bits is 0b11_1110_1111.
        assert_eq!(times.spread(), spread(100, 50, 1000, 1000));
        times.add(Duration::from_millis(9));
        assert_eq!(times.spread(), spread(101, 51, 0b11_1110_1111, 9000));
        assert_eq!(times.most(), Duration::from_millis(9));
        assert_eq!(Times::default().spread(), None);
    }

    proptest! {
        #[test]
        fn a_share_of_times_is_at_most_a_part_in_32_too_large(
            mut all in prop::collection::vec(0..10_000_000_u64, 1..200)
        ) {
            let mut times = Times::default();
            for time in &all {
                times.add(Duration::from_micros(*time));
            }
            all.sort_unstable();
            let spread = times.spread().unwrap();
            prop_assert!(spread.is_ordered());
            for (percent, said) in [(50, spread.median_us), (99, spread.p99_us)] {
                let right = all[(all.len() * percent).div_ceil(100) - 1];
                prop_assert!(right <= said && said - right <= right / 32, "{right} {said}");
            }
        }
    }
}
