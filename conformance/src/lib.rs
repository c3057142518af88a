//! The suite: checks an implementation of an actuator protocol against the documents.
//!
//! [`cases`] turns the spec into [`check::Check`]s, [`run`] asks a [`testee`] for each, judges the
//! answers, and [`report`] tells a person or a program what came out. [`mod@fuzz`] looks for questions
//! of which no check thought, and [`record`] keeps those that it found.

#![forbid(unsafe_code)]

pub mod call;
pub mod cases;
pub mod check;
pub mod expect;
pub mod explain;
pub mod fuzz;
pub mod protocol;
pub mod record;
pub mod reference;
pub mod report;
pub mod run;
pub mod select;
pub mod testee;
pub mod verdict;
