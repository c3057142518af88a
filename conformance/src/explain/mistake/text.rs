//! Bytes that were sent as their digits.

use actucheck_spec::model::HexBytes;

use super::Mistake;

/// A packet whose bytes were written as text, and the text sent.
pub(super) const TEXT: Mistake = Mistake::of_line("text instead of bytes", |bytes, trials| {
    let text = str::from_utf8(bytes).ok().filter(|text| text.is_ascii());
    if let Some(meant) = text.and_then(|text| HexBytes::parse(text.trim()).ok()) {
        trials.packet(meant.0, || "each byte was sent as the text of its two digits".to_owned());
    }
});
