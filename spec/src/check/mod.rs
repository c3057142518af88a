//! What serde can't see: rules over whole files and between them, one a file. Each returns what
//! it finds wrong, with its place.

mod citation;
mod crc;
mod layout;
mod overlap;
mod reference;
mod unique;
mod value;
mod vector;

use crate::{Diagnostic, Spec};

/// Every defect that the rules find, in the order of the rules.
#[must_use]
pub fn all(spec: &Spec) -> Vec<Diagnostic> {
    let rules: [fn(&Spec) -> Vec<Diagnostic>; 8] = [
        citation::check,
        unique::check,
        reference::check,
        overlap::check,
        value::check,
        layout::check,
        crc::check,
        vector::check,
    ];
    rules.iter().flat_map(|rule| rule(spec)).collect()
}
