//! The suite: checks an implementation of an actuator protocol against the documents.
//!
//! [`suite`] turns the spec into [`suite::check::Check`]s, [`run`] asks a [`subject`] for each, judges the
//! answers, and [`report`] tells a person or a program what came out. [`blackbox`] looks for questions
//! of which no check thought, and [`suite::saved`] keeps those that it found. [`adapter::lint`] checks the adapter
//! itself, before what it says of a library counts.
//!
//! The feature `suite`, on by default, has all of this. Without it a model for others' tests is left:
//! [`mod@reference`], and in [`adapter`] and [`subject`] what it says and is asked.

#![forbid(unsafe_code)]

pub mod adapter;
#[cfg(feature = "suite")]
pub mod blackbox;
pub mod call;
#[cfg(feature = "suite")]
pub mod explain;
pub mod reference;
#[cfg(feature = "suite")]
pub mod report;
#[cfg(feature = "suite")]
pub mod run;
pub mod subject;
#[cfg(feature = "suite")]
pub mod suite;
#[cfg(feature = "suite")]
pub mod verdict;
