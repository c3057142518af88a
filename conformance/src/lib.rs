//! The suite: checks an implementation of an actuator protocol against the documents.
//!
//! [`cases`] turns the spec into [`check::Check`]s, [`run`] asks a [`testee`] for each, judges the
//! answers, and [`report`] tells a person or a program what came out. [`mod@fuzz`] looks for questions
//! of which no check thought, and [`record`] keeps those that it found. [`adapter`] checks the adapter
//! itself, before what it says of a library counts.

#![forbid(unsafe_code)]

pub mod adapter;
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
