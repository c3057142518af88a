//! Counts the bytes that the parser looks at, for the tests of its cost; nothing otherwise.

#[cfg(not(test))]
#[inline]
pub(super) fn add(_bytes: usize) {}

#[cfg(test)]
pub(super) use counting::{add, total};

#[cfg(test)]
mod counting {
    use core::cell::Cell;

    // A counter a thread, as the tests run side by side.
    std::thread_local! {
        static TOTAL: Cell<usize> = const { Cell::new(0) };
    }

    pub(in super::super) fn add(bytes: usize) {
        TOTAL.set(TOTAL.get() + bytes);
    }

    /// All that was added in this thread.
    pub(in super::super) fn total() -> usize {
        TOTAL.get()
    }
}
