//! The documents of robot actuators' protocols as data, and the code that reads them.
//!
//! [`load::Spec`] is everything that `spec/*.yaml` says, read and checked; [`generate`] turns it
//! into the source of the codec's tables. The YAML is part of this crate, so nothing here needs
//! the folder at run time.

#![forbid(unsafe_code)]

pub mod check;
pub mod diagnostic;
pub mod generate;
pub mod load;
pub mod model;

pub use diagnostic::Diagnostic;
pub use load::Spec;
