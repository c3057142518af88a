//! What serde can't see: rules over whole files and between them, one a file. Each returns what
//! it finds wrong, with its place.

mod alarm;
mod citation;
mod command;
mod crc;
mod erratum;
mod fixed_point;
mod full_scale;
mod innfos;
mod layout;
mod overlap;
mod reference;
mod requirement;
mod sentence;
mod text;
mod unique;
mod value;
mod vector;

use crate::{Diagnostic, Spec};

/// Every defect that the rules find, in the order of the rules.
#[must_use]
pub fn all(spec: &Spec) -> Vec<Diagnostic> {
    let rules: [fn(&Spec) -> Vec<Diagnostic>; 16] = [
        citation::check,
        unique::check,
        reference::check,
        overlap::check,
        value::check,
        layout::check,
        crc::check,
        fixed_point::check,
        command::check,
        alarm::check,
        full_scale::check,
        vector::check,
        requirement::check,
        erratum::check,
        sentence::check,
        text::check,
    ];
    rules.iter().flat_map(|rule| rule(spec)).collect()
}
