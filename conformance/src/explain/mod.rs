//! Says in a person's words what bytes are and where they differ.

pub mod diff;
pub mod frame;
