//! Bugs for the fuzz targets to find, one at a time. No build has them but one with
//! `--cfg planted`, where the environment variable `PLANTED` names the one that is there.

/// The last expression; if the bug of this name is planted, the one before it.
macro_rules! planted {
    ($bug:literal, $wrong:expr, $right:expr) => {{
        #[cfg(planted)]
        let value = if crate::planted::is($bug) { $wrong } else { $right };
        #[cfg(not(planted))]
        let value = $right;
        value
    }};
}

#[cfg(planted)]
pub(crate) fn is(bug: &str) -> bool {
    static CHOSEN: std::sync::OnceLock<std::ffi::OsString> = std::sync::OnceLock::new();
    *CHOSEN.get_or_init(|| std::env::var_os("PLANTED").unwrap_or_default()) == *bug
}
