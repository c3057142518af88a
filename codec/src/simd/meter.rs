//! Counts the bytes that the parser looks at, for tests of its cost; without the feature `meter`
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

    // A counter a thread, as the tests run side by side.
    std::thread_local! {
        static TOTAL: Cell<usize> = const { Cell::new(0) };
    }

    pub(crate) fn add(bytes: usize) {
        TOTAL.set(TOTAL.get() + bytes);
    }

    /// The bytes that the parsers of this thread have looked at so far; those looked at twice
    /// count twice.
    #[must_use]
    pub fn total() -> usize {
        TOTAL.get()
    }
}
