//! Choices that are drawn from the bytes of an input: the same input yields the same choices.

/// Pseudo-random numbers (the upper half of a linear congruential generator's state).
pub(crate) struct Draw(u64);

impl Draw {
    /// The numbers of an input.
    pub(crate) fn of(input: &[u8]) -> Self {
        let hash = |state, byte: &u8| step(state ^ u64::from(*byte));
        Self(input.iter().fold(input.len() as u64, hash))
    }

    /// A number less than `end`, which is not 0.
    pub(crate) fn below(&mut self, end: usize) -> usize {
        self.0 = step(self.0);
        let upper = usize::try_from(self.0 >> 32).unwrap_or_default();
        upper % end
    }
}

fn step(state: u64) -> u64 {
    state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407)
}
