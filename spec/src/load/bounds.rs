//! What no YAML text may exceed, looked at before it is read.
//!
//! The reader (libyaml) takes time that grows with the square of how deep brackets nest: minutes
//! for 100 kB of them. What aliases make of a text, it bounds itself.

use saphyr_parser::{Event, Parser, ScanError};
use serde::de::IgnoredAny;

use super::{Defect, defect};

/// The longest text in bytes, some twenty times the longest file of the spec folder.
const MAX_SIZE: usize = 1 << 20;
/// The deepest nesting of lists and maps, some four times the model's own.
const MAX_DEPTH: usize = 32;

/// Walks through the text, to where it is no YAML or too deep.
///
/// # Errors
/// What is wrong there.
pub(super) fn check(text: &str) -> Result<(), Defect> {
    if text.len() > MAX_SIZE {
        let message = format!("{} bytes, {MAX_SIZE} are the most: split the file", text.len());
        return Err(((1, 1), message));
    }
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

/// In libyaml's words, which say more, if it stops there too or before. It sees nothing that lies
/// behind, as that may be too deep for it.
fn no_yaml(text: &str, error: &ScanError) -> Defect {
    let at = error.marker();
    let place = (at.line(), at.col() + 1);
    // A colon is one by what follows it.
    let head: String = text.chars().take(at.index() + 2).collect();
    match serde_yaml::from_str::<IgnoredAny>(&head).map_err(|error| defect(&error)) {
        Err((other, message)) if other <= place => (other, message),
        _ => (place, error.info().to_owned()),
    }
}
