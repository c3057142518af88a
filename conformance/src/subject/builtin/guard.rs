//! Keeps a panic of the codec from ending the program: it is a finding.

use std::cell::RefCell;
use std::panic::{self, AssertUnwindSafe, PanicHookInfo};
use std::sync::Once;

thread_local! {
    /// What panics here is kept instead of printed: the last one, with its place.
    static KEPT: RefCell<Option<String>> = const { RefCell::new(None) };
}

/// The result, or why there is none: what the panic says, and where it was.
pub(super) fn guarded<T>(ask: impl FnOnce() -> T) -> Result<T, String> {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        let others = panic::take_hook();
        panic::set_hook(Box::new(move |panic| {
            let is_guarded = KEPT
                .with_borrow_mut(|kept| kept.as_mut().map(|text| *text = said(panic)).is_some());
            if !is_guarded {
                others(panic);
            }
        }));
    });
    KEPT.set(Some(String::new()));
    // The codec keeps nothing between two questions, and the buffer is written before it is read.
    let result = panic::catch_unwind(AssertUnwindSafe(ask));
    let said = KEPT.take();
    result.map_err(|_| said.unwrap_or_default())
}

fn said(panic: &PanicHookInfo<'_>) -> String {
    let text = panic.payload_as_str().unwrap_or("it does not say why");
    let place = panic.location().map(ToString::to_string).unwrap_or_default();
    format!("{text} ({place})")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_kept_with_its_place() {
        assert_eq!(guarded(|| 1), Ok(1));
        let said = guarded(|| assert_eq!(1, 2, "oh no")).unwrap_err();
        assert!(said.contains("oh no") && said.contains("guard.rs:"), "{said}");
    }

    #[test]
    fn other_panics_are_not_kept() {
        let _ = guarded(|| 1);
        let outside = panic::catch_unwind(|| assert_eq!(1, 2, "told as usual"));
        assert!(outside.is_err());
        assert_eq!(KEPT.take(), None);
    }
}
