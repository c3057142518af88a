//! What a whole stream has, in numbers.

use std::collections::BTreeMap;
use std::ptr;
use std::time::Duration;

use super::devices::Devices;
use super::{Event, Role, Skipped};

/// Counts over a stream.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Summary {
    /// Packets by the word for their kind, in the order of their first ones.
    pub packets: Vec<(&'static str, u64)>,
    /// Runs of bytes that are no packet, and their bytes, by reason.
    pub skipped: BTreeMap<String, (u64, u64)>,
    /// The devices that packets were for or from, each with its model number if it told it.
    pub devices: Devices,
    /// Warnings, by the id of the requirement.
    pub warnings: BTreeMap<&'static str, u64>,
    /// Echoes.
    pub echoes: u64,
    /// Packets that are not valid as answers to their requests.
    pub wrong: u64,
    /// Devices that did not answer a request.
    pub silent: u64,
    /// The times between requests and answers.
    pub answers: Answers,
}

/// Times to answer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Answers {
    /// How many answers have a time.
    pub count: u64,
    /// The shortest.
    pub shortest: Duration,
    /// The longest.
    pub longest: Duration,
    sum: Duration,
}

impl Answers {
    /// The average.
    #[must_use]
    pub fn average(&self) -> Duration {
        let nanos = self.sum.as_nanos().checked_div(self.count.into()).unwrap_or_default();
        Duration::from_nanos(u64::try_from(nanos).unwrap_or(u64::MAX))
    }

    fn add(&mut self, time: Duration) {
        self.shortest = if self.count == 0 { time } else { self.shortest.min(time) };
        self.longest = self.longest.max(time);
        self.sum = self.sum.saturating_add(time);
        self.count += 1;
    }
}

/// Reasons that are kept apart; more are counted together.
const REASONS: usize = 32;

impl Summary {
    /// Counts an event.
    pub fn add(&mut self, event: &Event<'_>) {
        match event {
            Event::Packet(_, turn) => {
                // There are few kinds: to look through them is quicker than a hash. Most are the same text at
                // the same place.
                let is_same = |kind: &str| ptr::eq(kind, turn.kind) || kind == turn.kind;
                match self.packets.iter_mut().find(|(kind, _)| is_same(kind)) {
                    Some((_, count)) => *count += 1,
                    None => self.packets.push((turn.kind, 1)),
                }
                self.wrong += u64::from(turn.wrong);
                let fast = turn.context.fast.as_ref().filter(|_| !turn.wrong);
                let several = fast.map_or(&[][..], |fast| &fast.ids);
                for device in turn.device.iter().chain(several) {
                    self.devices.see(*device, turn.model);
                }
                for warning in &turn.warnings {
                    *self.warnings.entry(warning.requirement).or_default() += 1;
                }
                match turn.role {
                    Role::Echo => self.echoes += 1,
                    Role::Answer { after: Some(after), .. } => self.answers.add(after),
                    _ => {}
                }
            }
            Event::Skipped(Skipped { count, reason, .. }) => {
                // What a reason says of single bytes does not matter here.
                let reason = reason.split(": ").next().unwrap_or_default();
                let known = self.skipped.len() < REASONS || self.skipped.contains_key(reason);
                let reason = if known { reason } else { "other reasons" };
                let (runs, bytes) = self.skipped.entry(reason.to_owned()).or_default();
                (*runs, *bytes) = (*runs + 1, *bytes + count);
            }
            Event::Silent(silent) => self.silent += silent.devices.len() as u64,
        }
    }

    /// How many packets there are.
    #[must_use]
    pub fn total(&self) -> u64 {
        self.packets.iter().map(|(_, count)| count).sum()
    }
}
