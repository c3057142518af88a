//! When and how the program was called, for reports.

use std::time::SystemTime;

use chrono::{DateTime, SecondsFormat, Utc};

/// The time now in UTC, as in RFC 3339. `SOURCE_DATE_EPOCH` replaces it, so that a report can be
/// made again byte for byte.
pub(crate) fn date() -> String {
    let fixed = std::env::var("SOURCE_DATE_EPOCH").ok();
    let fixed = fixed.and_then(|seconds| DateTime::from_timestamp(seconds.parse().ok()?, 0));
    let time: DateTime<Utc> = fixed.unwrap_or_else(|| SystemTime::now().into());
    time.to_rfc3339_opts(SecondsFormat::Secs, true)
}

/// The program's name and its arguments, quoted for a shell.
pub(crate) fn command_line() -> String {
    let arguments = std::env::args_os().skip(1);
    let arguments = arguments.map(|argument| argument.to_string_lossy().into_owned());
    let words: Vec<_> = std::iter::once("actucheck".to_owned()).chain(arguments).collect();
    // Only a NUL can't be quoted, and no argument has one.
    shlex::try_join(words.iter().map(String::as_str)).unwrap_or_default()
}
