//! Counts the bytes that the parser examines, for tests of its cost. Without the feature `meter`
//! nothing is counted.

#[cfg(not(any(test, feature = "meter")))]
#[inline]
pub(crate) fn add(_bytes: usize) {}

#[cfg(any(test, feature = "meter"))]
pub(crate) use counting::add;
#[cfg(any(test, feature = "meter"))]
pub use counting::total;

#[cfg(any(test, feature = "meter"))]
mod counting {
    use core::cell::Cell;

    // One counter per thread, as the tests run in parallel.
    std::thread_local! {
        static TOTAL: Cell<usize> = const { Cell::new(0) };
    }

    pub(crate) fn add(bytes: usize) {
        TOTAL.set(TOTAL.get() + bytes);
    }

    /// The number of bytes that the parsers of this thread have examined so far; bytes examined
    /// twice count twice.
    #[must_use]
    pub fn total() -> usize {
        TOTAL.get()
    }
}
