use super::{Kind, RegisterError, Row};

/// The values that a register may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Range {
    /// Any that it can hold.
    Any,
    /// Those between two bounds, both included.
    Between {
        /// The smallest.
        min: Bound,
        /// The largest.
        max: Bound,
    },
    /// These.
    OneOf(&'static [i64]),
}

impl Range {
    /// Its smallest and its largest value, limited to the size of a register.
    fn bounds(self, kind: Kind, limits: impl Fn(u16) -> Option<i64>) -> (i64, i64) {
        let (smallest, largest) = kind.limits();
        let (min, max) = match self {
            Self::Any => (None, None),
            Self::Between { min, max } => (min.value(&limits), max.value(&limits)),
            Self::OneOf(values) => (values.iter().min().copied(), values.iter().max().copied()),
        };
        let min = min.map_or(smallest, |min| min.max(smallest));
        let max = max.map_or(largest, |max| max.min(largest));
        (min, max)
    }

    /// The register that holds the end which `value` is beyond, if one does.
    fn limit_beyond(self, value: i64, limits: impl Fn(u16) -> Option<i64>) -> Option<u16> {
        let Self::Between { min, max } = self else { return None };
        let broken = [
            min.value(&limits).is_some_and(|least| value < least).then_some(min),
            max.value(&limits).is_some_and(|most| value > most).then_some(max),
        ];
        broken.into_iter().flatten().find_map(|end| match end {
            Bound::Register { address, .. } => Some(address),
            Bound::Value(_) => None,
        })
    }
}

/// A bound of a range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bound {
    /// A number.
    Value(i64),
    /// The value of another register.
    Register {
        /// The register's address.
        address: u16,
        /// Whether the value is negated.
        negated: bool,
    },
}

impl Bound {
    fn value(self, limits: impl Fn(u16) -> Option<i64>) -> Option<i64> {
        match self {
            Self::Value(value) => Some(value),
            Self::Register { address, negated: false } => limits(address),
            Self::Register { address, negated: true } => limits(address).map(i64::saturating_neg),
        }
    }
}

impl Row {
    /// The smallest and the largest value that the register takes: those of its range, limited to
    /// its size, or those of its list. `limits` is as in [`Row::encode`]; it returns the registers
    /// of conditions too.
    ///
    /// ```
    /// use actucheck_codec::ja40;
    /// let goal = ja40::DEVICE.register_named("Goal Velocity").unwrap();
    /// assert_eq!(goal.bounds(|_| Some(2000)), (-2000, 2000)); // Velocity Limit
    /// assert_eq!(goal.bounds(|_| None), (i32::MIN.into(), i32::MAX.into()));
    /// ```
    #[must_use]
    pub fn bounds(&self, limits: impl Fn(u16) -> Option<i64>) -> (i64, i64) {
        self.range_while(&limits).bounds(self.kind, limits)
    }

    /// Checks that the register may have this value, even if hosts can't write it.
    ///
    /// # Errors
    /// If it may not; the error has the register's name and limits.
    pub fn check(
        &self,
        value: i64,
        limits: impl Fn(u16) -> Option<i64>,
    ) -> Result<(), RegisterError> {
        let register = self.name;
        let range = self.range_while(&limits);
        if let Range::OneOf(listed) = range
            && !listed.contains(&value)
        {
            return Err(RegisterError::NotListed { register, value, listed });
        }
        let (min, max) = range.bounds(self.kind, &limits);
        if (min..=max).contains(&value) {
            Ok(())
        } else {
            let limit = range.limit_beyond(value, limits);
            Err(RegisterError::OutOfRange { register, value, min, max, limit })
        }
    }
}
