//! The suite: checks an implementation of an actuator protocol against the documents.
//!
//! [`cases`] turns the spec into [`check::Check`]s, [`run`] asks a [`testee`] for each, judges the
//! answers, and [`report`] tells a person or a program what came out. [`mod@fuzz`] looks for questions
//! of which no check thought, and [`record`] keeps those that it found. [`adapter`] checks the adapter
//! itself, before what it says of a library counts.
//!
//! The feature `suite`, on by default, has all of this. Without it a model for others' tests is left:
//! [`mod@reference`], and in [`protocol`] and [`testee`] what it says and is asked.

#![forbid(unsafe_code)]

#[cfg(feature = "suite")]
pub mod adapter;
pub mod call;
#[cfg(feature = "suite")]
pub mod cases;
#[cfg(feature = "suite")]
pub mod check;
#[cfg(feature = "suite")]
pub mod expect;
#[cfg(feature = "suite")]
pub mod explain;
#[cfg(feature = "suite")]
pub mod fuzz;
pub mod protocol;
#[cfg(feature = "suite")]
pub mod record;
pub mod reference;
#[cfg(feature = "suite")]
pub mod report;
#[cfg(feature = "suite")]
pub mod run;
#[cfg(feature = "suite")]
pub mod select;
pub mod testee;
#[cfg(feature = "suite")]
pub mod verdict;
