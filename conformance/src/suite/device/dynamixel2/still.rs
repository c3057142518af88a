//! What comes before torque is switched on, so that the shaft stays where it is: no document says that a goal from
//! before is forgotten.

use super::written::Step;
use super::{Talk, asked, write};
use crate::adapter::{Asked, Bits, Sum};
use crate::suite::wanted::{Like, Part};

/// Operating Modes that go to a goal, and hold there: by position, over several turns, and with a current.
const POSITIONS: [u64; 3] = [3, 4, 5];

impl Talk<'_> {
    /// The steps before torque is switched on, of which the first is at this place of its conversation: the shaft must
    /// be in its first turn, as some modes forget turns then, and the goal is set to where it is.
    pub(super) fn still(&self, place: usize) -> Option<[Step; 3]> {
        let [mode, position] =
            ["Operating Mode", "Present Position"].map(|name| self.register(name));
        let counts =
            self.target.device?.counts_per_turn.filter(|counts| counts.is_power_of_two())?;
        let lowest = u8::try_from(counts.trailing_zeros()).ok()?;
        let turns = (lowest, 32_u8.checked_sub(lowest)?);
        Some([
            self.given(
                mode?,
                "an Operating Mode that goes to positions",
                (0, 8),
                POSITIONS.to_vec(),
            ),
            self.given(position?, "a shaft in its first turn", turns, vec![0]),
            self.goal_here(place + 1)?,
        ])
    }

    /// The goal is set to where the shaft is, as a step has told it. A device that does not take it is not asked what
    /// comes next.
    pub(super) fn goal_here(&self, told: usize) -> Option<Step> {
        let [goal, position] =
            ["Goal Position", "Present Position"].map(|name| self.register(name));
        let (id, address) = (self.id(), goal.filter(|goal| goal.kind.size() == 4)?.address);
        position.filter(|position| position.kind.size() == 4)?;
        let done = Bits { lowest: 0, width: 0, one_of: vec![0] };
        let what = "a goal that it takes while torque is off".to_owned();
        let given = Part::Given { what, size: 0, has: done.clone() };
        let answer = Like { id, error: None, data: Some(vec![given]) };
        let step = asked(write(id, address, &[0; 4]), 1);
        let sum = Some(Sum { id, address, step: told, by: 0 });
        Some((Asked { sum, only_if: Some(done), ..step }, vec![vec![answer]]))
    }
}
