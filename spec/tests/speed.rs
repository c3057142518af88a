//! Reading and checking everything is fast enough to do on every start.

use std::io::{Write as _, stderr};
use std::time::{Duration, Instant};

use actucheck_spec::Spec;

/// Ten times the limit of a release build, so that a busy machine fails nothing.
const LIMIT: Duration = Duration::from_secs(1);

#[test]
fn the_spec_is_loaded_and_checked_at_once() {
    let fastest = (0..5).map(|_| {
        let start = Instant::now();
        assert!(Spec::embedded().is_ok(), "the spec has defects");
        start.elapsed()
    });
    let fastest = fastest.min().unwrap_or_default();
    // Written directly, as the test harness hides the output of a passing test.
    let mut out = stderr();
    let told = writeln!(out, "loading and checking the spec takes {fastest:.1?}");
    assert!(told.is_ok());
    assert!(fastest < LIMIT, "{fastest:?}");
}
