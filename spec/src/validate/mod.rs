//! Rules that serde can't check: over whole files and between files, one rule per module. Each rule
//! returns the defects that it finds, with their places. Rules for one wire alone are in the wire's
//! folder.

mod citation;
pub(crate) mod crc;
mod erratum;
mod overlap;
mod reference;
mod requirement;
mod sentence;
mod text;
mod unique;
mod value;
mod vector;
mod wire;

use crate::{Diagnostic, Spec};

pub(crate) use unique::repeated;

/// All defects that the rules find, in the order of the rules.
#[must_use]
pub fn all(spec: &Spec) -> Vec<Diagnostic> {
    let rules: [fn(&Spec) -> Vec<Diagnostic>; 11] = [
        citation::check,
        unique::check,
        reference::check,
        overlap::check,
        value::check,
        wire::check,
        vector::check,
        requirement::check,
        erratum::check,
        sentence::check,
        text::check,
    ];
    rules.iter().flat_map(|rule| rule(spec)).collect()
}
