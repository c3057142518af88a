//! Limits of YAML texts, which are checked before a text is read.
//!
//! The reader (libyaml) takes time that grows with the square of the nesting depth: minutes for 100
//! kB of brackets. It limits the expansion of aliases itself.

use saphyr_parser::{Event, Parser, ScanError};
use serde::de::IgnoredAny;

use super::{Defect, defect};

/// The longest text of a file of the spec folder in bytes, about twenty times the longest there is.
const MAX_SIZE: usize = 1 << 20;
/// The deepest nesting of lists and maps, about four times the model's own.
const MAX_DEPTH: usize = 32;

/// Walks through the text and checks the limits.
///
/// # Errors
/// The limit that the text exceeds, or why it is not YAML.
pub(super) fn check(text: &str) -> Result<(), Defect> {
    if text.len() > MAX_SIZE {
        let message =
            format!("{} bytes; at most {MAX_SIZE} are allowed: split the file", text.len());
        return Err(((1, 1), message));
    }
    depth(text)
}

/// Walks through a text of any size and checks its depth.
///
/// # Errors
/// As [`check`].
pub(super) fn depth(text: &str) -> Result<(), Defect> {
    let mut depth = 0;
    for event in Parser::new_from_str(text) {
        let (event, span) = event.map_err(|error| no_yaml(text, &error))?;
        match event {
            Event::SequenceStart(..) | Event::MappingStart(..) => depth += 1,
            Event::SequenceEnd | Event::MappingEnd => depth -= 1,
            _ => {}
        }
        if depth > MAX_DEPTH {
            let message = format!("lists and maps nest more than {MAX_DEPTH} deep");
            return Err(((span.start.line(), span.start.col() + 1), message));
        }
    }
    Ok(())
}

/// Uses libyaml's message, which says more, if libyaml stops at this place or before it. It is
/// given only the text up to there, as the rest may be too deep for it.
fn no_yaml(text: &str, error: &ScanError) -> Defect {
    let at = error.marker();
    let place = (at.line(), at.col() + 1);
    // Whether a colon is an indicator depends on the next character.
    let head: String = text.chars().take(at.index() + 2).collect();
    match serde_yaml::from_str::<IgnoredAny>(&head).map_err(|error| defect(&error)) {
        Err((other, message)) if other <= place => (other, message),
        _ => (place, error.info().to_owned()),
    }
}
