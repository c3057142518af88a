//! Says in a person's words what bytes are and where they differ.

pub mod diff;
pub mod frame;
pub mod innfos;
mod table;

pub use table::{Explanation, Row};
