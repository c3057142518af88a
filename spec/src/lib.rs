//! The documents of robot actuators' protocols as data, and the code that reads them.
//!
//! [`load::Spec`] is the content of `spec/*.yaml`, read and validated. [`generate`] turns it into
//! the source of the codec's tables. A [`wire`] has its reference model beside it, for expected
//! results. The YAML is part of this crate, so nothing here needs the folder at run time.
#![cfg_attr(
    feature = "exports",
    doc = "\nWith the feature `exports`, [`export`] turns it into files for others, and [`schema`] has \
           the JSON Schemas of the files."
)]
#![forbid(unsafe_code)]
#![cfg_attr(docsrs, feature(doc_cfg))]

#[cfg(feature = "exports")]
pub mod coverage;
pub mod diagnostic;
#[cfg(feature = "exports")]
pub mod diff;
#[cfg(feature = "exports")]
pub mod export;
pub mod generate;
pub mod load;
pub mod model;
pub mod rests;
#[cfg(feature = "exports")]
pub mod schema;
pub mod validate;
pub mod wire;

pub use diagnostic::Diagnostic;
pub use load::Spec;

/// The page of the test vectors: what it shows in Rust is a test.
#[cfg(doctest)]
#[doc = include_str!("../export/README.md")]
mod page {}
