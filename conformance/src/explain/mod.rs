//! Explains in words what bytes mean and where they differ.

pub mod diff;
pub mod frame;
pub mod innfos;
mod table;

pub use table::{Explanation, Row};
