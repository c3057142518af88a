//! Progress.

use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

/// A progress bar. It appears only on a terminal, after one second. Without a length it is a
/// spinner.
pub(crate) fn progress(length: Option<u64>, template: &str) -> ProgressBar {
    let bar = length.map_or_else(ProgressBar::no_length, ProgressBar::new);
    // If indicatif does not accept the template, the bar keeps its default style.
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style);
    }
    bar.enable_steady_tick(Duration::from_secs(1));
    bar
}
