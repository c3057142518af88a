use super::{Range, Row, Unit};

/// What a register's value means while a condition holds, where that is not what it means else.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meaning {
    /// When it holds.
    pub when: Condition,
    /// The values that the register then may have; the usual ones if `None`.
    pub range: Option<Range>,
    /// What one count then is; the usual one if `None`.
    pub unit: Option<Unit>,
}

/// What another register has to hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Condition {
    /// The register's address.
    pub address: u16,
    /// The lowest bit that counts, from 0.
    pub lowest: u16,
    /// How many bits count.
    pub width: u16,
    /// The values of these bits, shifted down to bit 0, for which the condition holds.
    pub one_of: &'static [i64],
    /// All that in words: `Operating Mode is Extended Position Control Mode`.
    pub words: &'static str,
}

impl Condition {
    /// Whether it holds. `held` tells what the register at an address holds; a condition on a
    /// register of which it tells `None` does not hold.
    #[must_use]
    pub fn holds(&self, held: impl Fn(u16) -> Option<i64>) -> bool {
        held(self.address).is_some_and(|value| {
            let ones = 1_i64.checked_shl(self.width.into()).map_or(-1, |end| end - 1);
            let part = value.checked_shr(self.lowest.into()).unwrap_or_default() & ones;
            self.one_of.contains(&part)
        })
    }
}

impl Row {
    /// The values that the register may have while other registers hold what `held` tells.
    #[must_use]
    pub fn range_while(&self, held: impl Fn(u16) -> Option<i64>) -> Range {
        self.meaning(held).and_then(|meaning| meaning.range).unwrap_or(self.range)
    }

    /// What one count is while other registers hold what `held` tells.
    ///
    /// ```
    /// use actucheck_codec::ja40;
    /// let velocity = ja40::PROFILE_VELOCITY.row;
    /// assert_eq!(velocity.unit_while(|_| None).map(|unit| unit.symbol), Some("rev/min"));
    /// let held = |address| (address == 10).then_some(0b100); // Drive Mode: time-based profile
    /// assert_eq!(velocity.unit_while(held).map(|unit| unit.symbol), Some("ms"));
    /// ```
    #[must_use]
    pub fn unit_while(&self, held: impl Fn(u16) -> Option<i64>) -> Option<Unit> {
        self.meaning(held).and_then(|meaning| meaning.unit).or(self.unit)
    }

    fn meaning(&self, held: impl Fn(u16) -> Option<i64>) -> Option<&'static Meaning> {
        self.meanings.iter().find(|meaning| meaning.when.holds(&held))
    }
}
