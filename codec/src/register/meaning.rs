use super::{Range, Row, Unit};

/// The range and unit of a register while a condition holds, where they differ from its usual ones.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meaning {
    /// When it holds.
    pub when: Condition,
    /// The values that the register then may have; the usual ones if `None`.
    pub range: Option<Range>,
    /// What one count then is; the usual one if `None`.
    pub unit: Option<Unit>,
}

/// A condition on the value of another register.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Condition {
    /// The register's address.
    pub address: u16,
    /// The lowest bit that is compared, from 0.
    pub lowest: u16,
    /// The number of bits that are compared; 64 for the whole value with its sign.
    pub width: u16,
    /// The values of these bits, shifted down to bit 0, for which the condition holds.
    pub one_of: &'static [i64],
    /// The condition in words: `Operating Mode is Extended Position Control Mode`.
    pub words: &'static str,
}

impl Condition {
    /// Whether the condition holds. `held` returns the value of the register at an address; if it
    /// returns `None`, the condition does not hold.
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
    /// The values that the register may have while other registers have the values that `held`
    /// returns.
    #[must_use]
    pub fn range_while(&self, held: impl Fn(u16) -> Option<i64>) -> Range {
        self.meaning(held).and_then(|meaning| meaning.range).unwrap_or(self.range)
    }

    /// The physical value of one count while other registers have the values that `held` returns.
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
